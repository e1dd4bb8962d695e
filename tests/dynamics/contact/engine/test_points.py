"""Points of contact: their state, forces, and samples between steps."""

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import flight, force, points, sample
from colonnade.dynamics.contact.engine.state import COLUMNS, POINTS, Near, State


def turned(state, angle):
    """Turn a body about y."""
    state.rigid[6:10] = np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0
    flight.fill_rotation(state)


def test_corners_lower_than_the_margin_are_listed_with_their_depths(engine):
    body, state, near = engine(sunk=0.01)
    turned(state, 0.1)
    # The corners at +x sink, those at −x rise.
    heights = state.rigid[2] + body.nodes @ state.matrix[2]
    count = points.place_nodes(body, state, near, 0.0)
    assert list(near.node[:count]) == list(near.slot[:count]) == [2, 3]
    np.testing.assert_allclose(near.depth[:count], -heights[2:])
    np.testing.assert_allclose(near.lever[:count, :3], body.nodes[2:] @ state.matrix.T)
    np.testing.assert_allclose(near.lever[:count, 3:], body.nodes[2:])
    assert points.place_nodes(body, state, near, 1.0) == 4


def test_a_mode_moves_the_corners(engine):
    body, state, near = engine(frequency=10.0)
    state.strain[0, 0] = -0.04
    assert points.place_nodes(body, state, near, 0.0) == 4
    np.testing.assert_allclose(near.depth, 0.25 * 0.04)


def test_velocities_are_those_of_a_turning_body_that_swings(engine):
    body, state, near = engine(frequency=10.0)
    turned(state, 0.3)
    count = points.place_nodes(body, state, near, 1.0)
    near.speeds[:] = 0.1, 0.2, 0.3, 1.0, -2.0, 0.5
    near.rates[0] = 0.8
    points.fill_velocities(body, state, near, count)
    swinging = state.matrix @ np.array([0.0, 0.0, 0.25 * 0.8])
    expected = near.speeds[:3] + np.cross(near.speeds[3:], near.lever[:count, :3]) + swinging
    np.testing.assert_allclose(near.load[:count, 9:12], expected, atol=1e-15)


@pytest.mark.parametrize("seed", range(5))
def test_no_corner_is_faster_than_the_bound(engine, seed):
    random = np.random.default_rng(seed)
    body, state, near = engine(frequency=10.0, velocity=random.normal(size=3), spin=random.normal(size=3))
    state.strain[1, 0] = random.normal()
    bound = points.fastest(body, state, np.linalg.norm(body.nodes[0]), 0.25)
    count = points.place_nodes(body, state, near, 10.0)
    near.speeds[:3], near.speeds[3:] = state.rigid[3:6], state.rigid[10:13] / body.inertia
    near.rates[0] = state.strain[1, 0]
    points.fill_velocities(body, state, near, count)
    assert np.abs(near.load[:count, 11]).max() <= bound


def test_a_state_begins_without_contact_and_keeps_its_own_numbers(engine):
    body, _, _ = engine(frequency=5.0)
    rigid = np.arange(13)
    state = State.begin(body, rigid)
    rigid[0] = 99
    np.testing.assert_array_equal(state.rigid, np.arange(13.0))
    assert not any(part.any() for part in state[1:])
    assert (state.strain.shape, state.slip.shape) == ((2, 1), (4, 2))


def test_a_ring_has_room_for_its_points(engine):
    body, _, _ = engine()
    ringed = body._replace(radii=np.array([0.0, 0.1, 0.0, 0.0]), slots=np.cumsum([0, 1, POINTS, 1, 1]))
    near = Near.room(ringed)
    assert near.depth.shape == (POINTS + 3,)
    assert near.load.shape == (POINTS + 3, 14)
    assert State.begin(ringed, np.zeros(13)).slip.shape == (POINTS + 3, 2)


STEP = 1e-3
DEPTH = 0.01
FIRM = 1000.0 * DEPTH
"""Of the spring at that depth, N."""


def pressed(engine, *, depth=DEPTH, velocity=(0.0, 0.0, 0.0), slip=(0.0, 0.0), growth=(0.0, 0.0), share=1.0):
    """Give the row of one point's load."""
    body, state, near = engine()
    near.share[0], near.depth[0] = share, depth
    near.load[0, 9:12], near.load[0, 12:14] = velocity, growth
    state.slip[0] = slip
    force.fill_force(body, state, near, 0, STEP)
    return near.load[0]


def test_at_rest_it_is_a_spring(engine):
    np.testing.assert_allclose(pressed(engine)[:4], [0.0, 0.0, FIRM, FIRM])


