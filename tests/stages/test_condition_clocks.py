"""Channels on even clocks of their own, delays between recorders, and the one clock that a test is put on."""

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import Channel
from colonnade.errors import StageError
from colonnade.findings import Severity
from colonnade.signals.alignment import ClockRate, Offset
from colonnade.signals.quality import Flag
from colonnade.signals.record import Record
from colonnade.stages.condition import common_clock, own_records, recorder_offsets
from every import every

TOGETHER = Offset(0.0, np.nan, 0.0)
LATE = 0.03
"""s, by which the second recorder is late."""


def channel(direction=(1, 0, 0), recorder="main"):
    """A channel of the table; without a direction it is one of force."""
    shaking = {"quantity": "acceleration", "unit": "g", "on": "table", "direction": direction}
    what = shaking if direction else {"quantity": "force", "unit": "N"}
    return Channel.model_validate({"column": "a", "recorder": recorder, **what})


def record(start, stop, rate, values=None):
    """A record without fault from `start` up to `stop` (s)."""
    time = start + np.arange(round((stop - start) * rate) + 1) / rate
    fine = np.zeros(time.size, dtype=bool)
    values = np.zeros(time.size) if values is None else values(time)
    return Record(time, values, fine, 1 / rate, time, np.full(time.size, Flag.GOOD, dtype=np.int8), fine)


def shaking(time):
    """A motion of several frequencies that begins and ends within the record."""
    envelope = np.clip(np.minimum(time - 1.0, 7.0 - time), 0.0, 1.0)
    return envelope * (np.sin(2 * np.pi * 2.3 * time) + 0.6 * np.sin(2 * np.pi * 3.7 * time + 1.0))


RISING = np.arange(20.0)


def recorded(name, values=RISING, flag=Flag.GOOD):
    """One channel as the result of `ingest`, at 100 Hz from 5 s on."""
    flags = np.full(values.size, flag, dtype=np.int8)
    clock = {"elapsed": 5.0 + 0.01 * np.arange(values.size)}
    return xr.Dataset({name: ("elapsed", values), f"{name}_quality": ("elapsed", flags)}, coords=clock)


@every(("values", "flag"), [(np.full(20, np.nan), Flag.MISSING), (RISING, Flag.FAIL)])
def test_a_channel_without_a_usable_sample_is_left_out_and_the_others_stay(values, flag):
    both = xr.merge([recorded("top", values, flag), recorded("bottom_left")])
    warnings = []
    assert list(own_records(both, {"top": channel(), "bottom-left": channel()}, warnings)) == ["bottom-left"]
    (finding,) = warnings
    assert (finding.kind, finding.severity) == ("channel left out", Severity.SERIOUS)
    assert finding.text.startswith("channel top is left out: it has no usable sample among its 20")


LINKED = {"one": channel(), "other": channel(recorder="second")}


def offsets_of(records, linked=LINKED, longest=0.5):
    warnings = []
    found = recorder_offsets(records, linked, {"second": ("one", "other")}, longest, warnings)
    assert found["main"] == Offset(0.0, 0.0, 1.0)
    return found, warnings


ALONG = [1, 0, 0]


@every("late", [-0.11, LATE])
@every(
    ("first", "second", "sign"),
    [(ALONG, ALONG, 1.0), (ALONG, [-1, 0, 0], -1.0), (ALONG, [0, 1, 0], 1.0), (None, [-1, 0, 0], 1.0)],
)
def test_a_recorder_is_as_late_as_its_linked_channel_by_the_sign_of_their_directions(late, first, second, sign):
    other = record(0, 9, 250, lambda time: sign * shaking(time - late))
    linked = {"one": channel(first), "other": channel(second, "second")}
    found, warnings = offsets_of({"one": record(0, 9, 500, shaking), "other": other}, linked)
    assert found["second"].seconds == pytest.approx(late, abs=2e-4)
    assert warnings == []


def test_a_link_of_the_wrong_sign_is_warned_of_and_still_aligned():
    other = record(0, 9, 250, lambda time: -shaking(time - LATE))
    found, warnings = offsets_of({"one": record(0, 9, 500, shaking), "other": other})
    assert found["second"].seconds == pytest.approx(LATE, abs=2e-4)
    (finding,) = warnings
    assert (finding.kind, finding.severity) == ("clock", Severity.WARNING)
    assert "recorder second was aligned with one and other" in finding.text
    assert "sign" in finding.follows


