"""TDMS: channels with their units and clocks, wherever the file ends."""

import struct
from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some
from nptdms import ChannelObject, GroupObject, RootObject, TdmsFile, TdmsWriter

from colonnade.errors import ReadError
from colonnade.readers.binary import tdms
from colonnade.readers.binary.tdms import Ending, missing_samples, walk
from colonnade.readers.recording import Window
from colonnade.readers.registry import read
from every import every

SEGMENTS = 3


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "a.tdms"
    with TdmsWriter(path) as writer:
        for number in range(SEGMENTS):
            writer.write_segment(
                [ChannelObject("g", "a", np.arange(10.0) + number), ChannelObject("g", "b", [1.0] * 10)]
            )
    return path


def test_a_whole_file_ends_where_its_segments_do(path):
    size = path.stat().st_size
    assert walk(path) == Ending(size, size)
    assert missing_samples(walk(path), TdmsFile.read(path)) == []


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)
@given(share=some.floats(0, 1, exclude_max=True))
def test_a_file_that_was_cut_off_lacks_what_is_behind_the_cut(path, share):
    content = path.read_bytes()
    cut = path.with_name("cut.tdms")
    cut.write_bytes(content[: int(share * len(content))])
    ending = walk(cut)
    assert ending.size == cut.stat().st_size
    if ending.declared is None:
        assert 0 < ending.undescribed <= 28
    elif ending.undescribed:
        assert ending.declared > ending.size
    else:
        assert ending.declared >= ending.size
        assert ending.present <= ending.expected
        assert ending.declared - ending.size == ending.expected - ending.present


START = np.datetime64("2013-04-26T10:15:00.250000")


def waveform(step, start=START, offset=0.0, **others):
    properties = {"wf_increment": step, "wf_start_offset": offset, **others}
    return properties if start is None else {**properties, "wf_start_time": start}


def written(path, *segments):
    with TdmsWriter(path) as writer:
        for segment in segments:
            writer.write_segment([RootObject({}), *segment])
    return path


def test_values_unit_and_clock_come_from_the_channels_own_properties(tmp_path):
    values = np.sin(np.arange(200) / 7)
    path = written(
        tmp_path / "free.tdms", [ChannelObject("Messung", "LVDT 1", values, waveform(0.005, unit_string="mm"))]
    )
    recording = read(path)
    assert recording.format == "tdms"
    channel = recording.channel("LVDT 1")
    assert channel is recording.channel("Messung/LVDT 1")
    assert channel.unit == "mm"
    np.testing.assert_array_equal(channel.values, values)
    np.testing.assert_allclose(channel.time, np.arange(200) * 0.005, rtol=1e-15)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000, tzinfo=UTC)
    assert recording.warnings == ()


def test_channels_that_start_at_different_times_never_share_a_row(tmp_path):
    later = START + np.timedelta64(125, "ms")
    path = written(
        tmp_path / "two.tdms",
        [
            ChannelObject("g", "first", np.arange(50.0), waveform(0.01)),
            ChannelObject("g", "second", np.arange(80.0), waveform(0.005, later, offset=-0.025)),
        ],
    )
    recording = read(path)
    first, second = recording.channel("first").time, recording.channel("second").time
    assert first is not None
    assert second is not None
    np.testing.assert_allclose(first, np.arange(50) * 0.01, atol=1e-12)
    np.testing.assert_allclose(second, 0.125 - 0.025 + np.arange(80) * 0.005, atol=1e-12)
    assert any("0.125 s apart" in note for note in recording.notes)


def test_samples_before_the_trigger_are_before_zero(tmp_path):
    path = written(tmp_path / "pre.tdms", [ChannelObject("g", "a", np.arange(9.0), waveform(0.01, offset=-0.5))])
    recording = read(path)
    time = recording.channel("a").time
    assert time is not None
    assert time[0] == -0.5
    assert recording.start == datetime(2013, 4, 26, 10, 14, 59, 750000, tzinfo=UTC)


def test_a_name_in_two_groups_needs_its_group(tmp_path):
    path = written(
        tmp_path / "groups.tdms",
        [
            ChannelObject("raw", "top", np.zeros(5), waveform(0.1)),
            ChannelObject("scaled", "top", np.ones(5), waveform(0.1)),
        ],
    )
    recording = read(path)
    assert recording.channel("scaled/top").values.tolist() == [1.0] * 5
    with pytest.raises(ReadError, match='no column is called "top"'):
        recording.channel("top")
    assert read(path, options={"group": "raw"}).channel("top").values.tolist() == [0.0] * 5
    with pytest.raises(ReadError, match=r'group "row" not found\. Did you mean "raw"'):
        read(path, options={"group": "row"})


