"""imc FAMOS files (.raw, .dat): blocks between `|XX,` and `;` that describe the channels, and one with their bytes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.binary.stored_numbers import Bytes, StoredNumbers, values_at
from colonnade.readers.clock import even_times, moment_after
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, by_mark, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

SIGNATURE = b"|CF,"
NUMBERS = {1: "u1", 2: "i1", 3: "u2", 4: "i2", 5: "u4", 6: "i4", 7: "f4", 8: "f8", 11: "u2", 12: "u8", 14: "i8"}
"""Kinds of numbers, by the block CP."""
BYTE_ORDERS = {"1": "<", "2": ">"}
"""Of the block CF: Intel, Motorola."""
LARGEST_BLOCK_HEAD = 40
WIDEST = 32
"""Bits of a word that may be digital channels; their numbers are exact in what they are read as."""


@dataclass
class _Component:
    """What the blocks say of one channel, as they come."""

    step: float = 0.0
    x_unit: str = ""
    is_plain: bool = True
    noted: datetime | None = None
    name: str = ""
    unit: str = ""
    factor: float = 1.0
    offset: float = 0.0
    number: str | None = None
    is_packed: bool = False
    is_partly_used: bool = False
    bytes_index: int = 0
    bytes_from: int = 0
    bytes_filled: int | None = None
    x0: float = 0.0
    added: float = 0.0
    digital: list[tuple[int, str]] = field(default_factory=list)
    """Channels that are single bits of the numbers: bit, from 1 for the lowest, and name."""

    @property
    def title(self) -> str:
        """What it is called in a warning."""
        return self.name or ", ".join(name for _, name in self.digital[:3])


@dataclass
class _File:
    """All components, where the bytes of each block CS stand, and what the blocks that come now belong to."""

    order: str = "<"
    data_set: _Component = field(default_factory=_Component)
    current: _Component = field(default_factory=_Component)
    components: list[_Component] = field(default_factory=list)
    bytes_at: dict[int, tuple[int, int]] = field(default_factory=dict)
    awaits_channel: bool = False
    warnings: list[str] = field(default_factory=list)


class _Parameters:
    """The parameters of a block, one after the other; texts are preceded by their length."""

    def __init__(self, content: bytes) -> None:
        self._content, self._place = content, 0

    def text(self) -> str:
        end = self._content.find(b",", self._place)
        end = len(self._content) if end < 0 else end
        found = self._content[self._place : end].decode("cp1252", "replace").strip()
        self._place = end + 1
        return found

    def whole(self) -> int:
        return int(self.text() or 0)

    def number(self) -> float:
        return float(self.text() or 0)

    def counted(self) -> str:
        length = self.whole()
        found = self._content[self._place : self._place + max(length, 0)].decode("cp1252", "replace")
        self._place += max(length, 0) + 1
        return found

    def skip(self, count: int) -> None:
        for _ in range(count):
            self.text()


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first bytes are those of a FAMOS file."""
    return by_mark(head, (SIGNATURE,), '"|CF,", the mark of imc FAMOS')


def read(path: Path, options: Options) -> Recording:
    """Read an imc FAMOS file."""
    content = np.memmap(path, dtype=np.uint8, mode="r")
    file = _File()
    for place, key, block in _blocks(content, file):
        try:
            _take(file, key, block)
        except (ValueError, OverflowError):
            file.warnings.append(f'the block {key} at byte {place} is damaged ("{_shown(block)}"); it is left out')
    if file.awaits_channel:
        file.warnings.append("the last data set has no channel: the file was cut off")
    channels, starts = _channels(content, file)
    notes = ["clock: each channel's own start and step" if starts else "no clock: x is not a time"]
    if not all(component.is_plain for component in file.components):
        notes.append("a data set of pairs (x, y): both are channels, neither is used as a clock")
    return Recording(path, "famos", tuple(channels), starts[0] if starts else None, tuple(notes), tuple(file.warnings))


def _channels(content: Bytes, file: _File) -> tuple[list[RecordedChannel], list[datetime | None]]:
    """Take the values of all components, and the moments at which those with a clock start."""
    channels: list[RecordedChannel] = []
    starts: list[datetime | None] = []
    for component in file.components:
        if reason := _refusal(component, file):
            file.warnings.append(f'"{component.title}": {reason}')
            continue
        values, told = values_at(content, _stored(component, file))
        file.warnings += told
        if not values.size:
            continue
        time, start = _clock(component, values.size)
        starts += [] if time is None else [start]
        name = component.name or f"channel {len(channels) + 1}"
        if component.digital:
            channels += _bits(component, name, values, time, file.warnings)
        else:
            channels.append(RecordedChannel(name, component.unit or None, values, time))
    return channels, starts


