"""Columns of a map, its limits, and maps of the contact model."""

import math

import numpy as np
import pytest

from colonnade.dynamics.maps import MapPlan, _fraction, map_part
from colonnade.dynamics.plane.run import SAMPLES_A_CYCLE, Harmonic
from colonnade.dynamics.search import limits_of, onset_of
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
        monkeypatch.setattr("colonnade.dynamics.maps.runs_of", lambda *_: overturns(*intervals))
        plan = MapPlan(PRISM, frequency_ratio=[2.0], amplitude_ratio=[1.0, 2.0, 3.0], width=width)
        return map_part(plan, [0])

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
    assert (column.lower[0], column.upper[0]) == pytest.approx((lower, upper), abs=1e-4, nan_ok=True)


def test_islands_are_kept_apart_with_their_share_of_a_cell(column_of):
    column = column_of((1.2, 1.22), (1.5, 9.0))
    assert column.overturning_fraction[0] == pytest.approx([0.04, 1.0, 1.0], abs=1e-3)
    assert column.islands == pytest.approx(np.array([[2.0, 1.2, 1.22]]), abs=1e-4)


@pytest.mark.parametrize(
    "intervals",
    [[], [(0.0, 9.0)], [(1.23456, 2.5)], [(1.5, 1.8), (2.1, 2.35), (2.77, 9.0)], [(0.0, 1.2), (1.7, 1.9)]],
    ids=["none", "all", "one", "three, the last open", "from the smallest A on"],
)
def test_edges_of_intervals_are_found_to_the_given_closeness(intervals):
    scan = np.linspace(1.0, 3.0, 41)
    runs = overturns(*intervals)
    found = limits_of(scan, runs, width=0.05, edge=1e-4).intervals
    expected = np.clip(np.array(intervals).reshape(-1, 2), 1.0, 3.0)
    np.testing.assert_allclose(found, expected, atol=1e-4)


def test_a_gap_narrower_than_the_width_makes_no_upper_limit():
    scan, runs = np.linspace(1.0, 3.0, 201), overturns((1.5, 2.2), (2.25, 9.0))
    wide, narrow = (limits_of(scan, runs, width=width, edge=1e-6) for width in (0.1, 0.02))
    assert (wide.lower, wide.upper) == pytest.approx((1.5, 1.5), abs=1e-6)
    assert (narrow.lower, narrow.upper) == pytest.approx((1.5, 2.25), abs=1e-6)
    assert math.isnan(limits_of(scan, runs, width=5.0, edge=1e-6).lower)


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


def test_the_samples_are_those_of_the_sine():
    harmonic = Harmonic.cycles(10.0, 3.0, phase=0.4, ramp=1.0)
    wave, dt = harmonic.sampled(1.0)
    period = 2 * np.pi / 10.0
    assert dt == pytest.approx(period / SAMPLES_A_CYCLE)
    time = dt * np.arange(wave.size - 1)
    full = (time >= period) & (time <= 4 * period)
    np.testing.assert_allclose(wave[:-1][full], np.sin(10.0 * time[full] + 0.4), atol=1e-9)
    half = round(0.5 * period / dt)
    assert wave[half] == pytest.approx(0.5 * np.sin(10.0 * 0.5 * period + 0.4))
    assert wave[0] == wave[-1] == 0.0
    assert time[-1] == pytest.approx(5 * period)
