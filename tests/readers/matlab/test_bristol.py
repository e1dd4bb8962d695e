"""The layouts of Bristol's shaking tables."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.readers.binary.vectors import Column
from colonnade.readers.matlab.bristol import lacking_channels, numbered_channels

SINE, RISING = np.sin(np.arange(20.0)).reshape(-1, 1), np.arange(20.0).reshape(-1, 1)


def layout(first: np.ndarray, rate: object = "200") -> dict[str, object]:
    return {
        "File_Header": {"SampleFrequency": rate},
        "Channel_1_Header": {"SignalName": " LVDT 1 ", "Unit": "mm"},
        "Channel_1_Data": first,
        "Channel_2_Data": SINE,
        "comment": "kept",
    }


def test_channels_have_the_names_and_units_of_their_headers() -> None:
    others, columns, scalars, notes = numbered_channels(layout(SINE))  # type: ignore[arg-type]
    assert [(column.name, column.unit, column.values.shape) for column in columns] == [
        ("LVDT 1", "mm", (20,)),
        (None, None, (20,)),
    ]
    assert others == {"comment": "kept"}
    assert scalars == {"File_Header.SampleFrequency": 200.0}
    assert notes


def test_a_first_channel_that_rises_is_the_clock() -> None:
    _, columns, scalars, notes = numbered_channels(layout(RISING))  # type: ignore[arg-type]
    assert columns[0].name == "time"
    assert scalars == {}
    assert "Channel_1_Data rises: it is the clock" in notes


@pytest.mark.parametrize("rate", ["", "fast", -5, np.empty((0, 0)), {}], ids=str)
def test_a_rate_that_is_none_is_none(rate: object) -> None:
    assert numbered_channels(layout(SINE, rate))[2] == {}  # type: ignore[arg-type]


def test_a_file_of_another_layout_is_left_as_it_is() -> None:
    variables = {"x": SINE}
    assert numbered_channels(variables) == (variables, [], {}, [])


def test_channels_that_are_missing_are_counted() -> None:
    columns = [Column(f"chan{number}", (), SINE.ravel()) for number in (1, 2)]
    assert lacking_channels({"No_Channels": np.array([[3]])}, columns) == [
        "No_Channels says 3, but 2 channels are in the file"
    ]
    assert lacking_channels({"No_Channels": np.array([[2]])}, columns) == []
    assert lacking_channels({}, columns) == []
