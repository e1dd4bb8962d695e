"""imc FAMOS files (.raw, .dat): blocks between `|XX,` and `;` that describe the channels, and one with their bytes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.binary.numbers import Bytes, StoredNumbers, values_at
from colonnade.readers.clock import even_times, moment_after, on_one_zero
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, by_mark, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

SIGNATURE = b"|CF,"
NUMBERS = {1: "u1", 2: "i1", 3: "u2", 4: "i2", 5: "u4", 6: "i4", 7: "f4", 8: "f8", 11: "u2", 12: "u8", 14: "i8"}
"""Kinds of numbers, by the block CP."""
BYTE_ORDERS = {1: "<", 2: ">"}
"""Of the block CF: Intel, Motorola."""
LARGEST_BLOCK_HEAD = 40
WIDEST = 32
"""Bits of a word that may be digital channels; their numbers are exact in what they are read as."""
PARAMETERS = {
    "CF": "w",  # byte order
    "CG": "-w",  # 1: one component, its x even
    "CC": "",
    "CD": "n-t",  # step and unit of x
    "NT": "wwwwwn",  # day, month, year, hour, minute, second
    "CP": "-wwww--w",  # bytes of a number, its kind, its bits, mask, bytes from one to the next
    "Cb": "---ww-ww-nn",  # its block CS, first byte, shift of it, bytes that are filled, first x, time added
    "CR": "wnn-t",  # 1: scaled by factor and offset; unit
    "CN": "--wt",  # bit, from 1 for the lowest, of a digital channel; name
}
"""Of the blocks that are read, each parameter: a whole number, a number, a text behind its length, or one to skip."""

_Said = dict[str, Any]
"""The parameters of the blocks that describe one channel, by their keys; of CN those of each."""


@dataclass
class _File:
    """All channels, where the bytes of each block CS stand, and what the blocks that come now belong to."""

    order: str = "<"
    data_set: _Said = field(default_factory=dict)
    current: _Said = field(default_factory=dict)
    components: list[_Said] = field(default_factory=list)
    bytes_at: dict[int, tuple[int, int]] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


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
            shown = "".join(character if character.isprintable() else " " for character in block[:30].decode("latin-1"))
            file.warnings.append(f'the block {key} at byte {place} is damaged ("{shown}"); it is left out')
    if "CG" in file.current and file.current is file.data_set:
        file.warnings.append("the last data set has no channel: the file was cut off")
    channels: list[RecordedChannel] = []
    for said in file.components:
        found = _values(content, file, said)
        if found.size:
            channels += _named(said, found, len(channels) + 1, file.warnings)
    timed, start = on_one_zero(channels)
    has_clock = any(channel.time is not None for channel in timed)
    notes = ["clock: each channel's own start and step" if has_clock else "no clock: x is not a time"]
    if not all(map(_is_plain, file.components)):
        notes.append("a data set of pairs (x, y): both are channels, neither is used as a clock")
    return Recording(path, "famos", timed, start, tuple(notes), tuple(file.warnings))


def _blocks(content: Bytes, file: _File) -> Iterator[tuple[int, str, bytes]]:
    """Go from block to block; of a block of bytes, CS, only its place is noted."""
    place, size = 0, content.size
    while place < size:
        gap = content[place : place + 4096].tobytes()
        skipped = len(gap) - len(gap.lstrip(b" \t\r\n\0"))
        place += skipped
        if skipped == len(gap):
            continue
        parts = content[place : place + LARGEST_BLOCK_HEAD].tobytes().split(b",", 4)
        if parts[0][:1] != b"|" or len(parts) < 4 or not parts[1].strip().isdigit() or not parts[2].strip().isdigit():
            file.warnings.append(f"a block was expected at byte {place}: what follows is damaged and not read")
            return
        key, length = parts[0][1:].decode("latin-1"), int(parts[2])
        begin = place + sum(len(part) + 1 for part in parts[:3])
        if key == "CS":
            if len(parts) < 5 or not parts[3].strip().isdigit():
                file.warnings.append(f"the block CS at byte {place} is damaged: what follows is not read")
                return
            file.bytes_at[int(parts[3])] = (begin + len(parts[3]) + 1, min(begin + length, size))
        else:
            yield place, key, content[begin : begin + length].tobytes()
        if begin + length > size:
            file.warnings.append(f"the file ends within the block {key} at byte {place}: it was cut off")
        place = begin + length + 1


def _take(file: _File, key: str, block: bytes) -> None:
    """Add what a block says to the data set or the channel that it belongs to."""
    if key not in PARAMETERS:
        return
    told = _parameters(block, PARAMETERS[key])
    if key == "CF":
        file.order = BYTE_ORDERS.get(told[0], "<")
    elif key == "CG":
        file.data_set = file.current = {key: told}
    elif key == "CC":
        file.current = {**file.data_set}
        file.components.append(file.current)
    elif key == "CN":
        file.current[key] = [*file.current.get(key, ()), told]
    elif key == "NT":
        day, month, year, hour, minute, seconds = told
        file.current[key] = datetime(year, month, day, hour, minute) + timedelta(seconds=seconds)
    else:
        file.current[key] = told


def _parameters(block: bytes, kinds: str) -> list[Any]:
    """Take the parameters of a block, one after the other, up to the last that is read."""
    found: list[Any] = []
    for kind in kinds:
        text, _, block = block.partition(b",")
        if kind == "t":
            length = max(int(text.strip() or 0), 0)
            text, block = block[:length], block[length + 1 :]
            found.append(text.decode("cp1252", "replace"))
        elif kind != "-":
            found.append((int if kind == "w" else float)(text.strip() or 0))
    return found


def _is_plain(said: _Said) -> bool:
    """Whether its x is even, and it is not one of a pair."""
    return "CG" not in said or said["CG"][0] == 1


def _name(said: _Said) -> str:
    """What a channel itself is called; empty of digital ones."""
    return next((name for bit, name in said.get("CN", ()) if bit <= 0 and name), "")


def _digital(said: _Said) -> list[tuple[int, str]]:
    """Channels that are single bits of the numbers."""
    return [(bit, name) for bit, name in said.get("CN", ()) if bit > 0]


def _values(content: Bytes, file: _File, said: _Said) -> Array:
    """Take a channel's values, scaled; none, with a warning, where that cannot be done."""
    digital = _digital(said)
    title = _name(said) or ", ".join(name for _, name in digital[:3])
    size, kind, bits, mask, apart = said.get("CP", (0, 0, 0, 0, 0))
    form = NUMBERS.get(kind, "")
    is_known = bool(form) and int(form[1]) == size
    # Of a word of digital channels some bits may be unused.
    is_whole = is_known and mask == apart == 0 and (bool(digital) or bits == 8 * size)
    index, first, shift, filled, *_ = said.get("Cb", (0, 0, 0, None))
    reason = ""
    if digital and (not is_known or form[0] == "f"):
        reason = "digital channels have to be whole numbers, and these are not; left out"
    elif filled is None:
        reason = "the block that says where its values are is missing: the file is damaged or was cut off"
    elif filled and not is_whole:
        reason = "its numbers are interleaved or of an unknown kind; left out"
    elif filled and index not in file.bytes_at:
        reason = "the block with its values is missing: the file was cut off"
    if reason or not filled:
        file.warnings += [f'"{title}": {reason}'] if reason else []
        return np.empty(0)
    begin, end = file.bytes_at[index]
    is_scaled, factor, offset, _ = said.get("CR", (0, 1.0, 0.0, ""))
    factor, offset = (factor, offset) if is_scaled == 1 and not digital else (1.0, 0.0)
    stored = StoredNumbers(
        title, file.order + form, begin + first + shift, filled // size, size, offset, factor, end=end
    )
    values, told = values_at(content, stored)
    file.warnings += told
    return values


