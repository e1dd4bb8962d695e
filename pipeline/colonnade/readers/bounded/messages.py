"""
Messages between this process and the one that reads.

A request is a line of JSON. An answer is a line of JSON and the bytes of the arrays that it counts: numbers, names and
sentences, nothing that has to be trusted. A hijacked reader can lie about its file, and no more.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import IO, Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, BaseModel, ConfigDict, NonNegativeInt, PositiveInt

from colonnade.arrays import Array
from colonnade.readers.bounded.enclosure import Bounds
from colonnade.readers.recording import RecordedChannel, Recording, Window

LONGEST_LINE = 64_000_000
"""Bytes of JSON that an answer may have."""
BEGUN = b"begun\n"
"""Said when all is imported and the file is opened: from here on time counts."""

_STRICT = ConfigDict(extra="forbid", frozen=True)


def _whole(text: str) -> str:
    return text.encode("utf-8", errors="replace").decode("utf-8")


Text = Annotated[str, AfterValidator(_whole)]
"""Text without halves of characters, which a damaged file may have and UTF-8 has not."""


class BrokenAnswerError(Exception):
    """The answer is not valid: the reading process cannot be trusted."""


class EndedError(Exception):
    """An answer that is not whole: the reader ended."""


@dataclass(frozen=True)
class Request:
    """
    A file to be read.

    Attributes
    ----------
    wanted : str
        What it holds, the names of the other files that it is in, the cells of a workbook's first sheet, or the pixels
        of a photo.
    path, within : str
        The file, and the folder whose files may be read.
    format : str
    options : dict
    window : Window or None
    bounds : Bounds
    """

    wanted: Literal["recording", "companions", "cells", "photo"]
    path: str
    within: str
    format: str
    options: dict[str, Any]
    window: Window | None
    bounds: Bounds

    def line(self) -> bytes:
        """Write it as one line."""
        return json.dumps(asdict(self)).encode() + b"\n"

    @classmethod
    def of(cls, line: bytes) -> Request:
        """Read it."""
        said = json.loads(line)
        window = None if said["window"] is None else Window(**said["window"])
        return cls(**{**said, "window": window, "bounds": Bounds(**said["bounds"])})


class Column(BaseModel):
    """A channel, whose values and times are among the arrays, by number."""

    model_config = _STRICT

    name: Text
    unit: Text | None
    heading: Text
    is_clock: bool
    values: NonNegativeInt
    time: NonNegativeInt | None


class Answer(BaseModel):
    """
    What came of a request.

    Attributes
    ----------
    refusal : str
        Why the file cannot be read; empty if it was.
    error_number : int or None
        The system's own number of what went wrong, where it did.
    out_of_memory : bool
    exit_code : int or None
        How the copy of the process that was to read it ended, where it did so without an answer.
    """

    model_config = _STRICT

    refusal: str = ""
    error_number: int | None = None
    out_of_memory: bool = False
    exit_code: int | None = None
    companions: tuple[str, ...] = ()
    cells: tuple[tuple[Text, ...], ...] = ()
    format: str = ""
    start: datetime | None = None
    notes: tuple[Text, ...] = ()
    warnings: tuple[Text, ...] = ()
    hint: Text = ""
    left_out: tuple[tuple[Text, Text], ...] = ()
    columns: tuple[Column, ...] = ()
    photo: tuple[PositiveInt, PositiveInt] | None = None
    sizes: tuple[NonNegativeInt, ...] = ()


_SAME = ("format", "start", "notes", "warnings", "hint", "left_out")
"""What an answer and a recording both have."""


def send(stream: IO[bytes], answer: Answer, arrays: list[Array]) -> None:
    """Write an answer and its arrays."""
    stream.write(answer.model_dump_json().encode("utf-8") + b"\n")
    for array in arrays:
        stream.write(array.data)
    stream.flush()


def told(recording: Recording) -> tuple[Answer, list[Array]]:
    """Take a recording apart; an array that several channels share is sent once."""
    arrays: list[Array] = []
    numbers: dict[int, int] = {}

    def number(array: Array) -> int:
        if id(array) not in numbers:
            numbers[id(array)] = len(arrays)
            arrays.append(np.ascontiguousarray(array, dtype=np.float64))
        return numbers[id(array)]

    columns = tuple(
        Column(
            name=channel.name,
            unit=channel.unit,
            heading=channel.heading,
            is_clock=channel.is_clock,
            values=number(channel.values),
            time=None if channel.time is None else number(channel.time),
        )
        for channel in recording.channels
    )
    same = {name: getattr(recording, name) for name in _SAME}
    return Answer(**same, columns=columns, sizes=tuple(array.size for array in arrays)), arrays


def pixels_told(pixels: NDArray[np.uint8]) -> tuple[Answer, list[Array]]:
    """Send a photo's pixels, three bytes each, as if they were numbers of eight bytes."""
    height, width, _ = pixels.shape
    packed = np.zeros(_packed_size(height, width))
    packed.view(np.uint8)[: pixels.size] = pixels.ravel()
    return Answer(photo=(height, width), sizes=(packed.size,)), [packed]


def pixels_of(answer: Answer, arrays: list[Array], largest_side: int) -> NDArray[np.uint8]:
    """
    Take a photo's pixels out of an answer.

    Raises
    ------
    BrokenAnswerError
        If the answer holds no photo, or one larger than asked for.
    """
    if answer.photo is None or len(arrays) != 1 or max(answer.photo) > largest_side:
        raise BrokenAnswerError("the answer is not a photo")
    height, width = answer.photo
    if arrays[0].size != _packed_size(height, width):
        raise BrokenAnswerError("the photo is not whole")
    return arrays[0].view(np.uint8)[: 3 * height * width].reshape(height, width, 3)


def _packed_size(height: int, width: int) -> int:
    return -(-3 * height * width // 8)


def receive(stream: IO[bytes], largest: int) -> tuple[Answer, list[Array]]:
    """
    Read an answer and its arrays.

    Parameters
    ----------
    stream : binary stream
    largest : int
        Bytes that all arrays may have together.

    Raises
    ------
    BrokenAnswerError
        If the message is not a valid answer.
    EndedError
        If the stream ends before it does.
    """
    line = stream.readline(LONGEST_LINE)
    if not line.endswith(b"\n"):
        raise BrokenAnswerError("the answer has no end") if len(line) == LONGEST_LINE else EndedError
    try:
        answer = Answer.model_validate_json(line)
    except ValueError as error:
        raise BrokenAnswerError("the answer is not valid") from error
    if 8 * sum(answer.sizes) > largest:
        raise BrokenAnswerError("the answer is larger than its reader's memory")
    arrays = []
    for size in answer.sizes:
        array = np.empty(size)
        left = memoryview(array.view(np.uint8).data)
        while left and (count := stream.readinto(left)):  # type: ignore[attr-defined]
            left = left[count:]
        if left:
            raise EndedError
        arrays.append(array)
    return answer, arrays


def recording_of(path: Path, answer: Answer, arrays: list[Array]) -> Recording:
    """
    Put a recording together again.

    Raises
    ------
    BrokenAnswerError
        If a channel names an array that is missing or has another length.
    """
    try:
        channels = tuple(
            RecordedChannel(
                column.name,
                column.unit,
                arrays[column.values],
                None if column.time is None else arrays[column.time],
                column.heading,
                column.is_clock,
            )
            for column in answer.columns
        )
    except (IndexError, ValueError) as error:
        raise BrokenAnswerError("the answer is inconsistent") from error
    return Recording(path, channels=channels, **{name: getattr(answer, name) for name in _SAME})
