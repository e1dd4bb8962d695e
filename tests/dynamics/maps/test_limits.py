"""Intervals of overturning over amplitude: their edges and the limits that they make."""

from __future__ import annotations

import math

import numpy as np
import pytest

from colonnade.dynamics.maps.limits import limits_of, onset_of


def overturns(*intervals):
    """Outcomes of a column that overturns in known intervals."""
    return lambda amplitudes: np.array([2 * any(low <= a <= high for low, high in intervals) for a in amplitudes])


@pytest.mark.parametrize(
    "intervals",
    [[], [(0.0, 9.0)], [(1.23456, 2.5)], [(1.5, 1.8), (2.1, 2.35), (2.77, 9.0)], [(0.0, 1.2), (1.7, 1.9)]],
    ids=["none", "all", "one", "three, the last open", "from the smallest A on"],
)
def test_edges_of_intervals_are_found_to_the_given_closeness(intervals):
    scan = np.linspace(1.0, 3.0, 41)
    runs = overturns(*intervals)
    found = limits_of(scan, runs(scan), runs, width=0.05, edge=1e-4).intervals
    expected = np.clip(np.array(intervals).reshape(-1, 2), 1.0, 3.0)
    np.testing.assert_allclose(found, expected, atol=1e-4)


def test_a_gap_narrower_than_the_width_makes_no_upper_limit():
    scan, runs = np.linspace(1.0, 3.0, 201), overturns((1.5, 2.2), (2.25, 9.0))
    wide, narrow = (limits_of(scan, runs(scan), runs, width=width, edge=1e-6) for width in (0.1, 0.02))
    assert (wide.lower, wide.upper) == pytest.approx((1.5, 1.5), abs=1e-6)
    assert (narrow.lower, narrow.upper) == pytest.approx((1.5, 2.25), abs=1e-6)
    assert math.isnan(limits_of(scan, runs(scan), overturns(), width=5.0, edge=1e-6).lower)


@pytest.mark.parametrize(
    ("starts", "found"),
    [(1.234, 1.234), (0.5, 1.0), (9.0, math.nan)],
    ids=["inside", "from the smallest A on", "never"],
)
def test_the_onset_is_searched_between_the_last_rest_and_the_first_rocking(starts, found):
    scan = np.linspace(1.0, 3.0, 21)

    def runs(amplitudes):
        # Rests again between 2.0 and 2.5: the onset is the first.
        moves = (amplitudes >= starts) & ~((amplitudes > 2.0) & (amplitudes < 2.5))
        return moves.astype(np.int8)

    assert onset_of(scan, runs(scan), runs, edge=1e-4) == pytest.approx(found, abs=1e-4, nan_ok=True)
