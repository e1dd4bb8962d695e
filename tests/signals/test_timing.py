import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.signals.timing import (
    check_order,
    check_steps,
    read_clock,
    resample,
)
from every import every

NUMBERS = np.arange(4000)
EVEN = NUMBERS / 500


def _reasons(stamps):
    clock = read_clock(stamps)
    return [
        check_order(stamps, clock).reason,
        *(verdict.reason for verdict in check_steps(clock, share=0.05, factor=1.5)),
    ]


@pytest.mark.parametrize("start", [0.0, -3.0, 1234.5])
def test_an_exact_clock_is_read_at_once_and_as_any_other(monkeypatch, start):
    stamps = start + EVEN
    at_once = read_clock(stamps)
    monkeypatch.setattr("colonnade.signals.timing._is_exact", lambda stamps: False)
    step_by_step = read_clock(stamps)
    assert at_once.is_exact
    assert not step_by_step.is_exact
    assert at_once.time.tolist() == step_by_step.time.tolist()
    assert (at_once.interval, at_once.resolution) == (step_by_step.interval, step_by_step.resolution)


def test_stamps_that_only_look_exact_where_numbers_are_coarse_are_not():
    """Seconds since 1970 are told to 0.24 µs, which is more than 1e-7 of a step."""
    clock = read_clock(1.7e9 + EVEN)
    assert not clock.is_exact
    assert "off an even clock" in check_steps(clock, share=1e-6, factor=1.5)[1].reason


@every("write", [np.round, lambda time, digits: np.floor(time * 10**digits) / 10**digits])
@every(("rate", "digits"), [(400, 3), (909, 3), (400, 2), (300, 4)])
def test_the_even_clock_behind_rounded_times_is_found(rate, digits, write):
    stamps = write(NUMBERS / rate, digits)
    clock = read_clock(stamps)
    assert 1 / clock.interval == pytest.approx(rate, rel=3e-5)
    assert clock.resolution == pytest.approx(10.0**-digits)
    assert np.ptp(clock.time - NUMBERS / rate) < 0.1 / rate
    assert _reasons(stamps) == ["", "", ""]


@pytest.mark.parametrize("digits", [2, 3])
def test_a_gap_in_rounded_times_stays_a_gap(digits):
    stamps = np.delete(np.round(NUMBERS / 400, digits), slice(1000, 1400))
    clock = read_clock(stamps)
    assert 1 / clock.interval == pytest.approx(400, rel=1e-4)
    verdict = check_steps(clock, share=0.05, factor=1.5)[0]
    assert np.flatnonzero(verdict.where).tolist() == [999, 1000]
    assert "1 gap in time, about 400 samples lost" in verdict.reason


def test_times_of_too_few_digits_for_their_length_are_not_read_as_an_even_clock():
    assert read_clock(np.floor(NUMBERS / 1000)).resolution == 0.0


@every("wild", [1e4, -5.0])
@every("count", [3, 40])
def test_stamps_that_are_wild_in_a_row_cost_no_others(wild, count):
    stamps = EVEN.copy()
    stamps[2000 : 2000 + count] = wild
    assert np.flatnonzero(~np.isfinite(read_clock(stamps).time)).tolist() == list(range(2000, 2000 + count))


@given(place=st.integers(0, 3999), wild=st.sampled_from([1e6, -1e6, 4.0, 7.9]))
def test_one_wild_time_stamp_costs_one_sample(place, wild):
    stamps = EVEN.copy()
    stamps[place] = wild
    clock = read_clock(stamps)
    lost = ~np.isfinite(clock.time)
    assert lost.sum() <= 1
    if abs(wild) > 10:
        assert np.flatnonzero(lost).tolist() == [place]
        assert "1 sample whose time is out of order" in check_order(stamps, clock).reason
        assert _reasons(stamps)[1:] == ["", ""]


def test_times_that_go_back_are_flagged():
    stamps = EVEN.copy()
    stamps[50:53] = stamps[40:43]
    assert np.flatnonzero(check_order(stamps, read_clock(stamps)).where).tolist() == [50, 51, 52]


@pytest.mark.parametrize("jump", [1000, 3500])
def test_a_clock_that_starts_again_is_told_where_it_does(jump):
    stamps = np.concatenate((EVEN[:jump], EVEN[: EVEN.size - jump]))
    reason = check_order(stamps, read_clock(stamps)).reason
    assert f"the clock goes from {EVEN[jump - 1]:.6g} to {EVEN[0]:.6g} s at sample {jump + 1:,}. They are" in reason


def test_jitter_is_told_apart_from_rounding():
    jittered = EVEN + np.random.default_rng(0).uniform(-3e-4, 3e-4, EVEN.size)
    assert "off an even clock" in _reasons(jittered)[2]
    assert read_clock(np.round(jittered, 5)).resolution == 0.0
    assert _reasons(np.round(EVEN, 5)) == ["", "", ""]


def test_a_missing_time_is_no_gap():
    stamps = EVEN.copy()
    stamps[[0, 70, 71]] = np.nan
    assert _reasons(stamps) == ["", "", ""]
    assert np.isnan(read_clock(np.array([1.0, np.nan, 1.0])).interval)
    assert _reasons(np.empty(0)) == ["", "", ""]


def test_a_sine_at_400_hz_is_brought_to_500_hz_within_the_stated_error():
    time, onto = np.arange(0, 2, 0.0025), np.arange(0.1, 1.9, 0.002)
    values, missing = resample(time, np.sin(2 * np.pi * 13 * time), onto, 0.0025)
    assert not missing.any()
    assert np.abs(values - np.sin(2 * np.pi * 13 * onto)).max() < 2e-5


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
