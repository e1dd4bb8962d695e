from __future__ import annotations

import numpy as np
import pytest

from colonnade.figures import Curve, envelope
from colonnade.figures.panels.curve import between


def noisy(samples: int = 60_000) -> Curve:
    return Curve(np.arange(samples) / 1000, np.random.default_rng(3).normal(size=samples))


def test_a_long_curve_is_thinned_and_keeps_its_ends_and_extremes():
    curve = noisy()
    thinned = envelope(curve, intervals=300)
    assert thinned.time.size <= 602
    assert thinned.values.max() == curve.values.max()
    assert thinned.values.min() == curve.values.min()
    assert (thinned.time[0], thinned.time[-1]) == (curve.time[0], curve.time[-1])
    assert (np.diff(thinned.time) > 0).all()


def test_every_interval_of_time_keeps_its_lowest_and_highest_value():
    curve = noisy(10_000)
    thinned = envelope(curve, intervals=10)
    for start, end in zip(range(0, 10_000, 1000), range(1000, 10_001, 1000), strict=True):
        part = curve.values[start:end]
        kept = thinned.values[(thinned.time >= curve.time[start]) & (thinned.time <= curve.time[end - 1])]
        assert kept.max() == pytest.approx(part.max(), abs=0.05)
        assert kept.min() == pytest.approx(part.min(), abs=0.05)


def test_a_short_curve_is_left_as_it_is():
    curve = noisy(500)
    assert envelope(curve) is curve


def test_a_spike_of_one_sample_is_not_lost():
    curve = Curve(np.arange(100_000) / 1000, np.zeros(100_000))
    curve.values[43_217] = 1.0
    thinned = envelope(curve)
    assert thinned.time[thinned.values == 1.0].tolist() == [43.217]


def test_a_gap_stays_a_gap():
    curve = noisy()
    curve.values[20_000:30_000] = np.nan
    thinned = envelope(curve)
    inside = (thinned.time > 20.2) & (thinned.time < 29.8)
    assert inside.sum() > 50
    assert np.isnan(thinned.values[inside]).all()
    assert np.isfinite(thinned.values[~inside]).sum() > 800


def test_arrays_of_different_length_are_refused():
    with pytest.raises(ValueError, match=r"time has shape \(3,\) and values \(2,\)"):
        envelope(Curve(np.zeros(3), np.zeros(2)))


def a_band(samples: int = 5001) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    time = np.linspace(0.0, 10.0, samples)
    centre = 0.4 * np.sin(4 * time)
    return time, centre - 0.01 * time, centre + 0.01 * time


def test_thinning_keeps_the_extremes_of_a_band():
    given, lowest, highest = a_band()
    time, below, above = between(given, lowest, highest, intervals=50)
    assert time.size <= 51
    assert (below.min(), above.max()) == (lowest.min(), highest.max())
    inside = np.searchsorted(np.linspace(0, 10, 51)[1:-1], given, side="right")
    assert (below[inside] <= lowest).all()
    assert (above[inside] >= highest).all()


def test_a_short_band_is_drawn_as_it_is():
    time, below, above = a_band(10)
    assert between(time, below, above)[0].tolist() == time.tolist()
