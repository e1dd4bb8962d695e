import numpy as np
import pytest

from colonnade.signals.quality import Flag
from colonnade.signals.record import even_record, on_clock, smoothed

TIME = np.arange(0, 4, 0.002)
GOOD = np.full(TIME.size, Flag.GOOD, dtype=np.int8)


def _brought(record, clock, cutoff=40.0):
    return on_clock(record, smoothed(record, cutoff, 4)[0], clock)


def test_what_lies_above_the_cut_off_does_not_come_back_at_a_lower_rate():
    time, clock = np.arange(0, 12, 0.001), np.arange(0.5, 11.5, 0.005)
    values = np.sin(2 * np.pi * time) + 0.1 * np.sin(2 * np.pi * 190 * time)
    record = even_record(time, values, np.full(time.size, Flag.GOOD, dtype=np.int8))
    brought, _ = _brought(record, clock)
    assert np.sqrt(np.mean((brought - np.sin(2 * np.pi * clock)) ** 2)) < 1e-4


@pytest.mark.parametrize("times", [1, 5, 50, 400])
def test_a_far_slower_clock_has_the_values_of_the_smoothed_record(times):
    rate = 400 * times
    time, clock = np.arange(6 * rate + 1) / rate, np.arange(2401) / 400
    noise = np.random.default_rng(2).normal(0, 0.01, time.size)
    record = even_record(time, np.sin(2 * np.pi * 7 * time) + noise, np.full(time.size, Flag.GOOD, dtype=np.int8))
    smooth, _ = smoothed(record, 35.0, 4)
    brought, flags = on_clock(record, smooth, clock)
    np.testing.assert_allclose(brought, smooth[::times], atol=1e-5)
    assert (flags == Flag.GOOD).all()


def test_a_long_run_without_values_is_missing_and_a_short_one_a_suspect_line():
    values, flags = 5 * TIME, GOOD.copy()
    for run in (slice(500, 504), slice(1000, 1180)):
        values[run], flags[run] = np.nan, Flag.MISSING
    brought, judged = _brought(even_record(TIME, values, flags), TIME)
    assert (judged[500:504] == Flag.SUSPECT).all()
    np.testing.assert_allclose(brought[500:504], 5 * TIME[500:504], atol=1e-6)
    assert np.flatnonzero(judged == Flag.MISSING).tolist() == list(range(1000, 1180))
    assert (np.isnan(brought) == (judged == Flag.MISSING)).all()
    assert (np.delete(judged, [*range(500, 504), *range(1000, 1180)]) == Flag.GOOD).all()


@pytest.mark.parametrize(("lost", "flag"), [(3, Flag.SUSPECT), (30, Flag.MISSING)])
def test_an_end_without_values_is_held_only_when_it_is_short(lost, flag):
    values = np.cos(TIME)
    values[:lost] = values[-lost:] = np.nan
    brought, judged = _brought(even_record(TIME, values, GOOD), TIME)
    assert (judged[:lost] == flag).all()
    assert (judged[-lost:] == flag).all()
    assert np.isfinite(brought).all() == (flag == Flag.SUSPECT)


def test_a_sample_whose_stamp_is_lost_is_bridged_and_suspect():
    stamps, values = TIME.copy(), np.sin(TIME)
    stamps[9] = 1e6
    record = even_record(stamps, values, GOOD)
    brought, judged = _brought(record, TIME)
    assert np.flatnonzero(judged != Flag.GOOD).tolist() == [9]
    np.testing.assert_allclose(brought[50:-50], np.sin(TIME)[50:-50], atol=1e-6)


@pytest.mark.parametrize(
    ("stamps", "values", "words"),
    [
        (TIME, np.full(TIME.size, np.nan), "no usable sample among its 2000"),
        (np.where(TIME < 2, TIME, TIME + 1e6), TIME, r"2000 samples at 500 Hz over 1e\+06 s"),
    ],
    ids=["nothing recorded", "times too far apart"],
)
def test_a_record_without_use_is_refused(stamps, values, words):
    with pytest.raises(ValueError, match=words):
        even_record(stamps, values, GOOD)
