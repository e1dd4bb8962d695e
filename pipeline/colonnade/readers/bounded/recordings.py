"""A recording as what can be sent from one process to another: a header for JSON, and arrays."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, NonNegativeInt

from colonnade.readers.bounded.messages import Arrays
from colonnade.readers.recording import RecordedChannel, Recording

SAME = ("format", "notes", "warnings", "hint", "left_out")
"""What a header and a recording both have, in the same form."""


class Header(BaseModel):
    """
    All of a recording but its path and its numbers.

    Of each channel `columns` has name, unit, heading, whether it is a clock, and where among the arrays its values and
    its times are.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    format: str
    start: datetime | None
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    hint: str
    left_out: tuple[tuple[str, str], ...]
    columns: tuple[tuple[str, str | None, str, bool, NonNegativeInt, NonNegativeInt | None], ...]


def told(recording: Recording) -> tuple[dict[str, Any], Arrays]:
    """Take a recording apart; an array that several channels share is sent once."""
    arrays: Arrays = []
    numbers: dict[int, int] = {}

    def number(array: NDArray[Any] | None) -> int | None:
        if array is None:
            return None
        if id(array) not in numbers:
            numbers[id(array)] = len(arrays)
            arrays.append(array)
        return numbers[id(array)]

    columns = [
        (channel.name, channel.unit, channel.heading, channel.is_clock, number(channel.values), number(channel.time))
        for channel in recording.channels
    ]
    start = None if recording.start is None else recording.start.isoformat()
    return {**{name: getattr(recording, name) for name in SAME}, "start": start, "columns": columns}, arrays


def recording_of(path: Path, header: Any, arrays: Arrays) -> Recording:
    """
    Put a recording together again.

    Raises
    ------
    ValueError
        If a part is missing or of another form, or a channel names an array that is missing or has another length.
    """
    found = Header.model_validate(header)
    if any(array.dtype != np.float64 or array.ndim != 1 for array in arrays):
        raise ValueError("channels of numbers were expected")
    try:
        channels = tuple(
            RecordedChannel(name, unit, arrays[values], None if time is None else arrays[time], heading, is_clock)
            for name, unit, heading, is_clock, values, time in found.columns
        )
    except IndexError:
        raise ValueError("a channel names an array that is missing") from None
    return Recording(path, channels=channels, start=found.start, **{name: getattr(found, name) for name in SAME})
