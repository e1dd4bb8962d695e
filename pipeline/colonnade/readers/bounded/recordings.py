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
_STRICT = ConfigDict(extra="forbid", frozen=True)


class Column(BaseModel):
    """A channel, whose values and times are among the arrays, by number."""

    model_config = _STRICT

    name: str
    unit: str | None
    heading: str
    is_clock: bool
    values: NonNegativeInt
    time: NonNegativeInt | None


class Header(BaseModel):
    """All of a recording but its path and its numbers."""

    model_config = _STRICT

    format: str
    start: datetime | None
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    hint: str
    left_out: tuple[tuple[str, str], ...]
    columns: tuple[Column, ...]


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
        {
            **{name: getattr(channel, name) for name in ("name", "unit", "heading", "is_clock")},
            "values": number(channel.values),
            "time": number(channel.time),
        }
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
            RecordedChannel(
                **column.model_dump(exclude={"values", "time"}),
                values=arrays[column.values],
                time=None if column.time is None else arrays[column.time],
            )
            for column in found.columns
        )
    except IndexError:
        raise ValueError("a channel names an array that is missing") from None
    return Recording(path, channels=channels, start=found.start, **{name: getattr(found, name) for name in SAME})
