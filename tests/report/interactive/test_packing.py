"""Samples are packed and unpacked without loss beyond a millionth, and small."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.signal import butter, sosfiltfilt

from colonnade.report.interactive.panels import packed

numbers = st.floats(-1e12, 1e12) | st.just(float("nan")) | st.floats(1e-20, 1e-9)


@given(st.lists(arrays(np.float64, st.integers(0, 60), elements=numbers), max_size=4))
def test_what_is_unpacked_is_what_was_packed_to_a_millionth_of_the_largest(unpacked, series):
    found = unpacked(packed(series))
    assert len(found) == len(series)
    for before, after in zip(series, found, strict=True):
        assert np.array_equal(np.isnan(before), np.isnan(after))
        largest = np.nanmax(np.abs(before), initial=0.0) if np.isfinite(before).any() else 0.0
        np.testing.assert_allclose(after, before, rtol=0, atol=1e-6 * largest + 1e-37, equal_nan=True)


def test_the_largest_jumps_fit(unpacked):
    jumps = np.array([1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
    assert np.array_equal(unpacked(packed([jumps]))[0], jumps)


def test_a_test_of_half_a_minute_with_eight_channels_and_two_models_takes_two_megabytes_at_most():
    random, time = np.random.default_rng(1), np.arange(30_000) / 1000
    smooth = butter(4, 35, fs=1000, output="sos")
    series = []
    for channel in range(8):
        reading = np.sin(2 * np.pi * (3 + channel) * time) + random.normal(scale=1e-3, size=time.size)
        series += [np.round(reading * 2**15) / 2**15, sosfiltfilt(smooth, reading)]
    # Angles, their misfits, two bands of each model, motions and base motion.
    series += [sosfiltfilt(smooth, random.normal(size=time.size)) for _ in range(17)]
    assert len(packed(series).text) < 2_000_000


@pytest.mark.parametrize("count", [0, 1, 2])
def test_short_series(unpacked, count):
    assert unpacked(packed([np.arange(count, dtype=float)]))[0].tolist() == list(range(count))
