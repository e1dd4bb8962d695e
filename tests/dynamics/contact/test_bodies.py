"""Bodies on each other, beside statics, conservation laws, the and the frame's equivalent block."""

import math

import numpy as np
import pytest

import colonnade
from colonnade.dynamics.assembly import Assembly, Placed
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact import simulate as simulation
from colonnade.dynamics.contact.body import ContactLaw, rotation_matrices
from colonnade.dynamics.contact.simulate import simulate_assembly
from colonnade.dynamics.contact.start import Start, standing
from colonnade.dynamics.contact.structure import Structure
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from on_contact import peaks

GRAVITY = 9.81
CUBE = colonnade.Block.prism(width=0.3, depth=0.3, height=0.25, mass=55.0)
DRUM = colonnade.Block.cylinder(diameter=0.3, height=0.25, mass=40.0)
STACKS = {"prisms": CUBE, "drums": DRUM}


def _stack(block, count):
    return colonnade.Assembly.stack(**{f"d{i}": block for i in range(count)})


def _tilted(assembly, law, tangent):
    """Tilt the table from 0.98 to 1.02 times a tangent in 1 s; return the history and the shares."""
    time = 0.005 * np.arange(261)
    shares = (0.98 + 0.04 * np.clip(time - 0.3, 0.0, 1.0)) * np.clip(time / 0.3, 0.0, 1.0)
    angle = np.arctan(tangent * shares)
    motion = Motion(GRAVITY * np.sin(angle), 0.005, vertical=GRAVITY * (np.cos(angle) - 1.0))
    return simulate_assembly(assembly, motion, law=law), shares


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 4])
@pytest.mark.parametrize(
    ("block", "law", "open_at"),
    [(CUBE, ContactLaw(friction=5.0), 1e-4), (DRUM, ContactLaw(friction=5.0, penetration=1e-8), 1e-3)],
    ids=STACKS,
)
def test_a_stack_on_a_table_that_tilts_opens_at_its_base_joint(block, law, open_at, count):
    """By statics at tan = D / H, H the height of the whole stack; a round rim sinks in, and leans, before that."""
    assembly = _stack(block, count)
    history, shares = _tilted(assembly, law, 0.3 / (0.25 * count))
    opened = {
        name: int(np.argmax(np.abs(body.relative.angle) > open_at * assembly.critical_angles[name]))
        for name, body in history.bodies.items()
    }
    assert shares[opened["d0"]] == pytest.approx(1.0, abs=0.01)
    assert all(sample == 0 or sample > opened["d0"] for name, sample in opened.items() if name != "d0")


@pytest.mark.slow
@pytest.mark.parametrize("block", STACKS.values(), ids=STACKS)
def test_with_little_friction_a_stack_on_a_table_that_tilts_slides(block):
    history, shares = _tilted(_stack(block, 2), ContactLaw(friction=0.2), 0.2)
    slides = np.max([np.abs(body.relative.slide[:, 0]) for body in history.bodies.values()], axis=0)
    assert shares[np.argmax(slides > 1e-5)] == pytest.approx(1.0, abs=0.01)
    assert history.outcome == "no-rocking"


def test_two_bodies_that_meet_in_space_keep_momentum_and_energy():
    """Without damping and friction; the forces within are equal and opposite to rounding."""
    big = colonnade.Block.prism(width=0.3, depth=0.3, height=0.3, mass=65.0, gravity=1e-12)
    small = colonnade.Block.prism(width=0.2, depth=0.25, height=0.2, mass=20.0, gravity=1e-12)
    assembly = colonnade.Assembly.stack(big=big, small=small)
    structure = Structure.of_assembly(assembly, ContactLaw(1e9, damping_fraction=0.0, friction=0.0))
    starts = [
        Start(np.array([0.0, 0.0, 10.15]), np.array([0.0, 0.0, 0.3]), angular_velocity=np.array([0.1, 0.2, 0.05])),
        Start(np.array([0.02, 0.01, 10.402]), np.array([0.1, 0.0, -0.5]), angular_velocity=np.array([-0.3, 0.5, 0.2])),
    ]
    rows = np.array([start.row for start in starts])
    samples, sums, *_ = simulation._march(structure, rows, np.zeros((41, 3)), 1e-3, 1000)
    masses = np.array([big.mass, small.mass])
    velocity, place = samples[:, :, 3:6], samples[:, :, :3]
    momentum = np.einsum("nbi,b->ni", velocity, masses)
    scale = np.abs(masses[:, None] * velocity[0]).sum()
    np.testing.assert_allclose(momentum, np.broadcast_to(momentum[0], momentum.shape), atol=1e-12 * scale)
    turned = [rotation_matrices(samples[:, body, 6:10]) for body in range(2)]
    own = [samples[:, body, 10:13] * structure.bodies[body].inertia for body in range(2)]
    angular = sum(np.einsum("nij,nj->ni", *pair) for pair in zip(turned, own, strict=True))
    angular = angular + np.einsum("nbi,b->ni", np.cross(place - place[0, 0], velocity), masses)
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-10 * scale)
    energy = sums[:, 0] + sums[:, 3]
    assert sums[:, 3].max() > 0.3 * energy[0]
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


COLUMN = colonnade.Block.prism(width=0.3, depth=0.3, height=1.5, mass=300.0)


