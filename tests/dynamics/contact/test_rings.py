"""Round bodies on whole rings: nothing depends on the direction, and no polygon is left."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body, rotation_matrices
from colonnade.dynamics.contact.calibration import TOLERANCE, calibrate
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.stability import highest_frequency
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.contact.structure import Structure
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from on_contact import alone


def polygon(body, around):
    """Spread each ring of a body over so many nodes on its circle."""
    turned = 2.0 * np.pi * np.arange(around) / around
    radii, heights = (np.repeat(values, around) for values in (body.ring_radii, body.nodes[:, 2]))
    angles = np.tile(turned, len(body.nodes))
    return replace(
        body,
        nodes=np.column_stack((radii * np.cos(angles), radii * np.sin(angles), heights)),
        node_mass=np.repeat(body.node_mass, around) / around,
        node_area=np.repeat(body.node_area, around) / around,
        ring_radii=np.zeros(len(radii)),
    )


GRAVITY = 9.81
CYLINDER = Block.cylinder(diameter=0.097, height=0.455, mass=26.30, gravity=GRAVITY)
CONE = Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94, gravity=GRAVITY)
ALPHA = CYLINDER.critical_angle
BODY = rigid_body(CYLINDER)
LAW = ContactLaw(damping_fraction=0.4, penetration=1e-6).bearing(BODY, GRAVITY)
STEP = 2e-5
PUSH = 0.01
"""Angular velocity about x at the start, over p α: the sideways push of a hand."""


def _pushed(body, push, theta0=0.6 * ALPHA):
    """Release with an angular velocity about x, over p α, about the foot at +x."""
    still = alone(body, LAW, GRAVITY, theta0=theta0)
    foot = rotation_matrices(still.orientation[None])[0] @ np.array([body.half_width, 0.0, -body.height])
    angular = np.array([push * CYLINDER.p * ALPHA, 0.0, 0.0])
    return Start(still.position, np.cross(angular, -foot), still.orientation, angular)


def _times(one, other):
    """Product of two quaternions."""
    scalar, vector = one[0] * other[0] - one[1:] @ other[1:], one[0] * other[1:] + other[0] * one[1:]
    return np.concatenate(([scalar], vector + np.cross(one[1:], other[1:])))


def _turned(start, table, material):
    """Turn a whole release about the vertical, and the body before it about its own axis."""
    turn, own = (np.array([np.cos(0.5 * angle), 0.0, 0.0, np.sin(0.5 * angle)]) for angle in (table, material))
    matrix = rotation_matrices(turn[None])[0]
    orientation = _times(_times(turn, start.orientation), own)
    return Start(matrix @ start.position, matrix @ start.velocity, orientation, matrix @ start.angular_velocity)


def _axis(history):
    """Horizontal part of the body's axis, shape (n, 2)."""
    return rotation_matrices(history.orientation)[:, :2, 2]


def _run(body, start, duration, law=LAW, step=STEP):
    return simulate(body, law=law, gravity=GRAVITY, duration=duration, step=step, start=start)


def _of_a_turn(body, push, table, material):
    """Largest change of the axis, of α, that turning the release makes over two impacts."""
    start = _pushed(body, push)
    straight, turned = _run(body, start, 1.0), _run(body, _turned(start, table, material), 1.0)
    back = np.array([[np.cos(table), np.sin(table)], [-np.sin(table), np.cos(table)]])
    assert straight.impact_times.size >= 2
    return np.abs(_axis(turned) @ back.T - _axis(straight)).max() / ALPHA


@pytest.mark.parametrize("push", [0.0, PUSH], ids=["let go", "pushed sideways"])
@pytest.mark.parametrize(("table", "material"), [(0.7, 0.0), (0.0, 0.13), (2.0, -1.1)])
def test_a_release_that_is_turned_gives_the_same_motion_turned(push, table, material):
    assert _of_a_turn(BODY, push, table, material) < 1e-7


def test_a_ring_of_nodes_is_a_polygon_whose_turn_matters():
    assert _of_a_turn(polygon(BODY, 24), 0.0, 0.0, 0.04) > 1e-2


@pytest.mark.parametrize("block", [CYLINDER, CONE], ids=["cylinder", "cone"])
def test_a_rotation_about_x_at_the_start_only_turns_the_plane_of_rocking(block):
    alpha = block.critical_angle
    history = rock(block, model="contact", theta0=0.9 * alpha, out_of_plane=0.02 * alpha, duration=1.5)
    axis = _axis(history)
    assert history.impact_times.size >= 2
    across = axis @ [axis[0, 1], -axis[0, 0]] / np.hypot(*axis[0])
    np.testing.assert_allclose(across, 0.0, atol=1e-9 * alpha)


def test_nodes_come_nearer_to_the_whole_ring_with_their_number():
    start = _pushed(BODY, PUSH)
    whole = _axis(_run(BODY, start, 0.8))
    misses = []
    for around in (24, 72, 288):
        nodes = _axis(_run(polygon(BODY, around), start, 0.8))
        misses.append(np.abs(nodes - whole).max() / ALPHA)
    print(misses)
    assert misses[0] > 3.0 * misses[1] > 9.0 * misses[2]
    assert misses[2] < 5e-3