def test_a_point_above_the_table_feels_nothing(engine):
    assert not pressed(engine, depth=-DEPTH)[:4].any()


def test_sinking_it_is_damped_too(engine):
    load = pressed(engine, velocity=(0.0, 0.0, -0.3))
    assert (load[2], load[3]) == pytest.approx((FIRM + 20.0 * 0.3, FIRM))


def test_the_table_never_pulls(engine):
    assert pressed(engine, velocity=(0.0, 0.0, 5.0))[2] == 0.0


def test_a_point_that_arrives_in_the_middle_of_a_step_counts_for_half_of_it(engine):
    """Its depth goes from −s/2 to s/2: for half of the step it is s/4 deep in the mean."""
    sinking = 5.0 * STEP
    load = pressed(engine, depth=0.0, velocity=(0.0, 0.0, -5.0))
    assert load[3] == pytest.approx(1000.0 * 0.5 * sinking / 4)
    assert load[2] == pytest.approx(load[3] + 0.5 * 20.0 * 5.0)


def test_the_share_of_a_ring_scales_all_of_it(engine):
    given = {"velocity": (0.02, -0.01, -0.3), "growth": (1e-4, 2e-4)}
    np.testing.assert_allclose(pressed(engine, share=0.25, **given)[:4], 0.25 * pressed(engine, **given)[:4])


def test_below_the_limit_it_sticks_on_a_spring_and_a_damper(engine):
    load = pressed(engine, slip=(0.002, 0.0), growth=(0.001, -0.001), velocity=(0.05, 0.02, 0.0))
    assert load[:2] == pytest.approx([-400.0 * 0.003 - 10.0 * 0.05, 400.0 * 0.001 - 10.0 * 0.02])
    assert tuple(load[4:7]) == pytest.approx((0.003, -0.001, 1.0))


def test_beyond_it_slides_by_coulombs_law_against_its_slip(engine):
    load = pressed(engine, growth=(0.3, 0.4), velocity=(3.0, 4.0, 0.0))
    assert load[:2] == pytest.approx([-0.5 * FIRM * 0.6, -0.5 * FIRM * 0.8])
    assert load[6] == 0.0
    assert 400.0 * np.hypot(*load[4:6]) == pytest.approx(0.5 * FIRM)


def test_the_damper_of_a_point_that_sticks_stays_within_the_limit(engine):
    assert np.hypot(*pressed(engine, velocity=(3.0, 4.0, 0.0))[:2]) == pytest.approx(0.5 * FIRM)


def test_slip_that_a_lighter_force_holds_no_longer_is_let_go(engine):
    load = pressed(engine, slip=(1.0, 0.0))
    assert load[7:9] == pytest.approx([0.5 * FIRM / 400.0, 0.0])


def row_of(made):
    row = np.zeros(COLUMNS)
    sample.fill_sample(*made, row)
    return row


def test_the_state_is_in_it(engine):
    row = row_of(engine(velocity=(1.0, 2.0, 3.0), spin=(0.4, 0.5, 0.6)))
    np.testing.assert_allclose(row[:10], [0, 0, 1, 1, 2, 3, 1, 0, 0, 0])
    np.testing.assert_allclose(row[10:13], [0.4, 0.5, 0.6])
    assert not row[14:17].any()


def test_the_energies_are_those_of_the_formulas(engine):
    made = engine(velocity=(1.0, 2.0, 3.0), spin=(0.4, 0.5, 0.6), sunk=0.02, frequency=7.0)
    made.state.strain[:, 0] = 0.0, 0.3
    made.state.slip[1], made.state.touched[1] = (0.01, 0.02), 1
    made.state.slip[2] = 1.0, 1.0  # of a corner that is off the table
    turning = 0.5 * np.array([2.0, 3.0, 0.5]) @ np.array([0.4, 0.5, 0.6]) ** 2
    row = row_of(made)
    assert row[17] == pytest.approx(0.5 * 8.0 * 14.0 + turning + 0.5 * 0.3**2)
    assert row[18] == pytest.approx(8.0 * 10.0 * 0.98)
    assert row[20] == pytest.approx(4 * 0.5 * 1000.0 * 0.02**2 + 0.5 * 400.0 * (0.01**2 + 0.02**2))
    assert row[13] == pytest.approx(-0.02)


def test_a_strained_mode_holds_energy_and_lifts_the_base(engine):
    made = engine(frequency=7.0)
    made.state.strain[0, 0] = 0.2
    row = row_of(made)
    assert row[19] == pytest.approx(0.5 * (7.0 * 0.2) ** 2)
    assert row[13] == pytest.approx(0.25 * 0.2)
    assert row[20] == 0.0
