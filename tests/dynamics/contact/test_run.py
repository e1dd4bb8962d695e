"""Motion in space beside closed forms: free flight, rolling, sliding, and the energy balance."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body, rotation_matrices
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.motion import Motion
from on_contact import alone
from prism import PRISM

GRAVITY = 9.81
RADIUS, HEIGHT = 0.0485, 0.1
CYLINDER = Block.cylinder(diameter=2 * RADIUS, height=HEIGHT, mass=1.0)
SQUAT = Block.prism(width=0.5, depth=0.3, height=0.1, mass=10.0)


def _rest(duration, intervals=100):
    return Motion(np.zeros(intervals + 1), duration / intervals)


def _angular_momentum(history):
    """About the centre of mass, in the table's axes, shape (n, 3)."""
    matrices = rotation_matrices(history.orientation)
    inertia = np.einsum("nij,j,nkj->nik", matrices, history.body.inertia, matrices)
    return np.einsum("nij,nj->ni", inertia, history.turning)


def test_free_flight_keeps_momentum_and_angular_momentum():
    body = rigid_body(Block.prism(width=0.2, depth=0.4, height=0.9, mass=10.0))
    start = Start(
        np.array([0, 0, 100.0]), np.array([1.0, 2.0, 3.0]), np.array([1, 0.2, 0.3, 0.4]), np.array([3, 0.5, 9.0])
    )
    history = simulate(body, _rest(1.0), law=ContactLaw(1e6), step=1e-3, start=start)
    fall = np.array([1.0, 2.0, 3.0]) - np.outer(history.time, [0.0, 0.0, GRAVITY])
    np.testing.assert_allclose(history.velocity, fall, rtol=0, atol=1e-12)
    spin = _angular_momentum(history)
    np.testing.assert_allclose(spin, np.broadcast_to(spin[0], spin.shape), rtol=0, atol=1e-12 * np.abs(spin).max())
    np.testing.assert_allclose(np.linalg.norm(history.orientation, axis=1), 1.0, rtol=0, atol=1e-12)
    assert not history.base_force.any()
    assert history.energies.relative_residual < 1e-7


def test_free_rotation_of_an_unequal_body_is_of_second_order():
    body = rigid_body(Block.prism(width=0.2, depth=0.4, height=0.9, mass=10.0))
    start = Start(np.array([0, 0, 100.0]), angular_velocity=np.array([3.0, 8.0, 5.0]))
    runs = [
        simulate(body, _rest(1.0, 10), law=ContactLaw(1e6), step=step, start=start).orientation[-1]
        for step in (4e-3, 2e-3, 1e-3, 1e-4)
    ]
    errors = [np.abs(run - runs[-1]).max() for run in runs[:3]]
    assert errors[2] < 1e-4
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 2.0, atol=0.05)


def _rolling(body, tilt, law):
    """Rate and start of steady rolling on the rim about a centre of mass that stays (checked against Ω² of h = 0)."""
    half, (transverse, _, axial) = 0.5 * HEIGHT, body.inertia
    sine, cosine = math.sin(tilt), math.cos(tilt)
    lever = RADIUS * cosine - half * sine
    rate = math.sqrt(body.mass * GRAVITY * lever / (sine * (transverse * cosine - axial * half / RADIUS * sine)))
    upright = alone(body, law, GRAVITY, theta0=tilt)
    axis = np.array([sine, 0.0, cosine])
    turning = rate * np.array([0.0, 0.0, 1.0]) - rate * lever / RADIUS * axis
    return rate, Start(upright.position * [0, 0, 1], orientation=upright.orientation, angular_velocity=turning)


def _law(body, stiffness=1e6, damping_fraction=0.05, friction=2.0):
    """Give a law whose stiffness is that of each of a single ring's nodes, N/m."""
    return ContactLaw(stiffness / body.node_area[0], damping_fraction=damping_fraction, friction=friction)


def _measured_rate(history):
    axis = rotation_matrices(history.orientation)[:, :, 2]
    return np.polyfit(history.time, np.unwrap(np.arctan2(axis[:, 1], axis[:, 0])), 1)[0]


@pytest.mark.parametrize("tilt", [0.1, 0.3])
def test_a_cylinder_rolls_steadily_on_its_whole_rim(tilt):
    """Its centre of mass stays, so that no friction is needed: the closed form holds to the depth of the contact."""
    body = rigid_body(CYLINDER, rings=1)
    law = _law(body, 1e9, 0.0, 0.0)
    rate, start = _rolling(body, tilt, law)
    history = simulate(body, _rest(0.5), law=law, step=1e-5, start=start)
    assert _measured_rate(history) == pytest.approx(rate, rel=1e-3)
    assert np.ptp(history.lean) * history.block.critical_angle < 1e-3 * tilt
    assert np.abs(history.position[:, :2]).max() < 1e-6