def test_a_channel_of_times_is_the_clock_where_the_properties_give_none(tmp_path):
    time = np.arange(30) * 0.004
    path = written(
        tmp_path / "time.tdms",
        [ChannelObject("g", "Time [ms]", time * 1e3), ChannelObject("g", "top", time + 1, {"unit_string": "mm"})],
    )
    recording = read(path)
    np.testing.assert_allclose(recording.channel("top").time, time, atol=1e-12)
    assert recording.channel("Time").is_clock


def test_timestamps_are_a_clock_and_give_the_start(tmp_path):
    stamps = START + np.arange(40) * np.timedelta64(2500, "us")
    path = written(
        tmp_path / "stamps.tdms", [ChannelObject("g", "Stamp", stamps), ChannelObject("g", "a", np.zeros(40))]
    )
    recording = read(path)
    np.testing.assert_allclose(recording.channel("a").time, np.arange(40) * 0.0025, atol=1e-9)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000, tzinfo=UTC)


def test_the_clock_that_was_given_is_taken(tmp_path):
    path = written(
        tmp_path / "given.tdms",
        [ChannelObject("g", "counter", np.arange(20.0) * 5), ChannelObject("g", "a", np.zeros(20), waveform(0.1))],
    )
    recording = read(path, options={"time": "counter", "time_unit": "ms"})
    np.testing.assert_allclose(recording.channel("a").time, np.arange(20) * 0.005, atol=1e-12)
    with pytest.raises(ReadError, match="no column is called"):
        read(path, options={"time": "clock"})


def test_linear_scaling_is_applied(tmp_path):
    scaling = {
        "NI_Number_Of_Scales": 1,
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": 0.5,
        "NI_Scale[0]_Linear_Y_Intercept": -3.0,
        "NI_Scale[0]_Linear_Input_Source": 0xFFFFFFFF,
        "NI_Scaling_Status": "unscaled",
    }
    counts = np.array([0, 2, 10, -4], dtype=np.int16)
    path = written(tmp_path / "scaled.tdms", [ChannelObject("g", "a", counts, {**waveform(0.1), **scaling})])
    assert read(path).channel("a").values.tolist() == [-3.0, -2.0, 2.0, -5.0]


def test_text_is_left_out_and_infinities_are_missing(tmp_path):
    path = written(
        tmp_path / "mixed.tdms",
        [
            ChannelObject("g", "remarks", ["a", "b", "c"]),
            ChannelObject("g", "a", np.array([1.0, np.inf, 2.0]), waveform(0.1)),
        ],
    )
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["a"]
    assert any('"g/remarks" is left out: it holds text' in note for note in recording.notes)
    assert any("1 value is infinite, the first at sample 2" in warning for warning in recording.warnings)
    assert np.isnan(recording.channel("a").values[1])


def test_a_stale_index_file_beside_it_is_not_looked_at(tmp_path):
    path = written(tmp_path / "a.tdms", [ChannelObject("g", "a", np.arange(6.0), waveform(0.1))])
    (tmp_path / "a.tdms_index").write_bytes(b"TDSh of another file")
    assert read(path).channel("a").values.size == 6
    with pytest.raises(ReadError, match=r"it is a \.tdms_index, which LabVIEW writes next to"):
        read(tmp_path / "a.tdms_index")


@every("cut", [8, 800, 1000])
def test_a_file_that_was_cut_off_says_how_many_samples_are_there(tmp_path, cut):
    path = written(
        tmp_path / "cut.tdms",
        [
            ChannelObject("g", "a", np.arange(100.0), waveform(0.1)),
            ChannelObject("g", "b", np.arange(100.0), waveform(0.1)),
        ],
    )
    whole = path.read_bytes()
    path.write_bytes(whole[:-cut])
    recording = read(path)
    lost = {8: ("b", 99), 800: ("b", 0), 1000: ("a", 75)}[cut]
    assert any(f"ends after {len(whole) - cut} of {len(whole)} bytes" in warning for warning in recording.warnings)
    assert any(f'{lost[1]} of 100 samples of "{lost[0]}"' in warning for warning in recording.warnings)
    there = {channel.name: channel.values for channel in recording.channels}
    np.testing.assert_array_equal(there["a"], np.arange(100.0)[: there["a"].size])
    assert there["a"].size == (75 if cut == 1000 else 100)


def test_samples_are_counted_over_several_chunks(tmp_path):
    path = written(tmp_path / "chunks.tdms", [ChannelObject("g", "a", np.arange(10.0), waveform(0.1))])
    content = bytearray(path.read_bytes())
    length = struct.unpack("<Q", content[12:20])[0]
    content[12:20] = struct.pack("<Q", length + 4 * 80)  # five chunks of ten samples are announced
    path.write_bytes(bytes(content) + np.arange(10.0, 24.0).tobytes())
    recording = read(path)
    assert recording.channel("a").values.tolist() == list(range(24))
    assert any('24 of 50 samples of "a"' in warning for warning in recording.warnings)