def _frame(share):
    """Two columns with a beam of a multiple of a column's mass, and the block that rocks as they do."""
    beam = colonnade.Block.prism(width=2.3, depth=0.3, height=0.3, mass=share * COLUMN.mass)
    gamma, inertia = 0.5 * share, COLUMN.inertia
    faster = (1 + 2 * gamma) / (1 + 4 * gamma * COLUMN.mass * COLUMN.pole_distance**2 / inertia)
    equivalent = colonnade.Block.measured(
        mass=COLUMN.mass,
        pole_distance=COLUMN.pole_distance,
        critical_angle=COLUMN.critical_angle,
        inertia=inertia / faster,
    )
    return colonnade.Assembly.frame(COLUMN, beam, span=2.0), equivalent


@pytest.mark.slow
@pytest.mark.parametrize("share", [1.0, 10.0])
def test_a_frame_rocks_as_its_equivalent_block(share):
    """e of the frame is that of its first arc; it holds for the next four impacts."""
    assembly, block = _frame(share)
    alpha = COLUMN.critical_angle
    law = ContactLaw(damping_fraction=1.0, friction=2.0)
    history = simulate_assembly(assembly, law=law, theta0=0.25 * alpha, duration=2.6)
    angle = history.bodies["left"].angle
    np.testing.assert_allclose(history.bodies["right"].angle, angle, atol=2e-3 * alpha)
    assert np.abs(history.bodies["beam"].angle).max() < 1e-3 * alpha
    found = peaks(angle)
    released, kept = (np.cos(alpha - size) - np.cos(alpha) for size in (0.25 * alpha, found[0]))
    e = math.sqrt(kept / released)
    plane = peaks(rock(block, model="nonlinear", restitution=e, theta0=0.25 * alpha, duration=2.6).angle)
    assert found.size >= 4
    np.testing.assert_allclose(found, plane[: found.size], atol=0.01 * alpha)


@pytest.mark.slow
@pytest.mark.parametrize("share", [1.0, 10.0])
@pytest.mark.parametrize(("level", "outcome"), [(0.99, "no-rocking"), (1.01, "rocking")])
def test_a_frame_begins_to_rock_as_a_column_does(share, level, outcome):
    assembly, _ = _frame(share)
    ramp = np.minimum(np.arange(161) * 0.005 / 0.5, 1.0) * level * GRAVITY * math.tan(COLUMN.critical_angle)
    history = simulate_assembly(assembly, Motion(ramp, 0.005), law=ContactLaw(damping_fraction=1.0, friction=2.0))
    assert history.outcome == outcome


@pytest.mark.whole
def test_a_drum_thrown_off_is_the_one_that_overturned():
    """The upper one is pushed off, and what it stood on stays."""
    assembly = _stack(DRUM, 2)
    _, begin = standing(Structure.of_assembly(assembly, ContactLaw()))
    thrown = Start(begin.position, np.array([2.0, 0.0, 0.0]))
    history = simulate_assembly(assembly, law=ContactLaw(), duration=0.6, starts={"d1": thrown}, step=5e-6)
    assert history.outcome == "overturned"
    assert history.overturned_bodies == ("d1",)
    assert history.bodies["d0"].residual[0] < 0.1


@pytest.mark.parametrize("name", ["frame", "colonnade", "stack"])
def test_an_assembly_stands_still_on_a_table_at_rest(name):
    beam = colonnade.Block.prism(width=1.0, depth=0.3, height=0.2, mass=120.0)
    assembly = {
        "frame": colonnade.Assembly.frame(_stack(DRUM, 2), beam, span=0.8),
        "colonnade": colonnade.Assembly.colonnade(CUBE, beam, columns=3, spacing=1.0),
        "stack": _stack(DRUM, 3),
    }[name]
    history = colonnade.rock(assembly, model="contact", duration=0.05)
    assert history.outcome == "no-rocking"
    weight = sum(body.block.mass for body in assembly.bodies.values()) * GRAVITY
    assert history.base_force[-1, 2] == pytest.approx(weight, rel=1e-3)
    assert max(np.abs(body.slide).max() for body in history.bodies.values()) < 1e-6


@pytest.mark.parametrize(
    ("bodies", "told"),
    [
        ({"a": ("x",)}, 'stands on "x", which is not a body'),
        ({"a": ("b",), "b": ("a",)}, "in a circle"),
    ],
    ids=["unknown", "a circle"],
)
def test_an_assembly_that_cannot_stand_is_refused(bodies, told):
    with pytest.raises(ValueError, match=told):
        colonnade.Assembly({name: colonnade.Placed(DRUM, on) for name, on in bodies.items()})


@pytest.mark.whole
@pytest.mark.parametrize("seed", [pytest.param(0, marks=pytest.mark.slow), 1, pytest.param(5, marks=pytest.mark.slow)])
def test_drums_that_stand_off_their_places_keep_their_energy_as_they_slide_over_edges(seed):
    """Edges that are off the other face at rest bear once they have slid there; nothing bursts apart."""
    random = np.random.default_rng(seed)
    drum = Block.prism(width=0.2, depth=0.2, height=0.2, mass=20.0)
    places = random.uniform(-1e-3, 1e-3, (3, 2)).tolist()
    column = Assembly({str(k): Placed(drum, (str(k - 1),) if k else (), tuple(places[k])) for k in range(3)})
    time = np.arange(0.0, 2.2, 0.005)
    motion = Motion(np.where(time < 1.5, 6.0 * np.sin(4 * np.pi * time), 0.0), 0.005)
    history = rock(column, motion, model="contact")
    assert history.outcome == "rocking"
    assert history.energies.relative_residual < 0.01
    for body in history.bodies.values():
        assert body.relative.uplift.min() > -4e-3  # some mm of overhang turned by up to 0.5 rad; −30 mm before
        assert np.abs(body.position).max() < 1.0