def test_friction_on_the_arc_slows_rolling_less_the_harder_the_contact_is():
    """A rim that rolls tilted also turns about the vertical where it touches. A harder contact has a shorter arc."""
    body = rigid_body(CYLINDER, rings=1)
    lost = []
    for stiffness, step in ((1e8, 1e-5), (1e9, 1e-5), (1e10, 5e-6)):
        law = _law(body, stiffness)
        _, start = _rolling(body, 0.3, law)
        history = simulate(body, _rest(0.1), law=law, step=step, start=start)
        lost.append(history.energies.dissipated[-1] / history.energies.kinetic[0])
        assert history.energies.relative_residual < 2e-3
        assert np.abs(history.position[:, :2]).max() < 5e-4
    print(lost)
    assert lost[0] > 1.6 * lost[1] > 2.5 * lost[2]


def test_without_friction_and_damping_energy_and_vertical_angular_momentum_are_kept():
    body = rigid_body(CYLINDER, rings=1)
    law = _law(body, 1e6, 0.0, 0.0)
    upright = alone(body, law, GRAVITY, theta0=0.2)
    start = Start(upright.position, orientation=upright.orientation, angular_velocity=np.array([0.5, 3.0, 20.0]))
    history = simulate(body, _rest(0.5), law=law, step=5e-6, start=start)
    vertical = _angular_momentum(history)[:, 2]
    np.testing.assert_allclose(vertical, vertical[0], rtol=1e-11)
    np.testing.assert_allclose(history.velocity[:, :2], 0.0, atol=1e-12)
    assert history.energies.relative_residual < 1e-3
    assert np.abs(history.energies.dissipated).max() < 1e-12


def test_a_block_pushed_along_slides_coulombs_distance():
    body = rigid_body(SQUAT)
    law = ContactLaw(damping_fraction=0.5, friction=0.2).bearing(body, GRAVITY)
    place = alone(body, law, GRAVITY).position
    start = Start(place, velocity=np.array([0.3, 0.4, 0.0]))
    history = simulate(body, _rest(0.4), law=law, start=start)
    distance = 0.5**2 / (2 * 0.2 * GRAVITY)
    np.testing.assert_allclose(history.slide[-1], np.array([0.6, 0.8]) * distance, rtol=5e-3)
    assert history.energies.dissipated[-1] == pytest.approx(0.5 * SQUAT.mass * 0.5**2, rel=5e-3)


@pytest.mark.parametrize(("share", "slides"), [(0.98, False), (1.02, True)], ids=["below µ g", "above µ g"])
def test_a_block_on_an_accelerated_table_slips_at_coulombs_limit(share, slides):
    body = rigid_body(SQUAT)
    friction = 0.2
    law = ContactLaw(damping_fraction=0.5, friction=friction).bearing(body, GRAVITY)
    ramp = np.minimum(np.arange(101) / 50.0, 1.0) * share * friction * GRAVITY
    history = simulate(body, Motion(ramp, 0.01), law=law)
    left = -history.slide[-1, 0]
    if not slides:
        assert abs(left) < 1e-5
        return
    # From the instant at which the ramp passes µ g, x'' = a − µ g; the excess is constant in the last half second.
    rising, excess = 0.5 - 0.5 / share, (share - 1.0) * friction * GRAVITY
    expected = excess * (rising**2 / 6 + rising / 2 * 0.5 + 0.5**2 / 2)
    assert left == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("direction", [-1.0, 1.0])
@pytest.mark.parametrize(("friction", "rocks"), [(1.1, True), (0.9, False)], ids=["µ > tan α", "µ < tan α"])
def test_a_block_rocks_or_slides_by_friction_over_slenderness(friction, rocks, direction):
    tangent = math.tan(PRISM.critical_angle)
    body = rigid_body(PRISM)
    law = ContactLaw(damping_fraction=1.0, friction=friction * tangent).bearing(body, GRAVITY)
    level = 1.05 * GRAVITY * tangent * direction
    history = simulate(body, Motion(np.full(21, level), 0.01), law=law)
    moved = -direction * history.slide[-1, 0]
    assert (-direction * history.angle[-1] > 0.01 * PRISM.critical_angle) == rocks
    assert (moved > 1e-3) != rocks


def test_the_table_bears_the_weight_and_nothing_dies_out_at_rest():
    body = rigid_body(PRISM)
    history = simulate(body, _rest(0.1), law=ContactLaw().bearing(body, GRAVITY))
    weight = np.array([0.0, 0.0, PRISM.mass * GRAVITY])
    np.testing.assert_allclose(history.base_force[1:], np.broadcast_to(weight, (100, 3)), atol=1e-5 * weight[2])
    assert history.outcome == "no-rocking"
    assert history.impact_times.size == 0


def test_heavier_gravity_of_a_rising_table_presses_and_works():
    """Up with 2 m/s²: the base force is m (g + 2); the table's work is all that it has from it, seen from the table."""
    body = rigid_body(PRISM)
    lift = np.minimum(np.arange(101) / 50.0, 1.0) * 2.0
    history = simulate(body, Motion(np.zeros(101), 0.002, vertical=lift), law=ContactLaw().bearing(body, GRAVITY))
    assert history.base_force[-1, 2] == pytest.approx(PRISM.mass * (GRAVITY + 2.0), rel=1e-6)
