from dataclasses import replace
from datetime import date, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest

from chain import ingested
from colonnade.errors import StageError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.signals.quality import Flag
from colonnade.stages.ingest import IngestInputs
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


def test_the_window_of_a_test_is_cut_out(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"].model_copy(update={"window": (2.0, 5.0)})
    recorded = ingested(small_campaign, test, free_vibration[0])
    assert float(recorded["elapsed"][0]) == 2.0
    assert float(recorded["elapsed"][-1]) == 5.0


def test_a_window_beside_the_record_is_refused(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"].model_copy(update={"window": (50.0, 60.0)})
    with pytest.raises(StageError, match="no sample between 50 and 60 s"):
        ingested(small_campaign, test, free_vibration[0])


def test_a_file_without_a_clock_needs_a_sampling_rate(small_campaign, free_vibration):
    clockless = _changed(free_vibration[0], time=None)
    with pytest.raises(StageError, match="sampling_rate"):
        ingested(small_campaign, "free-01", clockless)
    recorded = ingested(small_campaign, "free-01", clockless, sampling_rates={"main": 250.0})
    assert float(recorded["elapsed"][1]) == 0.004


def test_channels_with_other_times_get_a_clock_of_their_own(small_campaign, free_vibration):
    recordings, time, _, _ = free_vibration
    recorded = ingested(small_campaign, "free-01", _changed(recordings, "ACC", time=time + 0.001))
    assert recorded["table_acceleration"].dims == ("elapsed_table_acceleration",)
    assert recorded["top"].dims == ("elapsed",)


def test_channels_never_share_a_row_because_they_share_an_index(small_campaign, free_vibration):
    recordings, time, _, _ = free_vibration
    main = recordings["main"]
    channel = IngestInputs.of(small_campaign, small_campaign.tests["free-01"]).channels["bottom"]
    # Four channels of as many samples, three of them with starts of their own, two with names of a recorder's clock.
    wired = {"daq": ("main", 0.0), "first": ("daq", 0.5), "second": ("daq", 0.25), "daq.first": ("main", 0.125)}
    values = main.channel("LVDT 2").values
    columns = tuple(RecordedChannel(name, "mm", values, time + start) for name, (_, start) in wired.items())
    channels = {
        name: channel.model_copy(update={"column": name, "recorder": recorder}) for name, (recorder, _) in wired.items()
    }
    both = replace(main, channels=columns)
    recorded = ingested(small_campaign, "free-01", {"main": both, "daq": both}, channels=channels)
    found = {name: recorded[name.replace(".", "_")].dims[0] for name in wired}
    for name, (_, start) in wired.items():
        np.testing.assert_array_equal(recorded[found[name]], time + start)
    assert len(set(found.values())) == 4


def test_channels_of_a_recorder_that_was_not_running_are_absent(small_campaign):
    test = small_campaign.tests["free-01"]
    setup = small_campaign.setups["frame"]
    channels = setup.channels | {"extra": setup.channels["bottom"].model_copy(update={"recorder": "daq2"})}
    changed = small_campaign.but(setups={"frame": setup.model_copy(update={"channels": channels})})
    assert "extra" not in IngestInputs.of(changed, test).channels


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


@every(("rate", "digits"), [(400, 3), (909, 3), (400, 2)])
def test_rounded_times_are_kept_and_said_and_flag_no_sample(small_campaign, rate, digits):
    time = np.round(np.arange(4000) / rate, digits)
    values = np.random.default_rng(0).normal(size=(3, time.size))
    names = ("LVDT 1", "LVDT 2", "ACC")
    channels = tuple(RecordedChannel(name, None, each, time) for name, each in zip(names, values, strict=True))
    recorded = ingested(small_campaign, "shake-01", {"main": Recording(Path("a.csv"), "delimited", channels)})
    np.testing.assert_array_equal(recorded["elapsed"], time)
    assert (recorded["bottom_quality"] == Flag.GOOD).all()
    said = f"a.csv: the times are rounded to {10 ** (3 - digits)} ms; an even clock of {rate}"
    assert [warning for warning in recorded.attrs["warnings"] if warning.text.startswith(said)]
    assert len(recorded.attrs["warnings"]) == 1


def test_one_wild_time_stamp_costs_one_sample(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    for channel in recordings["main"].channels:
        channel.time[9] = 1e6
    recorded = ingested(small_campaign, "free-01", recordings)
    assert np.flatnonzero(recorded["top_quality"] != Flag.GOOD).tolist() == [9]


@pytest.mark.parametrize("change", ["starts again", "a block goes back", "runs backwards"])
@pytest.mark.parametrize("share", [0.1, 0.3, 0.5])
def test_a_clock_that_goes_back_where_the_block_rocks_is_serious(small_campaign, shaken, change, share):
    recordings, time, angle, _ = shaken
    peak, stamps = int(np.argmax(np.abs(angle))), time.copy()
    length = int(share * min(peak, time.size - peak))
    if change == "starts again":
        # What is longer is kept: the peak is in what is shorter.
        jump = peak + length if peak + length < time.size / 2 else peak - length
        stamps[jump:] -= stamps[jump]
    elif change == "a block goes back":
        jump = peak - length // 2
        stamps[jump : jump + length] -= 2 * length / 500
    else:
        jump = peak - length // 2 + 1
        stamps[jump - 1 : jump - 1 + length] = stamps[jump - 1 : jump - 1 + length][::-1]
    recorded = ingested(small_campaign, "shake-01", _changed(recordings, time=stamps))
    [told] = [each for each in recorded.attrs["warnings"] if "out of order" in each.text]
    assert told.severity == "serious"
    assert f"at sample {jump + 1:,}" in told.text


def test_a_clock_that_goes_back_at_rest_is_a_warning(small_campaign, free_vibration):
    recordings, time, _, _ = free_vibration
    stamps = time.copy()
    stamps[5500:] -= stamps[5500]
    recorded = ingested(small_campaign, "free-01", _changed(recordings, time=stamps))
    [told] = recorded.attrs["warnings"]
    assert told.severity == "warning"
    assert "the clock goes from 10.998 to 0 s at sample 5,501" in told.text


def test_the_time_of_the_file_is_kept_and_another_day_is_a_warning(small_campaign, free_vibration):
    recordings, test = free_vibration[0], small_campaign.tests["free-01"]
    assert ingested(small_campaign, test, recordings).attrs["recorded_at"] == ""
    start = datetime(2013, 4, 26, 10, 15, tzinfo=timezone(timedelta(hours=3)))
    dated = {"main": replace(recordings["main"], start=start)}
    told = ingested(small_campaign, test.model_copy(update={"date": date(2013, 4, 27)}), dated).attrs
    assert told["recorded_at"] == "2013-04-26 10:15:00+03:00"
    assert [found.kind for found in told["warnings"]] == ["date"]
