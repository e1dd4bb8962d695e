"""Ingest: which column a channel is, its unit and times, its SI values and flags, and what is left as recorded."""

from dataclasses import replace
from datetime import UTC, date, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chain import ingested, plain_channel
from colonnade.campaign.review import Flagged, Review
from colonnade.errors import ReadError, StageError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.signals.quality import Flag
from colonnade.stages.ingest import (
    IngestInputs,
    contradictions,
    dimension_of,
    find_column,
    recorded_at,
    reviewed,
    unit_findings,
)
from colonnade.store.description import describe
from every import every


def _changed(recordings, *names, **changes):
    """The recordings with changed channels: those of these names, or all."""
    main = recordings["main"]
    channels = (replace(each, **changes) if each.name in names or not names else each for each in main.channels)
    return {"main": replace(main, channels=tuple(channels))}


def test_recorded_values_stay_and_si_values_stand_beside_them(small_campaign, free_vibration):
    recordings, time, _, _ = free_vibration
    recorded = ingested(small_campaign, "free-01", recordings)
    volts = recordings["main"].channel("LVDT 1").values
    np.testing.assert_array_equal(recorded["top_recorded"], volts)
    np.testing.assert_allclose(recorded["top"], volts * 0.012 + 0.003, rtol=1e-12)
    np.testing.assert_allclose(recorded["table_acceleration"], recordings["main"].channel("ACC").values * 9.80665)
    np.testing.assert_array_equal(recorded["elapsed"], time)
    assert recorded.attrs["warnings"] == []
    assert describe(recorded)["top"].attrs["units"] == "m"


