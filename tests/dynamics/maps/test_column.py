"""One column of a map: edges of intervals, cells, limits by their definition, islands."""

from __future__ import annotations

import math

import numpy as np
import pytest

from colonnade.dynamics.maps.chart import assemble
from colonnade.dynamics.maps.column import _fraction, map_column
from colonnade.dynamics.maps.plan import plan_map
from prism import PRISM


def overturns(*intervals):
    """Outcomes of a column that overturns in known intervals."""
    return lambda amplitudes: np.array([2 * any(low <= a <= high for low, high in intervals) for a in amplitudes])


def test_the_fraction_of_a_cell_is_what_intervals_cover_of_it():
    amplitudes = np.array([1.0, 2.0, 3.0, 4.0])
    intervals = np.array([[1.25, 1.75], [2.75, 4.0]])
    np.testing.assert_allclose(_fraction(amplitudes, intervals), [0.5, 0.25, 0.75, 1.0])


@pytest.fixture
def column_of(monkeypatch):
    """A column whose block overturns in given intervals of A."""

    def make(*intervals, width=0.05):
        monkeypatch.setattr("colonnade.dynamics.maps.column._runs", lambda plan, omega: overturns(*intervals))
        plan = plan_map(PRISM, frequency_ratio=[2.0], amplitude_ratio=[1.0, 2.0, 3.0], width=width)
        return map_column(plan, 0)

    return make


@pytest.mark.parametrize(
    ("intervals", "lower", "upper"),
    [
        ([], math.nan, math.nan),
        ([(1.5, 9.0)], 1.5, 1.5),
        ([(1.2, 1.22), (1.5, 9.0)], 1.5, 1.5),
        ([(1.5, 1.8), (2.2, 9.0)], 1.5, 2.2),
        ([(1.5, 2.2), (2.22, 9.0)], 1.5, 1.5),
        ([(1.5, 2.2)], 1.5, math.nan),
        ([(0.0, 9.0)], 1.0, math.nan),
    ],
    ids=[
        "no overturning",
        "one limit",
        "an island below the limit",
        "two limits",
        "a gap too narrow to count",
        "the largest A survives",
        "nothing survives",
    ],
)
def test_limits_follow_their_definition(column_of, intervals, lower, upper):
    column = column_of(*intervals)
    assert (column.lower, column.upper) == pytest.approx((lower, upper), abs=1e-4, nan_ok=True)


def test_islands_are_kept_apart_with_their_share_of_a_cell(column_of):
    column = column_of((1.2, 1.22), (1.5, 9.0))
    assert column.intervals[0] == pytest.approx([1.2, 1.22], abs=1e-4)
    assert column.overturning_fraction == pytest.approx([0.04, 1.0, 1.0], abs=1e-3)
    plan = plan_map(PRISM, frequency_ratio=[2.0], amplitude_ratio=[1.0, 2.0, 3.0], width=0.05)
    assert assemble(plan, [column]).islands == pytest.approx(np.array([[2.0, 1.2, 1.22]]), abs=1e-4)
