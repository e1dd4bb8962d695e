"""Kinematics, motions and similitude."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.size import at_prototype
from prism import PRISM


def test_the_active_pole_stays_and_the_other_edge_lifts():
    corners = [[0.043, 0.0, 0.0], [-0.043, 0.0, 0.0]]
    moved = point_displacement([0.1], corners, PRISM)[:, 0]
    assert moved[0] == pytest.approx([0, 0, 0], abs=1e-15)
    assert moved[1, 2] == pytest.approx(0.086 * np.sin(0.1))


@given(
    angle=st.floats(-0.5, 0.5),
    first=st.tuples(*[st.floats(-1, 1)] * 3),
    second=st.tuples(*[st.floats(-1, 1)] * 3),
    slide=st.floats(-0.1, 0.1),
)
def test_distances_between_points_are_kept(angle, first, second, slide):
    points = np.array([first, second])
    moved = points + point_displacement([angle], points, PRISM, slide)[:, 0]
    assert np.linalg.norm(moved[1] - moved[0]) == pytest.approx(np.linalg.norm(points[1] - points[0]), abs=1e-12)


@pytest.mark.parametrize(
    ("acceleration", "dt", "words"),
    [
        ([], 0.1, "at least one sample"),
        ([[1.0]], 0.1, "1-dimensional"),
        ([1.0, np.nan], 0.1, "sample 1"),
        ([1.0], 0.0, "dt is"),
    ],
)
def test_a_record_that_cannot_be_a_motion_is_refused_with_the_place(acceleration, dt, words):
    with pytest.raises(ValueError, match=words):
        Motion(acceleration, dt)


def test_a_vertical_record_of_another_length_is_refused():
    with pytest.raises(ValueError, match="vertical has 2 samples; 3 were expected"):
        Motion([0.0, 1.0, 2.0], 0.1, vertical=[0.0, 1.0])


SCALE = 20.0
MODEL = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
PROTOTYPE = Block.prism(width=1.72, depth=1.72, height=9.12, mass=26.10 * SCALE**3)


@pytest.mark.parametrize(
    ("quantity", "name"), [("length", "pole_distance"), ("frequency", "p"), ("mass", "mass"), ("inertia", "inertia")]
)
def test_a_block_of_prototype_size_has_the_scaled_properties(quantity, name):
    assert at_prototype(quantity, getattr(MODEL, name), SCALE) == pytest.approx(getattr(PROTOTYPE, name), rel=1e-12)


def test_the_prototype_rocks_as_the_model_in_scaled_time():
    base = 1.8 * MODEL.uplift_acceleration * np.sin(2 * np.pi * 4 * np.arange(0, 3, 0.002))
    model = rock(MODEL, Motion(base, 0.002), restitution=0.9, model="nonlinear")
    prototype = rock(PROTOTYPE, Motion(base, at_prototype("time", 0.002, SCALE)), restitution=0.9, model="nonlinear")
    assert model.outcome == "rocking"
    np.testing.assert_allclose(prototype.angle, model.angle, atol=1e-9)


def test_gravity_is_the_same_for_both():
    assert at_prototype("acceleration", 9.81, SCALE) == 9.81
    assert at_prototype("velocity", 1.0, SCALE) == pytest.approx(
        at_prototype("length", 1.0, SCALE) / at_prototype("time", 1.0, SCALE)
    )
