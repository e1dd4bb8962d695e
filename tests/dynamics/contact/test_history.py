"""Impacts between arcs, and an energy balance that says when it does not close."""

import numpy as np
import pytest

from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.history import EnergyBalance, impacts_of
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
SPEED = 0.3 * P * ALPHA


def _contact(begin, largest, *, before=-SPEED, after=-0.95 * SPEED, pole=1.0, to=-1.0, ended=True):
    return [begin, 0.0, before, 0.0, pole, 0.0, *((after, to) if ended else (0.0, 0.0)), largest, 0.0]


def test_contacts_without_an_arc_between_them_are_one_impact():
    table = np.array([
        _contact(1.0, 0.2 * ALPHA),
        _contact(1.002, 1e-6 * ALPHA, before=-0.95 * SPEED, after=-0.9 * SPEED, pole=-1.0, to=-1.0),
        _contact(1.3, 0.1 * ALPHA, before=0.9 * SPEED, after=0.8 * SPEED, pole=-1.0, to=1.0),
    ])  # fmt: skip
    times, before, after = impacts_of(table, PRISM)
    np.testing.assert_allclose(times, [1.0, 1.3])
    np.testing.assert_allclose(before, [-SPEED, 0.9 * SPEED])
    np.testing.assert_allclose(after, [-0.9 * SPEED, 0.8 * SPEED])


def test_an_impact_that_ends_at_rest_has_no_rebound():
    _, _, after = impacts_of(np.array([_contact(1.0, 0.2 * ALPHA, ended=False)]), PRISM)
    assert after.tolist() == [0.0]


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("level", [0.0, 0.5], ids=["at rest", "accelerated"])
def test_speeds_are_carried_to_zero_angle_by_the_equation_of_motion(side, level):
    """A speed taken on the way down, at θ = 0.1 α, becomes the analytical speed at the impact."""
    base = Motion(np.full(4001, level * PRISM.uplift_acceleration), 1e-4)
    history = rock(PRISM, base, model="nonlinear", restitution=0.9, theta0=side * 0.2 * ALPHA)
    stop = np.flatnonzero(side * history.angle[: int(history.impact_times[0] / 1e-4)] > 0.1 * ALPHA)[-1]
    row = _contact(1.0, 0.2 * ALPHA, before=history.angular_velocity[stop], pole=side)
    row[1], row[3] = history.angle[stop], base.acceleration[0]
    _, before, _ = impacts_of(np.array([row]), PRISM)
    assert before[0] == pytest.approx(history.impact_velocities[0], rel=1e-9)


def test_no_contact_gives_no_impact():
    assert all(values.shape == (0,) for values in impacts_of(np.zeros((0, 10)), PRISM))


def test_a_balance_that_does_not_close_is_told():
    body = rigid_body(PRISM)
    law = ContactLaw().bearing(body, 9.81)
    history = simulate(body, Motion(np.zeros(11), 0.005), law=law, theta0=0.1 * ALPHA)
    assert history.warnings == ()
    part = {name: getattr(history.energies, name) for name in vars(history.energies)}
    leaking = EnergyBalance(**{**part, "kinetic": 0.9 * part["kinetic"]})
    told = type(history)(**{**vars(history), "energies": leaking}).warnings
    assert "does not close" in told[0]
    assert "Try a step shorter than 5e-06 s" in told[0]


def test_what_cannot_lift_the_block_is_not_missing():
    """Shaken below its threshold, the block has hardly any energy to compare with, and the balance closes."""
    body = rigid_body(PRISM)
    shaken = Motion(0.8 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 3 * 0.005 * np.arange(401)), 0.005)
    history = simulate(body, shaken, law=ContactLaw().bearing(body, 9.81), step=2e-5)
    assert history.outcome == "no-rocking"
    assert history.energies.relative_residual < 1e-3
    assert history.warnings == ()
    overturning = PRISM.mass * 9.81 * PRISM.pole_distance * (1 - np.cos(ALPHA))
    part = {name: getattr(history.energies, name) for name in vars(history.energies)}

    def told(share):
        lost = part["dissipated"] + np.linspace(0.0, share * overturning, 401)
        leaking = EnergyBalance(**{**part, "dissipated": lost})
        return type(history)(**{**vars(history), "energies": leaking}).warnings

    assert told(0.0015) == ()
    assert "does not close" in told(0.02)[0]