def _blocks(content: Bytes, file: _File) -> Iterator[tuple[int, str, bytes]]:
    """Go from block to block; of the block of bytes, CS, only its index is given."""
    place, size = 0, content.size
    while place < size:
        gap = content[place : place + 4096].tobytes()
        skipped = len(gap) - len(gap.lstrip(b" \t\r\n\0"))
        if skipped == len(gap):
            place += skipped
            continue
        place += skipped
        head = content[place : place + LARGEST_BLOCK_HEAD].tobytes()
        parts = head.split(b",", 3)
        if head[:1] != b"|" or len(parts) < 4 or not parts[1].strip().isdigit() or not parts[2].strip().isdigit():
            file.warnings.append(f"a block was expected at byte {place}: what follows is damaged and not read")
            return
        key, length = parts[0][1:].decode("latin-1"), int(parts[2])
        begin = place + sum(len(part) + 1 for part in parts[:3])
        if key == "CS":
            index = content[begin : begin + 20].tobytes().split(b",", 1)
            if len(index) < 2 or not index[0].strip().isdigit():
                file.warnings.append(f"the block CS at byte {place} is damaged: what follows is not read")
                return
            first = begin + len(index[0]) + 1
            file.bytes_at[int(index[0])] = (first, min(begin + length, size))
        else:
            yield place, key, content[begin : begin + length].tobytes()
        if begin + length > size:
            file.warnings.append(f"the file ends within the block {key} at byte {place}: it was cut off")
        place = begin + length + 1


def _take(file: _File, key: str, block: bytes) -> None:
    """Add what a block says to the data set or the channel that it belongs to."""
    told = _Parameters(block)
    if key == "CF":
        file.order = BYTE_ORDERS.get(told.text(), "<")
    elif key == "CG":
        told.skip(1)
        file.awaits_channel = True
        file.data_set = file.current = _Component(is_plain=told.whole() == 1)
    elif key == "CC":
        file.awaits_channel = False
        file.current = replace(file.data_set, digital=[])
        file.components.append(file.current)
    else:
        _describe(file.current, key, told)


def _describe(component: _Component, key: str, told: _Parameters) -> None:
    if key == "CD":
        component.step = told.number()
        told.skip(1)
        component.x_unit = told.counted()
    elif key == "NT":
        day, month, year, hour, minute = (told.whole() for _ in range(5))
        component.noted = datetime(year, month, day, hour, minute) + timedelta(seconds=told.number())
    elif key == "CP":
        told.skip(1)
        size, kind, bits, mask = (told.whole() for _ in range(4))
        told.skip(2)
        number = NUMBERS.get(kind)
        component.number = number if number is not None and int(number[1]) == size else None
        component.is_packed = told.whole() != 0 or mask != 0
        component.is_partly_used = bits != 8 * size
    elif key == "Cb":
        told.skip(3)
        component.bytes_index, component.bytes_from = told.whole(), told.whole()
        told.skip(1)
        component.bytes_from += told.whole()
        component.bytes_filled = told.whole()
        told.skip(1)
        component.x0, component.added = told.number(), told.number()
    elif key == "CR":
        transforms = told.whole() == 1
        factor, offset = told.number(), told.number()
        told.skip(1)
        component.unit = told.counted()
        if transforms:
            component.factor, component.offset = factor, offset
    elif key == "CN":
        told.skip(2)
        bit, name = told.whole(), told.counted()
        if bit > 0:
            component.digital.append((bit, name))
        else:
            component.name = component.name or name


def _refusal(component: _Component, file: _File) -> str:
    """Say why a channel's values cannot be read; empty if they can."""
    if component.digital and (component.number or "f")[0] == "f":
        return "digital channels have to be whole numbers, and these are not; left out"
    if component.bytes_filled is None:
        return "the block that says where its values are is missing: the file was cut off"
    # Of a word of digital channels some bits may be unused.
    is_whole = bool(component.digital) or not component.is_partly_used
    if component.bytes_filled and (component.number is None or component.is_packed or not is_whole):
        return "its numbers are interleaved or of an unknown kind; left out"
    if component.bytes_filled and component.bytes_index not in file.bytes_at:
        return "the block with its values is missing: the file was cut off"
    return ""


def _stored(component: _Component, file: _File) -> StoredNumbers:
    """Where the values are; of a channel without any, nowhere."""
    first, end = file.bytes_at.get(component.bytes_index, (0, 0))
    form = np.dtype(file.order + (component.number or "u1"))
    return StoredNumbers(
        component.title,
        component.unit,
        "",
        form.str,
        first + component.bytes_from,
        (component.bytes_filled or 0) // form.itemsize,
        form.itemsize,
        0.0 if component.digital else component.offset,
        1.0 if component.digital else component.factor,
        end=end,
    )


def _clock(component: _Component, count: int) -> tuple[Array | None, datetime | None]:
    """Times of a channel whose x is time, and the moment of the first."""
    scale = TIME_UNITS.get(component.x_unit.casefold())
    if component.step <= 0 or scale is None or not component.is_plain:
        return None, None
    begin = component.x0 * scale
    return even_times(count, component.step * scale, begin), moment_after(component.noted, component.added + begin)


def _bits(
    component: _Component, name: str, values: Array, time: Array | None, warnings: list[str]
) -> Iterator[RecordedChannel]:
    """Channels that are single bits of a word."""
    words = values.astype(np.int64)
    for bit, own in component.digital:
        if bit > WIDEST:
            warnings.append(f'"{own}": it is bit {bit} of a word, which has at most {WIDEST}; left out')
            continue
        is_set = (words >> (bit - 1) & 1).astype(np.float64)
        yield RecordedChannel(own or f"{name} bit {bit}", None, is_set, time)


def _shown(block: bytes) -> str:
    return "".join(character if character.isprintable() else " " for character in block[:30].decode("latin-1"))


FORMAT = Format(
    name="famos",
    summary="imc FAMOS files (imc bus format).",
    suffixes=(".raw", ".dat"),
    recognise=recognise,
    read=read,
)
