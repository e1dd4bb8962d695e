"""HBM catman binary files (.bin): a header a channel, then the values channel by channel."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

import numpy as np
from pydantic import BaseModel, ConfigDict

from colonnade.errors import ReadError
from colonnade.readers.clock import RISING_SHARE, TIME_NAME, even_times, moment_after, rising_share
from colonnade.readers.recording import TIME_UNITS, Array, RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition

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


class CatmanOptions(BaseModel):
    """Nothing has to be said about a catman file: its header tells all."""

    model_config = ConfigDict(extra="forbid", frozen=True)


@dataclass(frozen=True)
class ChannelHeader:
    """What the file says of a channel; `step` in s, 0 where it is not told."""

    name: str
    unit: str
    length: int
    is_numeric: bool
    began: datetime | None
    step: float
    precision: str


class _CutOffError(Exception):
    """The file ends before what its headers announce."""


class _Bytes:
    """Little-endian numbers and texts of a binary file, one after the other."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.left = stream.seek(0, 2)
        stream.seek(0)

    def take(self, size: int) -> bytes:
        if not 0 <= size <= self.left:
            raise _CutOffError
        self.left -= size
        return self._stream.read(size)

    def number(self, form: str) -> float:
        return float(struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0])

    def whole(self, form: str) -> int:
        return int(struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0])

    def text(self, length_form: str = "h") -> str:
        return self.take(self.whole(length_form)).decode("cp1252", errors="replace").strip("\0 ")


def recognise(path: Path) -> Recognition:
    """Say whether the first bytes are a catman version and an offset within the file."""
    with path.open("rb") as stream:
        head = stream.read(8)
        size = stream.seek(0, 2)
    if len(head) == 8:
        version, offset, _ = struct.unpack("<hih", head)
        if version in VERSIONS and 80 < offset <= max(size, 1 << 16) and head[6:8] < b"\xff\xff":
            return Recognition(True, f"it starts with catman's version {version} and the offset of its values")
    return Recognition(False, "it does not start with a version of catman's binary format")


def read(path: Path, options: CatmanOptions) -> Recording:
    """
    Read a catman binary file.

    A channel goes by the nearest time channel above it of the same length, as catman writes a group.

    Raises
    ------
    ReadError
        If its headers are not whole, or it holds no numbers.
    """
    warnings: list[str] = []
    with path.open("rb") as stream:
        source = _Bytes(stream)
        try:
            version, offset, headers = _headers(source)
        except _CutOffError:
            raise ReadError(
                f"{path.name}: it ends within its headers, or these are damaged. Copy it from the recorder again."
            ) from None
        size = stream.seek(0, 2)
        if not 0 < offset <= size:
            raise ReadError(
                f"{path.name}: its values should start at byte {offset}, but it has {size} bytes: it was cut off."
            )
        stream.seek(offset)
        source.left = size - offset
        values = [_values(header, source, warnings) for header in headers]
    numeric = [(header, own) for header, own in zip(headers, values, strict=True) if own is not None and header.length]
    if not any(own.size for _, own in numeric):
        raise ReadError(f"{path.name}: its headers tell of {len(headers)} channels, but none of them holds a number.")
    channels: list[RecordedChannel] = []
    clock: Array | None = None
    for header, own in numeric:
        over = own == OVERFLOW
        if over.any():
            own[over] = np.nan
            warnings.append(
                f'"{header.name}": {int(over.sum())} of {own.size} values are catman\'s sign of an overflow or an open '
                "input; missing"
            )
        is_clock = _is_clock(header, own)
        clock = own * TIME_UNITS[header.unit.casefold()] if is_clock else clock
        time = clock if clock is not None and clock.size == own.size else _regular(header, own)
        channels.append(RecordedChannel(header.name, header.unit or None, own, time, is_clock=is_clock))
    text = [header.name for header in headers if not header.is_numeric]
    clocks = [channel.name for channel in channels if channel.is_clock]
    notes = [f"catman version {version}, values of {_told([header.precision for header, _ in numeric])} bytes"]
    notes += [f'clock: "{name}"' for name in clocks] or ["clock: the step in each channel's header"]
    notes += [f'no numbers in "{name}": left out' for name in text]
    return Recording(path, "catman", tuple(channels), numeric[0][0].began, tuple(notes), tuple(warnings))


