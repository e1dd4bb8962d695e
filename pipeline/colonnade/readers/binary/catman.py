"""HBM catman binary files (.bin): one header for each channel, then the values channel by channel."""

from __future__ import annotations

import struct
from datetime import datetime
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from colonnade.readers.binary.numbers import numbers_at
from colonnade.readers.clock import even_times, moment_after, with_clocks
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording

VERSIONS = range(5010, 5100)
RESERVED_TEXTS = 32
OVERFLOW = -1e6
"""What catman writes for a channel that overflowed or is not connected."""
DAY_ZERO = datetime(1899, 12, 30)
PRECISIONS = {0: "<f8", 1: "<f4", 2: "<u2"}
"""Of the header's export format."""
EXPORT_FORMAT = 140
"""Place of the export format in a channel's extended header, which starts with its date and its step in ms."""
TWO_BYTE_STEPS = 32767
"""Steps between the smallest and the largest value of a channel in two bytes."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first bytes are a catman version and an offset within the file."""
    first, size = head.content[:8], head.path.stat().st_size
    if len(first) == 8:
        version, offset, _ = struct.unpack("<hih", first)
        if version in VERSIONS and 80 < offset <= max(size, 1 << 16) and first[6:8] < b"\xff\xff":
            return Recognition(True, f"it starts with catman's version {version} and the offset of its values")
    return Recognition(False, "it does not start with a version of catman's binary format")


class _Header(NamedTuple):
    """The header of a channel; `date` in days, `step` in s, each 0 if it is not given."""

    name: str
    unit: str
    length: int
    is_numeric: bool
    date: float
    step: float
    precision: str


def read(path: Path, options: Options) -> Recording:
    """
    Read a catman binary file.

    A channel goes by the nearest time channel above it of the same length, as catman writes a group.
    """
    with path.open("rb") as stream:
        _, place = _taken(stream, "hi")  # the first is the version
        for _ in range(1 + RESERVED_TEXTS):
            _text(stream)
        count, _ = _taken(stream, "hi")  # the second is the largest length
        stream.read(4 * count + 4)  # offsets of the channels' headers, reduction
        headers = [_header(stream) for _ in range(count)]
    content = np.memmap(path, dtype=np.uint8, mode="r")
    numeric = [header for header in headers if header.is_numeric and header.length]
    channels: list[RecordedChannel] = []
    warnings: list[str] = []
    for header in numeric:
        size, scale = int(header.precision[-1]), (0.0, 1.0)
        if size == 2:  # steps between the smallest and the largest value, which stand before them
            low, high = np.frombuffer(content[place : place + 16].tobytes().ljust(16, b"\0"), "<f8")
            scale, place = (low, (high - low) / TWO_BYTE_STEPS), place + 16
        values = numbers_at(content, header.name, header.precision, place, header.length, warnings, scale=scale)
        place += header.length * size
        if (over := values == OVERFLOW).any():
            values[over] = np.nan
            what = f"{over.sum()} of {values.size} values are catman's sign of an overflow or an open input; missing"
            warnings.append(f'"{header.name}": {what}')
        times = even_times(values.size, header.step) if header.step else None
        channels.append(RecordedChannel(header.name, header.unit or None, values, times))
    notes = [f'no numbers in "{header.name}": left out' for header in headers if not header.is_numeric]
    start = moment_after(DAY_ZERO, 86400 * numeric[0].date) if numeric and numeric[0].date > 1 else None
    recording = Recording(path, "catman", tuple(channels), start, tuple(notes), tuple(warnings))
    return with_clocks(recording, yielding=range(len(channels)))


def _taken(stream: BinaryIO, form: str) -> Any:
    """The next number, or several as a tuple; struct.error where the file ends before."""
    found = struct.unpack("<" + form, stream.read(struct.calcsize("<" + form)))
    return found[0] if len(found) == 1 else found


def _text(stream: BinaryIO, length_form: str = "h") -> str:
    """A text behind its length."""
    return stream.read(_taken(stream, length_form)).decode("cp1252", errors="replace").strip("\0 ")


def _header(stream: BinaryIO) -> _Header:
    """Read a channel's header."""
    _, length = _taken(stream, "hi")  # the first is its number
    if length < 0:
        raise ValueError(f"a channel of {length} values")
    name, unit, _ = _text(stream), _text(stream), _text(stream)
    kind, _, _ = _taken(stream, "hhd")  # 0 numbers, 1 text, 2 objects; bytes of a value in memory; date of the file
    extended = stream.read(_taken(stream, "i"))
    date, milliseconds, export = 0.0, 0.0, 0
    if len(extended) > EXPORT_FORMAT:
        (date, milliseconds), export = struct.unpack_from("<2d", extended), extended[EXPORT_FORMAT]
    _taken(stream, "2B")  # linearisation, scaling
    stream.read(8 * _taken(stream, "B"))
    _taken(stream, "h")  # kind of thermocouple
    _text(stream)  # formula
    _text(stream, "i")  # sensor
    step = milliseconds / 1000 if 0 < milliseconds < 1e9 else 0.0
    return _Header(name, unit, length, kind == 0, date, step, PRECISIONS.get(export, "<f8"))


FORMAT = Format(
    name="catman",
    summary="HBM catman binary, values of 2, 4 or 8 bytes.",
    suffixes=(".bin",),
    recognise=recognise,
    read=read,
)
