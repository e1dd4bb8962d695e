"""A view projects points, marks what points out of the paper, and keeps labels apart."""

from itertools import pairwise
from math import cos, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from colonnade.dynamics.block import Block
from colonnade.figures.drawing.view import Rocking, View, _spaced


def view(orientation):
    return View.within(Figure(figsize=(4, 4)), (0.0, 0.0, 4.0, 4.0), (4.0, 4.0), orientation, 0.1, (2.0, 1.0))


@given(st.lists(st.floats(-1.0, 11.0), max_size=9))
def test_labels_stay_apart_and_within_the_view(wanted):
    placed = _spaced(sorted(wanted), 1.0, 0.0, 10.0)
    assert len(placed) == len(wanted)
    assert all(after - before >= 1.0 - 1e-9 for before, after in pairwise(placed))
    assert all(-1e-9 <= each <= 10.0 + 1e-9 for each in placed)


def test_the_centre_of_mass_is_nearer_to_the_pole_of_the_smaller_angle():
    block = Block.measured(mass=80, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.24), inertia=41.2)
    rocking = Rocking.of(block)
    (left, right), (x, z) = rocking.poles, rocking.centre
    assert x - left == pytest.approx(0.61 * sin(0.21))
    assert right - x == pytest.approx(0.60 * sin(0.24))
    assert left == -right
    assert z == pytest.approx((0.61 * cos(0.21) + 0.60 * cos(0.24)) / 2)