@pytest.mark.parametrize("tilt", [0.02, 0.1])
def test_the_arc_bears_the_weight_of_the_closed_form(tilt):
    """The start is put as deep as the closed form of the arc says; the engine integrates the arc at points."""
    law = ContactLaw(damping_fraction=0.0, friction=0.0).bearing(BODY, GRAVITY)
    start = alone(BODY, law, GRAVITY, theta0=tilt)
    history = simulate(BODY, Motion(np.zeros(3), 1e-8), law=law, gravity=GRAVITY, start=start)
    assert history.base_force[1, 2] == pytest.approx(CYLINDER.mass * GRAVITY, rel=1e-3)
    depth, radius = -history.uplift[0], BODY.half_width
    half = np.arccos(1.0 - depth / (radius * np.sin(tilt)))
    around = law.node_stiffness(BODY)[-1] * radius * np.sin(tilt) / np.pi
    assert around * (np.sin(half) - half * np.cos(half)) == pytest.approx(CYLINDER.mass * GRAVITY, rel=1e-9)


def test_plane_rocking_is_the_analytical_one_with_the_runs_own_restitution():
    law = ContactLaw(damping_fraction=1.0, friction=2.0, penetration=1e-7).bearing(BODY, GRAVITY)
    theta0 = 0.5 * ALPHA
    history = simulate(BODY, law=law, gravity=GRAVITY, theta0=theta0, duration=1.2, step=1e-5)
    own = history.impact_restitution
    assert own.size >= 3
    assert np.ptp(own) < 1e-3
    assert np.abs(history.out_of_plane_angle).max() < 1e-9
    plane = rock(CYLINDER, model="nonlinear", restitution=float(own.mean()), theta0=theta0, duration=1.2)
    angle = np.interp(history.time, plane.time, plane.angle)
    print(np.abs(history.angle - angle).max() / ALPHA, own)
    assert np.abs(history.angle - angle).max() < 5e-3 * ALPHA


def test_the_energy_balance_of_a_pushed_cylinder_closes_and_it_converges_with_the_step():
    start = _pushed(BODY, PUSH)
    runs = [_run(BODY, start, 0.8, step=step) for step in (4e-5, 1e-5, 4e-6)]
    assert [run.energies.relative_residual < 1e-4 for run in runs] == [True] * 3
    misses = [np.abs(_axis(run) - _axis(runs[-1])).max() / ALPHA for run in runs[:-1]]
    print(misses, [run.energies.relative_residual for run in runs])
    assert misses[1] < misses[0] < 1e-3


def test_whole_rings_are_the_limit_of_the_law_on_nodes():
    """Stiffness, damping and share of mass of a ring are those of its nodes together, whatever their number."""
    for around in (5, 24):
        nodes = polygon(BODY, around)
        for told in ("node_stiffness", "node_damping"):
            together = getattr(LAW, told)(nodes).reshape(4, around).sum(axis=1)
            np.testing.assert_allclose(getattr(LAW, told)(BODY), together, rtol=1e-12)
        assert LAW.effective_damping(BODY) == pytest.approx(LAW.effective_damping(nodes), rel=1e-12)
        whole, spread = (highest_frequency(Structure.of_body(body, LAW, GRAVITY)) for body in (BODY, nodes))
        assert whole == pytest.approx(spread, rel=1e-9)


def test_damping_is_found_for_a_restitution_on_rings():
    found = calibrate(BODY, LAW, 0.978, gravity=GRAVITY, step=STEP, impacts=3, fractions=(0.3, 1.0))
    assert not found.reason
    assert found.history.law.stiffness == LAW.stiffness
    history = simulate(BODY, law=found.history.law, gravity=GRAVITY, theta0=0.5 * ALPHA, duration=0.9, step=STEP)
    assert np.exp(np.log(history.impact_restitution[:3]).mean()) == pytest.approx(0.978, abs=2 * TOLERANCE)


def test_a_pushed_cylinder_leaves_its_plane_and_a_pushed_prism_does_not():
    prism = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10, gravity=GRAVITY)
    largest = []
    for block in (CYLINDER, prism):
        body = rigid_body(block)
        history = _run(body, _pushed(body, PUSH, 0.6 * block.critical_angle), 1.2)
        largest.append(np.abs(history.out_of_plane_angle).max() / block.critical_angle)
    print(largest)
    assert largest[0] > 0.1 > 100.0 * largest[1]


def test_peaks_of_a_rolling_ring_pass_without_the_loss_of_a_flat_impact():
    """The rim rolls round where plane rocking would land flat: no impulse, so less energy is lost than in the plane."""
    plane, pushed = (_run(BODY, _pushed(BODY, push), 1.0) for push in (0.0, 0.05))
    lost = [run.energies.dissipated[-1] for run in (plane, pushed)]
    assert min(np.diff(pushed.energies.dissipated)) > -1e-6
    assert lost[1] < 0.7 * lost[0]


def test_friction_on_rings_slows_a_cylinder_that_spins():
    squat = Block.cylinder(diameter=0.5, height=0.1, mass=10.0, gravity=GRAVITY)
    body = rigid_body(squat)
    law = ContactLaw(damping_fraction=0.5, friction=0.2).bearing(body, GRAVITY)
    start = Start(alone(body, law, GRAVITY).position, angular_velocity=np.array([0.0, 0.0, 2.0]))
    spun = simulate(body, Motion(np.zeros(101), 0.004), law=law, gravity=GRAVITY, start=start)
    # Friction on rings turns it back with µ m g times the mean radius that bears.
    radius = float(body.node_area @ body.ring_radii / body.node_area.sum())
    slowed = 0.2 * squat.mass * GRAVITY * radius / body.inertia[2]
    at = 25
    assert spun.turning[at, 2] == pytest.approx(2.0 - slowed * spun.time[at], rel=5e-3)