@every(
    "records",
    [
        {"one": record(0, 9, 500, shaking)},
        {"other": record(0, 9, 250, shaking)},
        {"one": record(0, 9, 500), "other": record(0, 9, 250)},
    ],
)
def test_a_link_that_was_left_out_or_does_not_move_leaves_the_recorder_unaligned(records):
    found, warnings = offsets_of(records)
    assert list(found) == ["main"]
    assert warnings[0].severity == Severity.SERIOUS
    assert "recorder second was assumed to start with the main one" in warnings[0].text
    assert {"dead channel", "channel left out"} <= set(warnings[0].follows)


def test_linked_channels_that_share_no_time_are_refused():
    with pytest.raises(StageError, match=r"channels one and other share 0 samples.*Check the times in their files"):
        offsets_of({"one": record(0, 9, 500, shaking), "other": record(20, 29, 250, shaking)})


def test_a_clock_that_runs_fast_is_noted_with_its_rate():
    rate = 500e-6
    one = record(0, 9, 500, shaking)
    other = record(0, 9, 500, lambda time: shaking(time / (1 + rate)))
    found, warnings = offsets_of({"one": one, "other": other})
    assert found["second"].drift.rate == pytest.approx(rate, rel=0.1)
    assert [(each.kind, each.severity) for each in warnings] == [("clock drift", Severity.NOTE)]
    assert "ppm fast against the main recorder's, by one and other" in warnings[0].text


def common(records, rate="auto", channels=None, offsets=None):
    channels = channels or {name: channel() for name in records}
    offsets = dict.fromkeys(records, TOGETHER) | (offsets or {})
    return common_clock(records, offsets, channels, rate)


def test_the_clock_falls_on_samples_of_the_leading_channel():
    fast = record(0.0, 8.0, 500)
    clock = common({"fast": fast, "slow": record(1.0007, 9.0, 100)})
    assert clock[0] == pytest.approx(1.002)
    np.testing.assert_allclose(np.interp(clock, fast.time, fast.time), clock)


OWN = {"own": channel(), "other": channel(recorder="second")}


@every(
    ("channels", "interval"),
    [(OWN, 0.01), ({"own": channel(recorder="second"), "other": channel(recorder="third")}, 0.001)],
)
def test_the_main_recorder_leads_even_if_another_is_faster_and_without_it_the_fastest(channels, interval):
    clock = common({"own": record(0, 4, 100), "other": record(0, 4, 1000)}, channels=channels)
    assert np.diff(clock) == pytest.approx(interval)


@every(("rate", "own"), [(5000, 5000), (5001, 5001), (8000, 5000), (100_000, 5000)])
def test_a_clock_far_faster_than_rocking_is_slowed_down_unless_it_is_asked_for(rate, own):
    records = {"a": record(0.1, 0.6, rate)}
    assert 1 / np.diff(common(records)) == pytest.approx(own)
    assert 1 / np.diff(common(records, rate=float(rate))) == pytest.approx(rate)


DRIFT = ClockRate(rate=0.01, standard_error=1e-6, middle=0.0, change=0.04)


@every(
    ("offset", "first", "last"),
    [
        (Offset(0.5, 0.001, 0.99), 0.0, 3.5),
        (Offset(-0.5, 0.001, 0.99), 0.5, 4.0),
        (Offset(0.0, 0.001, 0.99, drift=DRIFT), 0.0, 4.0 * (1 - 0.01)),
    ],
)
def test_the_shared_time_counts_on_the_clock_of_the_main_recorder(offset, first, last):
    records = {"own": record(0, 4, 100), "other": record(0, 4, 100)}
    clock = common(records, channels=OWN, offsets={"other": offset})
    assert (clock[0], clock[-1]) == pytest.approx((first, last))


@pytest.mark.parametrize(("stop", "words"), [(0.14, "share 0.14 s, 15 samples"), (-0.5, "share 0 s, no sample")])
def test_channels_that_share_too_little_are_refused(stop, words):
    with pytest.raises(StageError, match=f"{words}; at least 16 were expected"):
        common({"a": record(-1.0, stop, 100), "b": record(0.0, 4, 100)})


def test_a_rate_that_would_fill_the_memory_is_refused_with_both_rates():
    with pytest.raises(StageError, match=r"At 1e\+07 Hz the 4 s of this test are 4e\+07 samples.*recorded at 100 Hz"):
        common({"a": record(0, 4, 100)}, rate=1e7)
