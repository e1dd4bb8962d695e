"""Which corners may touch, where they are and how fast they go."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import flight, points


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