def _clock(said: _Said, count: int) -> tuple[Array | None, datetime | None]:
    """Times of a channel whose x is time, and the moment of their zero."""
    step, unit = said.get("CD", (0.0, ""))
    scale = TIME_UNITS.get(unit.casefold())
    if step <= 0 or scale is None or not _is_plain(said):
        return None, None
    *_, x0, added = said["Cb"]
    return even_times(count, step * scale, x0 * scale), moment_after(said.get("NT"), added)


def _named(said: _Said, values: Array, number: int, warnings: list[str]) -> Iterator[RecordedChannel]:
    """Make a channel of values, or one of each bit of words that has a name."""
    name = _name(said) or f"channel {number}"
    time, start = _clock(said, values.size)
    digital = _digital(said)
    if not digital:
        yield RecordedChannel(name, said["CR"][-1] or None if "CR" in said else None, values, time, start=start)
        return
    words = values.astype(np.int64)
    for bit, own in digital:
        if bit > WIDEST:
            warnings.append(f'"{own}": it is bit {bit} of a word, which has at most {WIDEST}; left out')
            continue
        is_set = (words >> (bit - 1) & 1).astype(np.float64)
        yield RecordedChannel(own or f"{name} bit {bit}", None, is_set, time, start=start)


FORMAT = Format(
    name="famos",
    summary="imc FAMOS files (imc bus format).",
    suffixes=(".raw", ".dat"),
    recognise=recognise,
    read=read,
)
