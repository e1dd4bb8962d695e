"""TDMS: channels with their units and clocks, wherever the file ends."""

import struct
from datetime import UTC, datetime

import numpy as np
import pytest
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every

START = np.datetime64("2013-04-26T10:15:00.250000")


def sampled(name, values, step=0.1, *, offset=0.0, **others):
    """A channel of the group `g`, or of the one in front of its name, with a clock of its own."""
    group, _, name = name.rpartition("/")
    clock = {"wf_increment": step, "wf_start_offset": offset, "wf_start_time": START}
    return ChannelObject(group or "g", name, values, clock | others)


def written(path, *segments):
    with TdmsWriter(path) as writer:
        for segment in segments:
            writer.write_segment([RootObject({}), *segment])
    return path


def test_values_unit_and_clock_come_from_the_channels_own_properties(path):
    values = np.sin(np.arange(200) / 7)
    recording = read(written(path, [sampled("Messung/LVDT 1", values, 0.005, unit_string="mm")]))
    assert recording.format == "tdms"
    channel = recording.channel("LVDT 1")
    assert channel is recording.channel("Messung/LVDT 1")
    assert channel.unit == "mm"
    np.testing.assert_array_equal(channel.values, values)
    np.testing.assert_allclose(channel.time, np.arange(200) * 0.005, rtol=1e-15)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000, tzinfo=UTC)
    assert recording.warnings == ()


def test_samples_before_the_trigger_are_before_zero(path):
    recording = read(written(path, [sampled("a", np.arange(9.0), 0.01, offset=-0.5)]))
    assert recording.channel("a").time[0] == -0.5
    assert recording.start == datetime(2013, 4, 26, 10, 14, 59, 750000, tzinfo=UTC)


def test_a_name_in_two_groups_needs_its_group(path):
    recording = read(written(path, [sampled("raw/top", np.zeros(5)), sampled("scaled/top", np.ones(5))]))
    assert recording.channel("scaled/top").values.tolist() == [1.0] * 5
    with pytest.raises(ReadError, match='no column is called "top"'):
        recording.channel("top")
    assert read(path, options={"group": "raw"}).channel("top").values.tolist() == [0.0] * 5
    with pytest.raises(ReadError, match=r'group "row" not found\. Did you mean "raw"'):
        read(path, options={"group": "row"})


def test_a_channel_of_times_is_the_clock_where_the_properties_give_none(path):
    time = np.arange(30) * 0.004
    recording = read(written(path, [ChannelObject("g", "Time [ms]", time * 1e3), ChannelObject("g", "top", time + 1)]))
    np.testing.assert_allclose(recording.channel("top").time, time, atol=1e-12)
    assert recording.channel("Time").is_clock


def test_timestamps_are_a_clock_and_give_the_start(path):
    stamps = START + np.arange(40) * np.timedelta64(2500, "us")
    recording = read(written(path, [ChannelObject("g", "Stamp", stamps), ChannelObject("g", "a", np.zeros(40))]))
    np.testing.assert_allclose(recording.channel("a").time, np.arange(40) * 0.0025, atol=1e-9)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000, tzinfo=UTC)


def test_channels_that_start_later_keep_their_own_clock(path):
    late = START + np.timedelta64(250, "ms")
    recording = read(written(path, [sampled("a", [0.0] * 3), sampled("b", [0.0] * 3, offset=1.0, wf_start_time=late)]))
    first, second = (channel.time for channel in recording.channels)
    np.testing.assert_allclose(first, [0, 0.1, 0.2])
    np.testing.assert_allclose(second, [1.25, 1.35, 1.45])


@every("start", [np.datetime64("1904-01-01", "us"), "yesterday", None])
def test_a_start_that_is_not_known_is_none(path, start):
    known = {} if start is None else {"wf_start_time": start}
    recording = read(written(path, [ChannelObject("g", "a", np.zeros(3), {"wf_increment": 0.5, **known})]))
    assert recording.start is None
    assert recording.channels[0].time.tolist() == [0.0, 0.5, 1.0]


@every("step", [0.0, -1.0, np.nan, "fast"])
def test_a_step_that_is_none_gives_no_clock(path, step):
    assert read(written(path, [ChannelObject("g", "a", np.zeros(3), {"wf_increment": step})])).channels[0].time is None


