"""Which column of a delimited file is its clock, and what part of it a window takes."""

from datetime import UTC, datetime

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.recording import Window
from colonnade.readers.registry import read
from colonnade.readers.text import delimited
from colonnade.readers.text.delimited import DelimitedOptions
from delimited_text import recorded
from every import every


@every(
    ("heading", "factor"),
    [
        ("Time [s]", 1.0),
        ("t", 1.0),
        ("Zeit (ms)", 1e-3),
        ("timestamp", 1.0),
        ("Elapsed time / min", 60.0),
        ("Χρόνος", 1.0),
    ],
)
def test_a_clock_is_known_by_its_name_and_unit(tmp_path, heading, factor):
    recording = recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n")
    np.testing.assert_allclose(recording.channel("a").time, np.array([0.0, 5.0, 10.0]) * factor)


@every("heading", ["T [°C]", "Temperature", "X", "Time constant", "T [V]"])
def test_a_rising_column_of_another_name_or_unit_is_no_clock(tmp_path, heading):
    assert recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n").channel("a").time is None


def test_a_clock_that_does_not_rise_is_refused_with_a_warning(tmp_path):
    recording = recorded(tmp_path, "Time;a\n5;1\n1;2\n4;0\n2;1\n")
    assert recording.channel("a").time is None
    assert "only 33\u00a0% of its steps go forward" in recording.warnings[0]


def test_the_clock_can_be_given(tmp_path):
    recording = recorded(tmp_path, "X;a\n0;1\n5;2\n10;0\n", time="x", time_unit="ms")
    np.testing.assert_allclose(recording.channel("a").time, [0.0, 0.005, 0.01])
    with pytest.raises(ReadError, match=r'no column is called "Tine".*Did you mean "Time"'):
        recorded(tmp_path, "Time;a\n0;1\n5;2\n10;0\n", time="Tine")


def test_each_column_goes_by_the_clock_on_its_left(tmp_path):
    recording = recorded(tmp_path, "Time 1;a;Time 2;b\n0;1;0;1\n1;2;10;2\n2;3;20;3\n")
    assert recording.channel("a").time.tolist() == [0, 1, 2]
    assert recording.channel("b").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]


def test_a_clock_that_was_given_leaves_the_other_clocks_to_be_chosen(tmp_path):
    text = "Time 1;a;X;Time 2\n0;1;5;0\n1;2;6;10\n2;3;7;20\n"
    recording = recorded(tmp_path, text, time="Time 1")
    assert recording.channel("X").time.tolist() == [0, 1, 2]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "X").time.tolist() == [5, 6, 7]


MORNING, LATE = datetime(2013, 4, 26, 10, 15, 0, 500000), datetime(2013, 4, 26, 23, 59, 59, 500000)


@every(
    ("stamps", "start"),
    [
        (["2013-04-26T10:15:00.5", "2013-04-26T10:15:01", "2013-04-26T10:15:01.5"], MORNING),
        (["2013/04/26 23:59:59.5", "2013/04/27 00:00:00.0", "2013/04/27 00:00:00.5"], LATE),
        (["26.04.2013 10:15:00,5", "26.04.2013 10:15:01,0", "26.04.2013 10:15:01,5"], MORNING),
        ([f"2013-04-26T12:15:{second}+02:00" for second in ("00.5", "01", "01.5")], MORNING.replace(tzinfo=UTC)),
        (["23:59:59.5", "00:00:00.0", "00:00:00.5"], None),
    ],
)
def test_timestamps_are_seconds_from_the_first(tmp_path, stamps, start):
    recording = recorded(tmp_path, "timestamp;a\n" + "".join(f"{stamp};{row}\n" for row, stamp in enumerate(stamps)))
    np.testing.assert_allclose(recording.channel("a").time, [0, 0.5, 1.0], atol=1e-9)
    assert recording.start == start


@pytest.fixture
def long(tmp_path, monkeypatch):
    """A file of several pieces, with a damaged line and a last one that is cut off."""
    monkeypatch.setattr("colonnade.readers.text.encoding.PIECE", 20_000)
    path = tmp_path / "long.csv"
    rows = [f"{number / 200:.3f},{number % 97}.5,{-number}" for number in range(9000)]
    rows[4100] += ",7"
    rows[-1] = rows[-1][:-1]
    path.write_text("Time [s],LVDT 1 [mm],count\n" + "\n".join(rows))
    return path


@every("window", [(20.0, 20.7), (0.0, 1.0), (44.5, 90.0), (-5.0, 900.0)])
def test_a_window_of_a_long_file_is_what_the_whole_file_holds_there(long, window):
    whole = read(long)
    part = delimited.read(long, DelimitedOptions(), Window(*window))
    for all_of_it, some in zip(whole.channels, part.channels, strict=True):
        inside, there = ((time >= window[0]) & (time <= window[1]) for time in (all_of_it.time, some.time))
        np.testing.assert_array_equal(some.time[there], all_of_it.time[inside])
        np.testing.assert_array_equal(some.values[there], all_of_it.values[inside])


def test_lines_keep_their_numbers_in_a_window(long):
    part = delimited.read(long, DelimitedOptions(), Window(20.0, 20.7))
    assert [warning for warning in part.warnings if "line 4102" in warning]
    assert not [warning for warning in part.warnings if "the file ends" in warning]
    assert part.channels[0].values.size < 3000


def test_a_window_of_a_file_without_a_clock_is_counted_in_samples(long):
    text = long.read_text()
    long.write_text("\n".join(line.partition(",")[2] for line in text.splitlines()))
    part = delimited.read(long, DelimitedOptions(), Window(0.0, 2.0, sampling_rate_hz=200.0))
    assert 400 <= part.channels[0].values.size < 3000
    assert part.channels[1].values[400] == -400


def test_a_window_that_the_file_does_not_reach_is_told(long):
    with pytest.raises(ReadError, match="none of its 9000 samples is within the test's window"):
        delimited.read(long, DelimitedOptions(), Window(50.0, 60.0))
