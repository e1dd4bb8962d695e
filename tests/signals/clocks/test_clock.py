import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.signals.clocks.clock import resample, sampling_interval, uniform_clock


def test_the_interval_is_that_of_the_even_steps():
    time = np.delete(np.round(np.arange(0, 2, 1 / 300), 4), slice(50, 80))
    assert sampling_interval(time) == pytest.approx(1 / 300, rel=1e-4)
    assert np.isnan(sampling_interval(np.array([1.0, 1.0])))


def test_a_uniform_clock_reaches_its_end_despite_rounding():
    assert uniform_clock(0.0, 0.3, 0.1).tolist() == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert uniform_clock(0.0, -1.0, 0.1).size == 0


def test_a_sine_at_400_hz_is_brought_to_500_hz_within_the_stated_error():
    time, onto = np.arange(0, 2, 0.0025), np.arange(0.1, 1.9, 0.002)
    values, missing = resample(time, np.sin(2 * np.pi * 13 * time), onto, 0.0025)
    assert not missing.any()
    assert np.abs(values - np.sin(2 * np.pi * 13 * onto)).max() < 2e-5


def test_the_same_clock_passes_values_untouched():
    time = np.arange(0, 1, 0.01)
    values = np.random.default_rng(0).normal(size=time.size)
    assert resample(time, values, time.copy(), 0.01)[0] is values


def test_a_long_gap_is_missing_and_a_short_one_a_straight_line():
    time = np.arange(0, 1, 0.01)
    long, short = np.delete(time, slice(40, 60)), np.delete(time, slice(40, 43))
    values, missing = resample(long, np.sin(9 * long), time, 0.01)
    assert np.flatnonzero(missing).tolist() == list(range(40, 60))
    assert np.abs(values).max() <= 1.0
    values, missing = resample(short, 5 * short, time, 0.01)
    assert not missing.any()
    np.testing.assert_allclose(values, 5 * time, atol=1e-12)


@given(start=st.floats(-0.5, 0.5), stop=st.floats(0.6, 1.6))
def test_what_lies_outside_the_record_is_missing(start, stop):
    time = np.arange(0, 1.001, 0.01)
    onto = np.linspace(start, stop, 50)
    _, missing = resample(time, time, onto, 0.01)
    assert (missing == ((onto < -1e-8) | (onto > 1 + 1e-8))).all()