def _headers(source: _Bytes) -> tuple[int, int, list[ChannelHeader]]:
    """Read the file's header and that of each channel."""
    version, offset = source.whole("h"), source.whole("i")
    for _ in range(1 + RESERVED_TEXTS):
        source.text()
    count = source.whole("h")
    source.whole("i")  # largest length
    source.take(4 * max(count, 0))  # offsets of the channels' headers
    source.whole("i")  # reduction
    return version, offset, [_header(source) for _ in range(count)]


def _header(source: _Bytes) -> ChannelHeader:
    """Read a channel's header."""
    source.whole("h")  # its number
    length = source.whole("i")
    if length < 0:
        raise _CutOffError
    name, unit, _ = source.text(), source.text(), source.text()
    kind = source.whole("h")  # 0 numbers, 1 text, 2 objects
    source.whole("h")  # bytes of a value in memory
    source.number("d")  # date of the file
    extended = source.take(source.whole("i"))
    if len(extended) <= EXPORT_FORMAT:
        date, milliseconds, export = 0.0, 0.0, 0
    else:
        date, milliseconds = struct.unpack_from("<2d", extended)
        export = extended[EXPORT_FORMAT]
    source.take(2)  # linearisation, scaling
    source.take(8 * source.whole("B"))
    source.whole("h")  # kind of thermocouple
    source.text()  # formula
    source.text("i")  # sensor
    step = milliseconds / 1000 if 0 < milliseconds < 1e9 else 0.0
    return ChannelHeader(
        name,
        unit,
        length,
        kind == 0,
        moment_after(DAY_ZERO, 86400 * date) if date > 1 else None,
        step,
        PRECISIONS.get(export, "<f8"),
    )


def _values(header: ChannelHeader, source: _Bytes, warnings: list[str]) -> Array | None:
    """Read a channel's values; None where they are no numbers."""
    if not header.is_numeric or not header.length:
        return None
    form = np.dtype(header.precision)
    low = high = 0.0
    try:
        if form.itemsize == 2:
            low, high = source.number("d"), source.number("d")
    except _CutOffError:
        source.left = 0
    there = min(header.length, source.left // form.itemsize)
    if there < header.length:
        warnings.append(f'"{header.name}": the file ends after {there} of its {header.length} values')
    with np.errstate(invalid="ignore"):
        raw = np.frombuffer(source.take(there * form.itemsize), dtype=form).astype(np.float64)
    if there < header.length:
        source.left = 0
    if form.itemsize == 2:
        with np.errstate(invalid="ignore", over="ignore"):
            raw = low + raw * ((high - low) / TWO_BYTE_STEPS)
    raw[~np.isfinite(raw)] = np.nan
    return raw


def _is_clock(header: ChannelHeader, values: Array) -> bool:
    """Whether a channel is the time since the start of its group, not the amplifier's own absolute clock."""
    if header.unit.casefold() not in TIME_UNITS or not values.size:
        return False
    named = TIME_NAME.match(header.name.casefold()) is not None
    return named and (values.size == 1 or rising_share(values) >= RISING_SHARE)


def _regular(header: ChannelHeader, values: Array) -> Array | None:
    return even_times(values.size, header.step) if header.step else None


def _told(forms: list[str]) -> str:
    return ", ".join(sorted({form[-1] for form in forms}))


FORMAT = Format(
    name="catman",
    summary="HBM catman binary, values of 2, 4 or 8 bytes.",
    suffixes=(".bin",),
    options=CatmanOptions,
    recognise=recognise,
    read=read,
)
