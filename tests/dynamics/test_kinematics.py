import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.kinematics import point_displacement
from prism import PRISM


def test_the_active_pole_stays_and_the_other_edge_lifts():
    corners = [[0.043, 0.0, 0.0], [-0.043, 0.0, 0.0]]
    moved = point_displacement([0.1], corners, PRISM)[:, 0]
    assert moved[0] == pytest.approx([0, 0, 0], abs=1e-15)
    assert moved[1, 2] == pytest.approx(0.086 * np.sin(0.1))


def test_the_top_moves_to_plus_x_for_positive_angles():
    assert point_displacement([0.1], [0.0, 0.0, 0.456], PRISM)[0, 0, 0] > 0
    assert point_displacement([-0.1], [0.0, 0.0, 0.456], PRISM)[0, 0, 0] < 0


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


def test_the_centre_of_mass_stands_over_the_pole_at_the_critical_angle():
    centre = np.array([0.0, 0.0, 0.228])
    moved = centre + point_displacement([PRISM.critical_angle], centre, PRISM)[0, 0]
    assert moved[0] == pytest.approx(0.043, abs=1e-15)