def test_planted_faults_are_flagged_and_told_and_nothing_is_overwritten(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    values = recordings["main"].channel("LVDT 1").values.copy()
    values[700] = 9.0
    values[900:905] = np.nan
    values[1000:1010] = 10.0
    recorded = ingested(small_campaign, "free-01", _changed(recordings, "LVDT 1", values=values))
    flags = recorded["top_quality"].to_numpy()
    assert flags[700] == Flag.FAIL
    assert (flags[900:905] == Flag.MISSING).all()
    assert (flags[1000:1010] == Flag.SUSPECT).all()
    assert (np.delete(flags, [700, *range(900, 905), *range(1000, 1010)]) == Flag.GOOD).all()
    np.testing.assert_array_equal(recorded["top_recorded"], values)
    told, flagged = " ".join(map(str, recorded.attrs["warnings"])), ("5 samples without a value", "spikes on 1 sample")
    for words in ("channel top", *flagged, "10 samples at the end of the range"):
        assert words in told


def test_the_window_of_a_test_is_cut_out_and_has_to_hold_samples(small_campaign, free_vibration):
    inside, beside = (
        small_campaign.tests["free-01"].model_copy(update={"window": window}) for window in ((2.0, 5.0), (50.0, 60.0))
    )
    clock = ingested(small_campaign, inside, free_vibration[0])["elapsed"]
    assert (float(clock[0]), float(clock[-1])) == (2.0, 5.0)
    with pytest.raises(StageError, match="no sample between 50 and 60 s"):
        ingested(small_campaign, beside, free_vibration[0])


def test_an_unnamed_recorder_is_told(small_campaign, free_vibration):
    read = IngestInputs.of(small_campaign, small_campaign.tests["free-01"])
    channels = read.channels | {"top": read.channels["top"].model_copy(update={"recorder": "daq2"})}
    with pytest.raises(StageError, match='daq2 = "…"'):
        ingested(small_campaign, "free-01", free_vibration[0], channels=channels)


def test_a_dead_accelerometer_on_the_specimen_is_flagged_beside_a_moving_table(small_campaign):
    time = np.arange(0, 4, 0.002)
    values = {"ACC": np.sin(9 * time), "block": 1e-3 * np.sin(9 * time), "alive": 0.5 * np.sin(9 * time)}
    channels = tuple(RecordedChannel(name, "g", each, time) for name, each in values.items())
    table = IngestInputs.of(small_campaign, small_campaign.tests["shake-01"]).channels["table_acceleration"]
    block = table.model_copy(update={"column": "block", "on": "specimen"})
    both = {"table": table, "block": block, "across": block.model_copy(update={"direction": (0.0, 0.0, 1.0)})}
    both["alive"] = block.model_copy(update={"column": "alive"})
    recordings = {"main": Recording(Path("a.csv"), "delimited", channels)}
    recorded = ingested(small_campaign, "shake-01", recordings, channels=both)
    assert (recorded["block_quality"] == Flag.SUSPECT).all()
    assert "channel block: the channel is practically dead" in " ".join(map(str, recorded.attrs["warnings"]))
    for name in ("table", "across", "alive"):
        assert (recorded[f"{name}_quality"] == Flag.GOOD).all(), name


def test_a_clock_that_starts_again_is_serious(small_campaign, shaken):
    stamps = shaken[1].copy()
    stamps[2000:] -= stamps[2000]
    recorded = ingested(small_campaign, "shake-01", _changed(shaken[0], time=stamps))
    [told] = [each for each in recorded.attrs["warnings"] if "out of order" in each.text]
    assert told.severity == "serious"


def test_the_time_of_the_file_is_kept_and_another_day_is_a_warning(small_campaign, free_vibration):
    recordings = {"main": replace(free_vibration[0]["main"], start=TEN.replace(tzinfo=ATHENS))}
    test = small_campaign.tests["free-01"].model_copy(update={"date": date(2013, 4, 27)})
    told = ingested(small_campaign, test, recordings).attrs
    assert told["recorded_at"] == "2013-04-26 10:15:00+03:00"
    (found,) = told["warnings"]
    assert (found.kind, found.severity) == ("date", "warning")
    assert "was recorded on 2013-04-26" in found.text
    assert "gives the date 2013-04-27" in found.text


VALUES = np.array([4.0, 5.0, 6.0])
FILE_TIME = np.array([0.0, 0.5, 1.0])
RECORDING = Recording(
    Path("raw/free-01.csv"),
    "delimited",
    (
        RecordedChannel("Seconds", "s", np.array([10.0, 10.1, 10.2])),
        RecordedChannel("Timed", "mm", VALUES, FILE_TIME, "Timed [mm]"),
        RecordedChannel("Untimed", "mm", VALUES),
    ),
)


def channel(**changes):
    return plain_channel("displacement", **{"column": "Timed", "unit": "mm"} | changes)


SECONDS, COUNTED = [10.0, 10.1, 10.2], [0.0, 0.005, 0.01]


@every(
    ("column", "own", "rate", "time", "heading"),
    [
        ("Timed", None, 200.0, COUNTED, "Timed [mm]"),  # even beside a clock
        ("Untimed", None, 200.0, COUNTED, "Untimed"),
        ("Timed", "Seconds", 200.0, SECONDS, "Timed [mm]"),
        ("Timed", "Seconds", None, SECONDS, "Timed [mm]"),
    ],
)
def test_a_time_column_of_the_channel_comes_before_a_sampling_rate_and_this_before_the_files_clock(
    column, own, rate, time, heading
):
    found = find_column(RECORDING, "top", channel(column=column, time=own), rate)
    np.testing.assert_array_equal(found.time, time)
    np.testing.assert_array_equal(found.values, VALUES)
    assert (found.name, found.unit, found.heading) == (column, "mm", heading)


def test_without_any_clock_the_message_gives_channel_file_and_both_remedies():
    with pytest.raises(StageError) as refusal:
        find_column(RECORDING, "top", channel(column="Untimed"), None)
    for words in ("channel top: free-01.csv", 'sampling_rate = "200 Hz"', "`time`"):
        assert words in str(refusal.value)


@pytest.mark.parametrize("changes", [{"column": "Tined"}, {"time": "Tined"}])
def test_a_column_that_is_not_in_the_file_is_told_with_the_nearest(changes):
    with pytest.raises(ReadError, match=r'no column is called "Tined".*Did you mean "Timed'):
        find_column(RECORDING, "top", channel(**changes), None)


GAIN = "10 mm/V"
SAME_UNITS = [(" mm ", "mm"), ("g's", "g"), (None, "mm"), ("mm", None), (None, None)]
OTHER_UNITS = [("cm", "mm", None), ("mV", "V", None), ("g", "m/s^2", None), ("counts", "mm", None), ("mV", "V", GAIN)]
LABELS = [("Acc (V)", "g", None, False), ("Acc (V)", "mV", "1 g/V", True), ("Acc [V]", "g", None, True)]


@every(
    ("heading", "of_file", "of_campaign", "gain", "is_told"),
    [
        *(("Top left", *units, None, False) for units in SAME_UNITS),
        *(("Top left", *units, True) for units in OTHER_UNITS),
        *(("Top left", own, "V", GAIN, False) for own in ("counts", "LSB", "Einheiten", "1")),
        *((head, "V", *rest) for head, *rest in LABELS),
    ],
)
def test_units_that_differ_are_serious_unless_a_recorders_own_is_explained_or_a_letter_is_a_label(
    heading, of_file, of_campaign, gain, is_told
):
    column = RecordedChannel("Top", of_file, VALUES, heading=heading)
    found = unit_findings(RECORDING, column, "top", channel(unit=of_campaign, gain=gain))
    assert [(each.kind, each.severity) for each in found] == [("unit", "serious")] * is_told
    for each in found:
        assert f'channel top: free-01.csv says "{of_file}" for column "{heading}"' in each.text


@every(
    ("known", "changes", "dimension"),
    [
        (None, {}, "elapsed"),
        (None, {"recorder": "daq-2"}, "elapsed_daq_2"),
        (None, {"time": "Seconds", "recorder": "daq-2"}, "elapsed_top_left"),
        (FILE_TIME.copy(), {}, "elapsed"),
        (FILE_TIME + 1e-9, {}, "elapsed_top_left"),
    ],
)
def test_a_channel_is_on_the_clock_of_its_recorder_or_its_own_and_shares_it_only_with_the_same_times(
    known, changes, dimension
):
    there = {} if known is None else {"elapsed": known}
    assert dimension_of(there, FILE_TIME, "top-left", channel(**changes)) == dimension


TIME = np.arange(0.0, 10.0, 0.01)


def test_people_flag_a_stretch_or_a_whole_channel():
    flags = (
        Flagged(channel="top", window=(1.0, 2.0), flag="suspect", reason="knocked"),
        Flagged(channel="top", window=None, flag="fail", reason="loose"),
        Flagged(channel="other", window=None, flag="fail", reason="loose"),
    )
    stretch, whole = reviewed("top", TIME, Review(flags=flags))
    assert (stretch.flag, int(stretch.where.sum())) == (Flag.SUSPECT, 101)
    assert (whole.flag, bool(whole.where.all())) == (Flag.FAIL, True)


ATHENS = timezone(timedelta(hours=3))
TEN = datetime(2013, 4, 26, 10, 15, 0)


def recorded(start):
    return {"daq": Recording(Path("a.csv"), "any", (), start)}


@given(st.datetimes(datetime(1990, 1, 1), datetime(2090, 1, 1)), st.integers(-12, 14))
def test_no_laboratory_on_earth_is_warned_of_a_file_in_utc_of_its_own_day(wall, hours):
    start = wall.replace(tzinfo=timezone(timedelta(hours=hours))).astimezone(UTC)
    assert contradictions(recorded(start), wall.date()) == []


def test_a_test_late_in_a_long_file_has_its_own_time():
    assert recorded_at(recorded(None)) == ""
    night = datetime(2013, 4, 25, 23, 30, 0)
    assert recorded_at(recorded(night), 3600.0) == "2013-04-26 00:30:00, no time zone recorded"
    assert contradictions(recorded(night), date(2013, 4, 26), 3600.0) == []
    assert len(contradictions(recorded(night), date(2013, 4, 25), 3600.0)) == 1
