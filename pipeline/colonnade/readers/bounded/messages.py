"""
Messages between this process and the one that reads.

A request is a line of JSON. An answer is a line of JSON and the bytes of the arrays that it lists: numbers, names and
sentences, nothing that has to be trusted. A hijacked reader can lie about its file, and no more.
"""

from __future__ import annotations

import json
from datetime import datetime
from math import prod
from pathlib import Path
from typing import IO, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, JsonValue, NonNegativeInt

from colonnade.readers.bounded.enclosure import Bounds
from colonnade.readers.recording import RecordedChannel, Recording

Arrays = list[NDArray[Any]]
LONGEST_LINE = 64_000_000
"""Bytes of JSON that an answer may have."""
BEGUN = b"begun\n"
"""Said when all is imported and the file is opened: from here on time counts."""


class BrokenAnswerError(Exception):
    """The answer is not valid or not whole: the reading process ended, or cannot be trusted."""


class Request(BaseModel):
    """
    A file that a function is to read; it is written as a line of JSON.

    Attributes
    ----------
    function : str
        `module:name`; it takes the path and the options, and returns a header for JSON and arrays.
    path, within : Path
        The file, and the folder whose files may be read.
    options : dict
    kind : str
        What the file is read as, for messages.
    modules : tuple of str
        What the function imports; they are imported before the file is opened.
    bounds : Bounds
    """

    function: str
    path: Path
    within: Path
    options: dict[str, JsonValue]
    kind: str
    modules: tuple[str, ...]
    bounds: Bounds

    def line(self) -> bytes:
        """Write it as one line; names of files need not be valid UTF-8."""
        return json.dumps(self.model_dump(), default=str).encode() + b"\n"


class Form(BaseModel):
    """What the bytes of an array are."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    dtype: Literal["<f8", "|u1"]
    shape: tuple[NonNegativeInt, ...]


class Answer(BaseModel):
    """
    What came of a request.

    Attributes
    ----------
    refusal : str
        Why the file cannot be read; empty if it was.
    error_number : int or None
        The system's own number of what went wrong, where it did.
    header : JSON
    arrays : tuple of Form
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    refusal: str = ""
    error_number: int | None = None
    header: JsonValue = None
    arrays: tuple[Form, ...] = ()


def send(stream: IO[bytes], arrays: Arrays, **answer: Any) -> None:
    """Write an answer and its arrays; each is freed once it is sent, so that the receiver can use its memory."""
    forms = [Form(dtype="|u1" if array.dtype == np.uint8 else "<f8", shape=array.shape) for array in arrays]
    # Halves of characters, which a damaged file may have and UTF-8 has not, become question marks.
    told = {**answer, "arrays": [form.model_dump() for form in forms]}
    stream.write(json.dumps(told, ensure_ascii=False).encode("utf-8", errors="replace") + b"\n")
    for form in forms:
        array = np.ascontiguousarray(arrays.pop(0), dtype=form.dtype)
        stream.write(array.reshape(-1).view(np.uint8).data)
    stream.flush()


def receive(stream: IO[bytes], largest: int) -> tuple[Answer, Arrays]:
    """Read an answer and its arrays, of so many bytes at most; BrokenAnswerError if it is not valid or not whole."""
    line = stream.readline(LONGEST_LINE)
    if not line.endswith(b"\n"):
        raise BrokenAnswerError("the answer has no end")
    try:
        answer = Answer.model_validate_json(line)
    except ValueError as error:
        raise BrokenAnswerError("the answer is not valid") from error
    sizes = [prod(form.shape) * np.dtype(form.dtype).itemsize for form in answer.arrays]
    if sum(sizes) > largest:
        raise BrokenAnswerError("the answer is larger than its reader's memory")
    arrays = []
    for form, size in zip(answer.arrays, sizes, strict=True):
        content = np.empty(size, dtype=np.uint8)
        if stream.readinto(content.data) < size:  # type: ignore[attr-defined]
            raise BrokenAnswerError("the answer has no end")
        arrays.append(content.view(form.dtype).reshape(form.shape))
    return answer, arrays


SAME = ("format", "notes", "warnings")
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
    columns: tuple[tuple[str, str | None, str, bool, NonNegativeInt, NonNegativeInt | None], ...]


def told(recording: Recording) -> tuple[dict[str, Any], Arrays]:
    """Take a recording apart; an array that several channels share is sent once."""
    channels = recording.channels
    held = {id(each): each for channel in channels for each in (channel.values, channel.time) if each is not None}
    places = {key: place for place, key in enumerate(held)}
    columns = [
        (each.name, each.unit, each.heading, each.is_clock, places[id(each.values)], places.get(id(each.time)))
        for each in channels
    ]
    start = None if recording.start is None else recording.start.isoformat()
    header = {**{name: getattr(recording, name) for name in SAME}, "start": start, "columns": columns}
    return header, list(held.values())


def recording_of(path: Path, header: Any, arrays: Arrays) -> Recording:
    """Put a recording together again; ValueError if a part is missing or of another form."""
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
