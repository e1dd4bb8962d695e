"""The law of contact: its numbers, the step that follows it, and the modes of a body on it."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact import simulate as simulation
from colonnade.dynamics.contact.body import STATIC_PENETRATION, ContactLaw, rigid_body
from colonnade.dynamics.contact.elastic import assemble, reduce_body
from colonnade.dynamics.contact.mesh import prism_mesh
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.stability import (
    FOLLOWED,
    highest_frequency,
    keep_modes,
    keep_modes_for_step,
    longest_step,
)
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.contact.structure import Structure
from colonnade.dynamics.motion import Motion
from every import every
from prism import PRISM

SQUARE = Block.prism(width=0.5, depth=0.5, height=1.0, mass=2.0)

REBOUNDS = [  # Kelvin–Voigt contact that cannot pull (Schwager and Pöschel 2007)
    (0.01, 0.96926), (0.03, 0.91166), (0.05, 0.85876), (0.1, 0.74408), (0.2, 0.57174),
    (0.3, 0.45098), (0.5, 0.29844), (0.7, 0.21028), (0.9, 0.15528),
]  # fmt: skip


@every(("fraction", "ratio"), REBOUNDS)
def test_a_flat_drop_rebounds_as_one_mass_does(fraction, ratio):
    """Four equal nodes, each with a quarter of 2 kg, 5e5 N/m a node, 1 m/s, next to no gravity, 10 µs."""
    body = rigid_body(SQUARE, grid=2)
    law = ContactLaw(5e5 / body.node_area[0], damping_fraction=fraction, friction=0.0)
    start = Start(np.array([0.0, 0.0, 0.50137]), np.array([0.0, 0.0, -1.0]))
    history = simulate(body, Motion(np.zeros(3), 0.005), law=law, gravity=1e-9, step=1e-5, start=start)
    assert history.velocity[-1, 2] == pytest.approx(ratio, abs=1e-4)
    assert law.effective_damping(body) == pytest.approx(fraction)


def test_nodes_that_carry_half_an_element_have_the_effective_damping_of_their_mesh():
    element, height = 0.05, 1.0
    body = rigid_body(SQUARE)
    layer = body.node_area / body.node_area.sum() * SQUARE.mass * 0.5 * element / height
    mesh = type(body)(**{**vars(body), "node_mass": layer})
    law = ContactLaw(1e9, damping_fraction=0.4)
    assert law.effective_damping(mesh) == pytest.approx(0.4 * math.sqrt(element / (2 * height)))


def test_the_stiff_law_lets_bodies_of_all_sizes_sink_alike():
    for size in (0.1, 10.0):
        body = rigid_body(Block.prism(width=0.2 * size, depth=0.3 * size, height=size, mass=5.0))
        law = ContactLaw().bearing(body, 9.81)
        assert 5.0 * 9.81 / law.node_stiffness(body).sum() == pytest.approx(STATIC_PENETRATION * 0.5 * size, rel=1e-9)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"stiffness": 0.0}, "stiffness is 0.0; a positive number"),
        ({"stiffness": math.inf}, "stiffness is inf"),
        ({"damping_fraction": -0.1}, "damping_fraction is -0.1; a number from 0 on"),
        ({"friction": math.nan}, "friction is nan"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_a_law_that_cannot_be_is_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        ContactLaw(**{"stiffness": 1e9, **wrong})


BODY = rigid_body(PRISM)


def _on(law, body=BODY):
    return Structure.of_body(body, law, 9.81)


def test_the_highest_frequency_is_that_of_swaying_and_rocking_on_springs():
    """In the plane, sway and rotation about the centre of mass on springs at its base: the faster of two modes."""
    law = ContactLaw(1e10)
    stiffness, height, (mass, inertia) = law.node_stiffness(BODY), BODY.height, (BODY.mass, BODY.inertia[1])
    sway, coupled = stiffness.sum() / mass, height * stiffness.sum() / math.sqrt(mass * inertia)
    turn = stiffness @ (height**2 + BODY.nodes[:, 0] ** 2) / inertia
    fastest = 0.5 * (sway + turn) + math.hypot(0.5 * (sway - turn), coupled)
    assert highest_frequency(_on(law)) == pytest.approx(math.sqrt(fastest), rel=1e-6)


def test_without_damping_the_longest_step_is_two_over_the_frequency():
    law = ContactLaw(1e10, damping_fraction=0.0)
    assert longest_step(_on(law)) == pytest.approx(2.0 / highest_frequency(_on(law)), rel=1e-4)


@pytest.mark.parametrize("fraction", [0.0, 0.4, 2.0])
def test_a_loaded_block_is_quiet_below_the_longest_step_and_not_above(fraction, monkeypatch):
    law = ContactLaw(1e10, damping_fraction=fraction, friction=math.inf)
    limit = longest_step(_on(law))

    def ringing(step):
        # Under a gravity that keeps all nodes on the table.
        motion = Motion(np.zeros(61), 10 * step)
        history = simulation.simulate(BODY, motion, law=law, gravity=1e3, theta0=1e-9, step=step)
        return np.abs(history.angle[-10:]).max()

    assert ringing(0.9 * limit) < 1e-8
    monkeypatch.setattr(simulation, "longest_step", lambda *_: math.inf)
    assert ringing(1.1 * limit) > 1e-6


ELASTIC = assemble(prism_mesh(0.086, 0.086, 0.456, (2, 2, 6)), 26.10)


def test_dropping_modes_keeps_the_low_ones_and_ends_at_the_rigid_body():
    reduced = reduce_body(ELASTIC)
    low = keep_modes(reduced, 5)
    assert low.frequencies == pytest.approx(reduced.frequencies[:5])
    assert low.modes == pytest.approx(reduced.modes[:, :, :5])
    assert keep_modes(reduced, reduced.frequencies.size) is reduced
    rigid = keep_modes(reduced, 0)
    assert rigid.frequencies.size == 0
    assert rigid.nodes == pytest.approx(ELASTIC.points[ELASTIC.base])


def test_a_step_of_ten_microseconds_keeps_modes_that_the_engine_advances_with_closed_energy():
    reduced = reduce_body(ELASTIC)
    law = ContactLaw(penetration=1e-6).bearing(reduced, 9.81)
    kept = keep_modes_for_step(reduced, law, 1e-5)
    count = kept.frequencies.size
    assert count >= 4
    assert longest_step(_on(law, kept)) >= 1e-5 / FOLLOWED
    assert longest_step(_on(law, keep_modes(reduced, count + 2))) < 1e-5 / FOLLOWED
    history = simulate(kept, law=law, theta0=0.05, duration=0.3, step=1e-5)
    assert history.impact_times.size == 1
    assert history.energies.relative_residual < 0.01


def test_a_step_that_not_even_the_rigid_body_allows_is_refused():
    reduced = reduce_body(ELASTIC, vibration_modes=6)
    law = ContactLaw().bearing(reduced, 9.81)
    kept = keep_modes_for_step(reduced, law, 1e-2)
    assert kept.frequencies.size == 0
    with pytest.raises(ValueError, match=r"at most .* s was expected"):
        simulate(kept, law=law, theta0=0.05, duration=0.1, step=1e-2)
