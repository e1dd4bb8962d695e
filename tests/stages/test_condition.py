"""Channels conditioned: their zeros, filters and gaps, and one clock for those of several recorders."""

import re

import numpy as np
import pytest
import xarray as xr

from chain import conditioned, measured
from colonnade.campaign import Channel
from colonnade.errors import StageError
from colonnade.findings import Severity
from colonnade.signals.alignment import ClockRate, Offset
from colonnade.signals.quality import Flag
from colonnade.signals.record import Record
from colonnade.stages import condition as conditioning
from colonnade.stages.condition import common_clock, condition, own_records, recorder_offsets
from every import every
from prism import PRISM

OFFSET = 0.02
"""s, by which the second recorder is late."""


def shaking(time):
    """A motion of several frequencies that begins and ends within the record."""
    envelope = np.clip(np.minimum(time - 1.0, 7.0 - time), 0.0, 1.0)
    return envelope * (np.sin(2 * np.pi * 2.3 * time) + 0.6 * np.sin(2 * np.pi * 3.7 * time + 1.0))


def _two_recorders(first, second, *, noise=1e-3):
    """Accelerations of the table, (values on 500 Hz, values on 400 Hz), as the result of `ingest`."""
    rng = np.random.default_rng(0)
    variables = {}
    for name, dimension, values in (("first", "elapsed", first), ("second", "elapsed_daq2", second)):
        variables[name] = (dimension, values + rng.normal(0, noise, values.size), {"channel": name})
        variables[f"{name}_quality"] = (dimension, np.full(values.size, Flag.GOOD, dtype=np.int8))
    clocks = {"elapsed": ("elapsed", FIRST), "elapsed_daq2": ("elapsed_daq2", SECOND)}
    return xr.Dataset(variables, coords=clocks)


FIRST, SECOND = np.arange(0, 9, 1 / 500), np.arange(0, 9, 1 / 400)


def _delayed(read, delays):
    """The same inputs with other delays of the channels."""
    changed = {name: read.channels[name].model_copy(update={"delay": delay}) for name, delay in delays.items()}
    return read.model_copy(update={"channels": read.channels | changed})


@pytest.fixture
def linked(small_campaign):
    """Inputs for the two recorders above."""
    read = conditioning.ConditionInputs.of(small_campaign, small_campaign.tests["shake-01"])
    channels = {"first": channel(), "second": channel(recorder="daq2")}
    return read.model_copy(update={"channels": channels, "links": {"daq2": ("first", "second")}})


@pytest.mark.parametrize(("of_first", "of_second"), [(0.0, 0.0), (0.0, 0.01), (0.004, 0.0), (0.004, 0.01)])
def test_a_delay_and_a_clock_offset_are_each_taken_off_once(linked, of_first, of_second):
    recorded = _two_recorders(shaking(FIRST - of_first), shaking(SECOND - OFFSET - of_second))
    result = condition(recorded, _delayed(linked, {"first": of_first, "second": of_second}))
    assert result["second"].attrs["clock_offset"] == pytest.approx(OFFSET + of_second, abs=2e-4)
    assert result["first"].attrs["clock_offset"] == of_first
    for name in ("first", "second"):
        np.testing.assert_allclose(result[name], shaking(result["elapsed"].to_numpy()), atol=2e-2)


def test_a_channel_of_another_quantity_links_recorders_but_is_not_conditioned(linked):
    pulse = np.where((FIRST > 3) & (FIRST < 3.5), 5.0, 0.0), np.where((SECOND > 3.02) & (SECOND < 3.52), 5.0, 0.0)
    recorded = _two_recorders(*pulse)
    shaken = _two_recorders(shaking(FIRST), shaking(SECOND - OFFSET), noise=0.0)
    names = {"first": "base", "second": "late", "first_quality": "base_quality", "second_quality": "late_quality"}
    recorded = recorded.merge(shaken.rename(names))
    unused = {"quantity": "other", "on": None}
    channels = {name: channel.model_copy(update=unused) for name, channel in linked.channels.items()}
    channels |= {"base": linked.channels["first"], "late": linked.channels["second"]}
    result = condition(recorded, linked.model_copy(update={"channels": channels}))
    assert set(result.data_vars) == {"base", "base_quality", "late", "late_quality"}
    assert result["late"].attrs["clock_offset"] == pytest.approx(OFFSET, abs=1e-3)


