"""Impacts between arcs, and an energy balance that says when it does not close."""

import numpy as np
import pytest

from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.history import EnergyBalance, impacts_of, passages
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA = PRISM.critical_angle


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("level", [0.0, 0.5], ids=["at rest", "accelerated"])
def test_speeds_are_carried_to_zero_angle_by_the_equation_of_motion(side, level):
    """A speed taken on the way down, at θ = 0.1 α, becomes the analytical speed at the impact."""
    base = Motion(np.full(4001, level * PRISM.uplift_acceleration), 1e-4)
    history = rock(PRISM, base, model="nonlinear", restitution=0.9, theta0=side * 0.2 * ALPHA)
    sunk = 9.81 * (5e-3 / np.pi) ** 2
    found = impacts_of(PRISM, history.time, history.angle, history.angular_velocity, base.acceleration, sunk)
    times, before, after = found.values()
    assert times[0] == pytest.approx(history.impact_times[0], abs=1e-5)
    assert before[0] == pytest.approx(history.impact_velocities[0], rel=1e-6)
    assert after[0] == pytest.approx(history.rebound_velocities[0], rel=1e-6)


def test_a_body_that_lands_and_stays_or_only_leans_on_its_contact_has_no_impact():
    angle = ALPHA * np.array([0.2, 0.1, 0.0, 5e-5, -5e-5, 0.0, 0.0, -0.1])
    assert all(each.size == 0 for each in passages(np.arange(8.0), angle, ALPHA))


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


def test_the_balance_of_a_block_that_only_stands_closes():
    """Shaken below its threshold, the block has hardly any energy to compare with, and the balance closes."""
    body = rigid_body(PRISM)
    shaken = Motion(0.8 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 3 * 0.005 * np.arange(401)), 0.005)
    history = simulate(body, shaken, law=ContactLaw().bearing(body, 9.81), step=2e-5)
    assert history.outcome == "no-rocking"
    assert history.energies.relative_residual < 1e-3
    assert history.warnings == ()
