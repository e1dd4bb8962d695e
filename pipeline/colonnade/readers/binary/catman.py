"""HBM catman binary files (.bin): one header for each channel, then the values channel by channel."""

from __future__ import annotations

import struct
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.binary.numbers import Bytes, StoredNumbers, values_at
from colonnade.readers.clock import RISING_SHARE, TIME_NAME, even_times, moment_after, rising_share
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

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


class _Fields:
    """Little-endian numbers and texts of a file, one after the other; struct.error where it ends before one does."""

    def __init__(self, content: Bytes) -> None:
        self._content, self._place = content, 0

    def take(self, form: str) -> Any:
        """The next number, or several as a tuple."""
        found = struct.unpack_from("<" + form, self._content.data, self._place)
        self._place += struct.calcsize("<" + form)
        return found[0] if len(found) == 1 else found

    def counted(self, size: int) -> bytes:
        """So many bytes."""
        if not 0 <= size <= self._content.size - self._place:
            raise struct.error
        self._place += size
        return self._content[self._place - size : self._place].tobytes()

    def text(self, length_form: str = "h") -> str:
        """A text behind its length."""
        return self.counted(self.take(length_form)).decode("cp1252", errors="replace").strip("\0 ")


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first bytes are a catman version and an offset within the file."""
    first, size = head.content[:8], head.path.stat().st_size
    if len(first) == 8:
        version, offset, _ = struct.unpack("<hih", first)
        if version in VERSIONS and 80 < offset <= max(size, 1 << 16) and first[6:8] < b"\xff\xff":
            return Recognition(True, f"it starts with catman's version {version} and the offset of its values")
    return Recognition(False, "it does not start with a version of catman's binary format")


def read(path: Path, options: Options) -> Recording:
    """
    Read a catman binary file.

    A channel goes by the nearest time channel above it of the same length, as catman writes a group.

    Raises
    ------
    ReadError
        If its headers are not whole.
    """
    try:
        content = np.memmap(path, dtype=np.uint8, mode="r")
        version, offset, headers = _headers(_Fields(content))
    except (struct.error, ValueError):
        raise ReadError(
            f"{path.name}: it ends within its headers, or these are damaged. Copy it from the recorder again."
        ) from None
    if not 0 < offset <= content.size:
        raise ReadError(
            f"{path.name}: its values should start at byte {offset}, but it has {content.size} bytes: it was cut off."
        )
    channels: list[RecordedChannel] = []
    warnings: list[str] = []
    numeric = [header for header in headers if header.is_numeric and header.length]
    place = offset
    for header in numeric:
        stored, place = _stored(header, content, place)
        values, told = values_at(content, stored)
        over = values == OVERFLOW
        values[over] = np.nan
        count = f"{int(over.sum())} of {values.size}"
        overflow = f'"{header.name}": {count} values are catman\'s sign of an overflow or an open input; missing'
        warnings += [*told, *([overflow] if over.any() else [])]
        channels.append(_on_clock(header, values, channels))
    sizes = ", ".join(sorted({header.precision[-1] for header in numeric}))
    clocks = [f'clock: "{channel.name}"' for channel in channels if channel.is_clock]
    notes = [
        f"catman version {version}, values of {sizes} bytes",
        *(clocks or ["clock: the step in each channel's header"]),
    ]
    notes += [f'no numbers in "{header.name}": left out' for header in headers if not header.is_numeric]
    start = moment_after(DAY_ZERO, 86400 * numeric[0].date) if numeric and numeric[0].date > 1 else None
    return Recording(path, "catman", tuple(channels), start, tuple(notes), tuple(warnings))


class _Header(NamedTuple):
    """The header of a channel; `date` in days, `step` in s, each 0 if it is not given."""

    name: str
    unit: str
    length: int
    is_numeric: bool
    date: float
    step: float
    precision: str


def _headers(fields: _Fields) -> tuple[int, int, list[_Header]]:
    """Read the file's header and that of each channel."""
    version, offset = fields.take("hi")
    for _ in range(1 + RESERVED_TEXTS):
        fields.text()
    count, _ = fields.take("hi")  # the second is the largest length
    fields.counted(4 * max(count, 0))  # offsets of the channels' headers
    fields.take("i")  # reduction
    return version, offset, [_header(fields) for _ in range(count)]


def _header(fields: _Fields) -> _Header:
    """Read a channel's header."""
    _, length = fields.take("hi")  # the first is its number
    if length < 0:
        raise struct.error
    name, unit, _ = fields.text(), fields.text(), fields.text()
    kind, _, _ = fields.take("hhd")  # 0 numbers, 1 text, 2 objects; bytes of a value in memory; date of the file
    extended = fields.counted(fields.take("i"))
    date, milliseconds, export = 0.0, 0.0, 0
    if len(extended) > EXPORT_FORMAT:
        (date, milliseconds), export = struct.unpack_from("<2d", extended), extended[EXPORT_FORMAT]
    fields.counted(2)  # linearisation, scaling
    fields.counted(8 * fields.take("B"))
    fields.take("h")  # kind of thermocouple
    fields.text()  # formula
    fields.text("i")  # sensor
    step = milliseconds / 1000 if 0 < milliseconds < 1e9 else 0.0
    return _Header(name, unit, length, kind == 0, date, step, PRECISIONS.get(export, "<f8"))


def _stored(header: _Header, content: Bytes, place: int) -> tuple[StoredNumbers, int]:
    """Where a channel's values are, from a byte on, and the byte behind them."""
    size, low, factor = int(header.precision[-1]), 0.0, 1.0
    if size == 2:  # steps between the smallest and the largest value, which stand before them
        if place + 16 <= content.size:
            low, high = struct.unpack_from("<2d", content.data, place)
            factor = (high - low) / TWO_BYTE_STEPS
        place += 16
    stored = StoredNumbers(header.name, header.precision, place, header.length, size, low, factor)
    return stored, place + header.length * size


def _on_clock(header: _Header, values: Array, above: list[RecordedChannel]) -> RecordedChannel:
    """Give a channel the times of the nearest time channel above it, where that is as long, else its header's step."""
    factor = TIME_UNITS.get(header.unit.casefold())
    # The time since the start of its group, not the amplifier's own absolute clock.
    is_named = TIME_NAME.match(header.name.casefold()) is not None
    if factor and is_named and (values.size == 1 or rising_share(values) >= RISING_SHARE):
        return RecordedChannel(header.name, header.unit, values, values * factor, is_clock=True)
    clock = next((channel.time for channel in reversed(above) if channel.is_clock), None)
    if clock is None or clock.size != values.size:
        clock = even_times(values.size, header.step) if header.step else None
    return RecordedChannel(header.name, header.unit or None, values, clock)


FORMAT = Format(
    name="catman",
    summary="HBM catman binary, values of 2, 4 or 8 bytes.",
    suffixes=(".bin",),
    recognise=recognise,
    read=read,
)
