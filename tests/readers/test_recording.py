"""Channels are found by name or number, and their absence explained."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.recording import RecordedChannel, Recording
from every import every

VALUES = np.array([1.0, 2.0])
RECORDING = Recording(
    Path("raw/free-01.csv"),
    "delimited",
    (
        RecordedChannel("Time", "s", VALUES, VALUES, heading="Time [s]"),
        RecordedChannel("LVDT 1", "mm", VALUES, VALUES, heading="LVDT 1 [mm]"),
        RecordedChannel("LVDT 1", "V", VALUES, VALUES, heading="LVDT 1 [V]"),
        RecordedChannel("ACC", None, VALUES),
        RecordedChannel("off", None, VALUES * np.nan),
    ),
)


FOUND = {"ACC": 3, "acc": 3, " Acc ": 3, 4: 3, "LVDT 1 [mm]": 1, "lvdt1[V]": 2, "Time": 0, "time [s]": 0}


@every(("column", "index"), FOUND.items())
def test_a_channel_is_found_by_number_and_by_name_with_and_without_its_unit(column, index):
    assert RECORDING.channel(column) is RECORDING.channels[index]


@every(
    ("column", "message"),
    [
        ("AC", r'free-01.csv: no column is called "AC"; it has 5 columns. Did you mean "ACC"\?'),
        ("LVDT 1", r'2 columns are called "LVDT 1": columns 2 and 3'),
        (0, "column 0 is missing; it has columns 1 to 5"),
        (6, "column 6 is missing"),
    ],
)
def test_a_channel_that_is_not_there_is_explained(column, message):
    with pytest.raises(ReadError, match=message):
        RECORDING.channel(column)


def test_another_column_can_be_the_clock():
    clocked = RECORDING.on_clock("ACC", "LVDT 1 [V]")
    np.testing.assert_array_equal(clocked.time, VALUES)
    with pytest.raises(ReadError, match='"off" holds no number'):
        RECORDING.on_clock("ACC", "off")
    longer = replace(RECORDING, channels=(*RECORDING.channels, RecordedChannel("long", None, np.arange(3.0))))
    with pytest.raises(ReadError, match='"long" has 3 values, its clock "ACC" has 2'):
        longer.on_clock("long", "ACC")


def test_times_have_to_be_as_many_as_values():
    with pytest.raises(ValueError, match="2 values at 1 times"):
        RecordedChannel("a", None, VALUES, VALUES[:1])


@every(
    ("channel", "unit", "times", "how"),
    [
        (RecordedChannel("t", "ms", VALUES), None, [0.001, 0.002], "in ms"),
        (RecordedChannel("t", "ms", VALUES), "min", [60, 120], "in min"),
        (RecordedChannel("t", None, VALUES), None, [1, 2], "without a unit, taken as seconds"),
        (RecordedChannel("t", "mm", VALUES), None, [1, 2], "in mm"),
        (RecordedChannel("t", "ms", VALUES, 5 * VALUES, is_clock=True), None, [5, 10], "timestamps"),
    ],
)
def test_values_are_times_in_the_unit_that_is_known(channel, unit, times, how):
    seconds, said = channel.in_seconds(unit)
    np.testing.assert_allclose(seconds, times)
    assert said == how
