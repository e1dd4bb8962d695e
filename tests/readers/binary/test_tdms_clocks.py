"""The clocks of TDMS channels: their own properties, else a channel of times in their group."""

from pathlib import Path

import numpy as np
import pytest

from colonnade.readers.binary.tdms_clocks import Column, beginnings, on_clocks, waveform
from colonnade.readers.recording import RecordedChannel
from every import every

START = np.datetime64("2013-04-26T10:15:00", "us")


def column(name, values, group="g", **properties):
    channel = RecordedChannel(name, None, values, heading=f"{group}/{name}", scope=(group,))
    return Column(channel, waveform(properties))


@every(
    "properties", [{}, {"wf_increment": 0}, {"wf_increment": -1.0}, {"wf_increment": np.nan}, {"wf_increment": "fast"}]
)
def test_a_step_that_is_none_gives_no_clock(properties):
    assert waveform(properties) is None


@every("start", [np.datetime64("1904-01-01", "us"), np.datetime64("NaT"), "yesterday", None])
def test_a_start_that_is_not_known_is_none(start):
    found = waveform({"wf_increment": 0.5, "wf_start_time": start})
    assert found is not None
    assert found.start is None


def test_channels_that_start_later_keep_their_own_clock():
    late = START + np.timedelta64(250, "ms")
    columns = [
        column("a", np.zeros(3), wf_increment=0.1, wf_start_time=START),
        column("b", np.zeros(3), wf_increment=0.1, wf_start_time=late, wf_start_offset=1.0),
    ]
    recording = on_clocks(Path("a.tdms"), columns, None, None)
    first, second = (channel.time for channel in recording.channels)
    np.testing.assert_allclose(first, [0, 0.1, 0.2])
    np.testing.assert_allclose(second, [1.25, 1.35, 1.45])
    assert str(recording.start) == "2013-04-26 10:15:00+00:00"
    assert any("channels start up to 0.25 s apart" in note for note in recording.notes)
    assert beginnings([each.waveform for each in columns] + [None]) == pytest.approx([0, 1.25, np.nan], nan_ok=True)


def test_channels_with_the_same_properties_share_their_times():
    columns = [column(name, np.zeros(4), wf_increment=0.1) for name in "ab"]
    first, second = on_clocks(Path("a.tdms"), columns, None, None).channels
    assert first.time is second.time


def test_a_channel_without_a_step_goes_by_the_channel_of_times_in_its_group():
    times = np.arange(5) / 100
    columns = [column("Time", times), column("top", np.zeros(5)), column("far", np.zeros(5), "other")]
    clock, top, far = on_clocks(Path("a.tdms"), columns, None, None).channels
    assert clock.is_clock
    np.testing.assert_array_equal(top.time, times)
    assert far.time is None


def test_a_step_of_one_second_that_nobody_gave_yields_to_a_channel_of_times():
    times = np.arange(5) / 100
    columns = [column("Time", times, wf_increment=1.0), column("top", np.zeros(5), wf_increment=1.0)]
    recording = on_clocks(Path("a.tdms"), columns, None, None)
    np.testing.assert_array_equal(recording.channels[1].time, times)
    assert any('"g/top" uses the channel of times' in warning for warning in recording.warnings)