@pytest.fixture
def zeros(small_campaign, shaken):
    """Findings on the zero with something added to the table's acceleration, g."""

    def found(added=None, **changes):
        shaken[0]["main"].channel("ACC").values[:] += 0.0 if added is None else added(shaken[1])
        test = small_campaign.tests["shake-01"].model_copy(update=changes)
        return [each for each in measured(small_campaign, test, shaken[0])[1].attrs["warnings"] if each.kind == "zero"]

    return found


def test_shaking_before_the_table_is_at_rest_is_warned_of(zeros):
    (told,) = zeros(lambda time: np.where(time > 0.1, 0.05 * np.sin(20 * time), 0.0))
    assert told.severity == "warning"
    share = float(re.search(r"The zero of the base acceleration is uncertain by ([\d.]+) of the acce", told.text)[1])
    # The mean of a sine over half a second less that over a part of it, of 0.49 m/s²: at most its amplitude.
    assert 0.05 < share * PRISM.uplift_acceleration < 0.49
    assert "that uplifts the specimen: it moves from 0 to 0.5 s" in told.text


def test_a_zero_that_moves_too_little_to_matter_is_not_told(zeros):
    assert zeros(lambda time: 0.002 * np.sin(20 * time)) == []  # 16 times its noise


def test_a_given_zero_is_taken(zeros):
    (told,) = zeros(lambda time: np.where(time < 0.6, 0.05 * np.sin(20 * time), 0.0))
    assert "Start recording before the motion, or give the test a `zero`" in told.text
    assert zeros(zero=(0.6, 1.1)) == []


@pytest.fixture
def free(small_campaign, free_vibration):
    """Condition a free vibration."""
    return lambda test="free-01", **changes: conditioned(small_campaign, test, free_vibration[0], **changes)


@pytest.fixture
def top(free_vibration):
    """Values of its upper transducer, V."""
    return free_vibration[0]["main"].channel("LVDT 1").values


def test_a_channel_without_values_where_zero_is_taken_is_left_out(free, top):
    top[-300:] = np.nan
    result = free()
    assert "top" not in result
    assert any("channel top is left out: it has no value from" in warning.text for warning in result.attrs["warnings"])
    assert result["elapsed"][-1] == pytest.approx(11.998)


def test_a_free_vibration_that_starts_tilted_is_zeroed_at_its_end_where_its_noise_is_left(free):
    result = free()
    top = result["top"]
    assert abs(float(top[-100:].mean())) < 2e-6
    assert float(top[100]) > 0.03
    assert float(top[-400:].std()) == pytest.approx(top.attrs["noise"], rel=0.5)
    assert 1e-6 < top.attrs["noise"] < 1e-5
    assert result.attrs["warnings"] == []


def test_an_earthquake_is_zeroed_at_its_start(small_campaign, shaken):
    result = conditioned(small_campaign, "shake-01", shaken[0])
    assert abs(float(result["table_acceleration"][:200].mean())) < 2e-4
    assert result["top"].attrs["zero_window"].startswith("0 s")


def test_zero_can_be_given_or_switched_off(free):
    assert abs(float(free(zero="start")["top"][:200].mean())) < 2e-6
    assert free(zero=(10.0, 11.0))["top"].attrs["zero_window"] == "10 s to 11 s"
    assert float(free(zero="none")["bottom"][-1]) == pytest.approx(0.7e-3, abs=1e-4)
    told = " ".join(map(str, free(zero=(90.0, 91.0)).attrs["warnings"]))
    assert "channel top is left out: it has no value from 90 to 91 s, where the zero is taken" in told


def test_a_record_that_ends_while_rocking_is_warned_of(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"].model_copy(update={"window": (0.0, 3.0)})
    told = measured(small_campaign, test, free_vibration[0])[1].attrs["warnings"][0]
    assert (told.kind, told.severity) == ("zero", "serious")
    assert "The zero of the rocking angle is uncertain by 0.18 of the critical angle" in told.text
    assert "Record until the specimen is still" in told.text


def test_spikes_are_bridged_before_the_filter_and_stay_suspect(free, top):
    clean = free()
    top[1500] += 5.0
    spiked = free()
    np.testing.assert_allclose(spiked["top"], clean["top"], atol=1e-4)
    assert spiked["top_quality"][1500] == Flag.SUSPECT


def test_a_cut_off_above_half_the_sampling_rate_is_refused_by_its_key(small_campaign, free):
    too_high = small_campaign.processing.model_copy(update={"lowpass": 300.0})
    with pytest.raises(StageError, match=r"processing\.lowpass is 300 Hz; below 250 Hz.*channel top"):
        free(settings=too_high)


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