def test_a_step_of_one_second_that_nobody_gave_yields_to_a_channel_of_times(path):
    default = {"wf_increment": 1.0}
    columns = [ChannelObject("g", "Time", np.arange(5) / 100, default), ChannelObject("g", "top", np.zeros(5), default)]
    recording = read(written(path, columns))
    np.testing.assert_array_equal(recording.channel("top").time, np.arange(5) / 100)
    assert read(written(path, columns[1:])).channel("top").time.tolist() == [0, 1, 2, 3, 4]


def test_text_is_left_out_and_infinities_are_missing(path):
    remarks = ChannelObject("g", "remarks", ["a", "b", "c"])
    recording = read(written(path, [remarks, sampled("a", np.array([1.0, np.inf, 2.0]))]))
    assert [channel.name for channel in recording.channels] == ["a"]
    assert any('"g/remarks" is left out: it holds samples that are not numbers' in note for note in recording.notes)
    assert np.isnan(recording.channel("a").values[1])


def test_a_stale_index_file_beside_it_is_not_looked_at(path):
    written(path, [sampled("a", np.arange(6.0))])
    index = path.with_suffix(".tdms_index")
    index.write_bytes(b"TDSh of another file")
    assert read(path).channel("a").values.size == 6
    with pytest.raises(ReadError, match=r"it is a \.tdms_index, which LabVIEW writes next to"):
        read(index)


CUT_OFF = "within its last segment: the recorder was stopped, or a copy was interrupted"


@every(("cut", "left"), [(8, 100), (800, 100), (1000, 75)])
def test_a_file_that_was_cut_off_gives_what_is_there(path, cut, left):
    written(path, [sampled("a", np.arange(100.0)), sampled("b", np.arange(100.0))])
    path.write_bytes(path.read_bytes()[:-cut])
    recording = read(path)
    assert any(CUT_OFF in warning for warning in recording.warnings)
    np.testing.assert_array_equal(recording.channel("a").values, np.arange(left))


TEN = [sampled("a", np.arange(10.0))]


@every(
    ("length", "more", "left"),
    [(lambda length: length + 4 * 80, np.arange(10.0, 24.0).tobytes(), 24), (lambda _: 2**64 - 1, b"", 10)],
)
def test_a_segment_that_the_recorder_did_not_finish_is_told(path, length, more, left):
    content = bytearray(written(path, TEN).read_bytes())
    content[12:20] = struct.pack("<Q", length(*struct.unpack("<Q", content[12:20])))
    path.write_bytes(content + more)
    recording = read(path)
    assert recording.channel("a").values.tolist() == list(range(left))
    assert any(CUT_OFF in warning for warning in recording.warnings)


def test_a_segment_of_which_only_the_start_is_there_is_told(path):
    one = written(path, TEN).stat().st_size
    content = written(path, TEN, [GroupObject("other", {"note": "x" * 200}), *TEN]).read_bytes()
    path.write_bytes(content[: one + 60])
    recording = read(path)
    assert recording.channel("a").values.size == 10
    assert any(CUT_OFF in warning for warning in recording.warnings)


def test_a_broken_chain_of_segments_is_refused(path):
    one = written(path, TEN).stat().st_size
    content = bytearray(written(path, TEN, TEN).read_bytes())
    content[one : one + 4] = b"XXXX"
    path.write_bytes(content)
    with pytest.raises(ReadError, match=r"Segment does not start with b'TDSm', but with b'XXXX'.* is damaged"):
        read(path, "tdms")


def test_a_file_without_numbers_says_so(path):
    with pytest.raises(ReadError, match=r"no column of numbers in it.\n.* it holds samples that are not numbers"):
        read(written(path, [ChannelObject("g", "remarks", ["a", "b"])]))


def test_raw_counts_are_scaled_as_the_file_says(shared_data):
    channel = read(shared_data / "tdms" / "raw1.tdms").channel("First  Channel")
    assert channel.values[0] == pytest.approx(-603 * 0.0003051850947599719, rel=1e-12)  # a 16-bit count of a 10 V range