def test_a_recorder_that_was_stopped_by_force_is_told(tmp_path):
    path = written(tmp_path / "crash.tdms", [ChannelObject("g", "a", np.arange(10.0), waveform(0.1))])
    content = bytearray(path.read_bytes())
    content[12:20] = b"\xff" * 8
    path.write_bytes(content)
    recording = read(path)
    assert recording.channel("a").values.size == 10
    assert any("did not finish the last segment" in warning for warning in recording.warnings)


def test_a_segment_of_which_only_the_start_is_there_is_told(tmp_path):
    segment = [ChannelObject("g", "a", np.arange(10.0), waveform(0.1))]
    one = written(tmp_path / "one.tdms", segment).stat().st_size
    path = written(tmp_path / "two.tdms", segment, [GroupObject("other", {"note": "x" * 200}), *segment])
    path.write_bytes(path.read_bytes()[: one + 60])
    recording = read(path)
    assert recording.channel("a").values.size == 10
    assert any("the data in its last 60 bytes are lost" in warning for warning in recording.warnings)


def test_a_broken_chain_of_segments_is_refused_with_its_place(tmp_path):
    segment = [ChannelObject("g", "a", np.arange(10.0), waveform(0.1))]
    one = written(tmp_path / "one.tdms", segment).stat().st_size
    path = written(tmp_path / "broken.tdms", segment, segment)
    content = bytearray(path.read_bytes())
    content[one : one + 4] = b"XXXX"
    path.write_bytes(content)
    with pytest.raises(ReadError, match=f"at byte {one} of {len(content)} a segment starting with TDSm was expected"):
        read(path, "tdms")


def test_a_file_without_numbers_says_so(tmp_path):
    path = written(tmp_path / "text.tdms", [ChannelObject("g", "remarks", ["a", "b"])])
    with pytest.raises(ReadError, match=r"no channel holds numbers.*it holds text"):
        read(path)


def test_a_real_file_of_raw_counts_with_scaling(shared_data):
    recording = read(shared_data / "tdms" / "raw1.tdms")
    assert len(recording.channels) == 7
    assert recording.warnings == ()
    channel = recording.channel("First  Channel")
    assert channel.unit == "Volts"
    assert channel.values.size == 2000
    assert channel.time is not None
    assert np.diff(channel.time) == pytest.approx(2e-5, rel=1e-9)  # 50 kHz
    assert np.abs(channel.values).max() < 10
    assert channel.values[0] == pytest.approx(-603 * 0.0003051850947599719, rel=1e-12)  # a 16-bit count of a 10 V range
    assert recording.start == datetime(2016, 12, 15, 22, 35, 21, tzinfo=UTC)


def test_raw_counts_whose_scaling_is_lost_are_given_with_a_warning(shared_data, tmp_path):
    path = tmp_path / "unscaled.tdms"
    path.write_bytes(
        (shared_data / "tdms" / "raw1.tdms").read_bytes().replace(b"NI_Number_Of_Scales", b"XX_Number_Of_Scales")
    )
    recording = read(path)
    assert recording.channel(1).values[0] == -603
    assert any("raw counts" in warning for warning in recording.warnings)


def two_channels(path, step=0.005):
    """A file in several segments of which the second channel starts 0.1 s late and at another rate."""
    late = START + np.timedelta64(100, "ms")
    segments = [
        [
            ChannelObject("Messung", "LVDT 1", np.arange(400.0) + 400 * part, waveform(step)),
            ChannelObject("Messung", "ACC", np.arange(200.0) + 200 * part, waveform(0.01, late)),
        ]
        for part in range(5)
    ]
    return written(path, *segments)


@every("window", [(2.0, 3.0), (0.0, 0.5), (9.0, 30.0), (0.05, 0.06)])
def test_a_window_of_a_long_file_is_what_the_whole_file_holds_there(tmp_path, window):
    path = two_channels(tmp_path / "long.tdms")
    whole, part = read(path), tdms.read_window(path, tdms.TdmsOptions(), Window(*window))
    for entire, found in zip(whole.channels, part.channels, strict=True):
        assert found.name == entire.name
        assert found.time is not None
        assert entire.time is not None
        inside, there = (
            np.flatnonzero((time >= window[0]) & (time <= window[1])) for time in (entire.time, found.time)
        )
        np.testing.assert_array_equal(found.values[there], entire.values[inside])
        np.testing.assert_array_equal(found.time[there], entire.time[inside])
    longest = max(channel.values.size for channel in part.channels)
    assert longest <= (window[1] - window[0]) / 0.005 + 4


def test_a_window_of_channels_without_a_clock_of_their_own_is_the_whole_file(tmp_path):
    path = two_channels(tmp_path / "long.tdms", step=1.0)  # LabVIEW's step where nobody told it one
    whole, part = read(path), tdms.read_window(path, tdms.TdmsOptions(), Window(2.0, 3.0))
    assert [channel.values.size for channel in part.channels] == [channel.values.size for channel in whole.channels]
