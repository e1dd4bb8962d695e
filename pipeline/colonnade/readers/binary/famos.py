"""imc FAMOS files (.raw, .dat): blocks between `|XX,` and `;` that describe the channels, and one with their bytes."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.readers.binary.numbers import Bytes, numbers_at
from colonnade.readers.clock import even_times, moment_after, on_one_zero
from colonnade.readers.format import Format, Options
from colonnade.readers.head import by_mark
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

NUMBERS = {1: "u1", 2: "i1", 3: "u2", 4: "i2", 5: "u4", 6: "i4", 7: "f4", 8: "f8", 12: "u8", 14: "i8"}
"""Kinds of numbers, by the block CP."""
LARGEST_HEAD = 40
PARAMETERS = {
    "CF": "w",  # byte order: 1 Intel, 2 Motorola
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
"""The parameters of the blocks that describe one channel, by their keys."""


recognise = by_mark((b"|CF,",), '"|CF,", the mark of imc FAMOS')


def read(path: Path, options: Options) -> Recording:
    """Read an imc FAMOS file."""
    content = np.memmap(path, dtype=np.uint8, mode="r")
    warnings: list[str] = []
    components: list[_Said] = []
    places: dict[int, Bytes] = {}
    data_set: _Said = {}
    current, order = data_set, "<"
    for place, key, block in _blocks(content, warnings):
        try:
            if key == "CS":
                number = block[:LARGEST_HEAD].tobytes().split(b",", 1)[0]
                places[int(number)] = block[len(number) + 1 :]
                continue
            told = _parameters(block.tobytes(), PARAMETERS[key])
            if key == "CF":
                order = ">" if told[0] == 2 else "<"
            elif key == "CG":
                data_set = current = {key: told}
            elif key == "CC":
                components.append(current := {**data_set})
            elif key == "NT":
                day, month, year, hour, minute, seconds = told
                current[key] = datetime(year, month, day, hour, minute) + timedelta(seconds=seconds)
            else:
                current[key] = told
        except (ValueError, OverflowError):
            warnings.append(f"the block {key} at byte {place} is damaged; it is left out")
    if "CG" in current and current is data_set:
        warnings.append("the last data set has no channel: the file was cut off")
    channels: list[RecordedChannel] = []
    for said in components:
        channel = _channel(said, places, order, len(channels) + 1, warnings)
        channels += [] if channel is None else [channel]
    timed, start = on_one_zero(channels)
    has_clock = any(channel.time is not None for channel in timed)
    notes = ["clock: each channel's own start and step" if has_clock else "no clock: x is not a time"]
    if not all(map(_is_plain, components)):
        notes.append("a data set of pairs (x, y): both are channels, neither is used as a clock")
    return Recording(path, "famos", timed, start, tuple(notes), tuple(warnings))


def _blocks(content: Bytes, warnings: list[str]) -> Iterator[tuple[int, str, Bytes]]:
    """Go from block to block: where each starts, its key, and what it holds."""
    place, size = 0, content.size
    while place < size:
        if content[place] in b" \t\r\n\0":
            place += 1
            continue
        parts = content[place : place + LARGEST_HEAD].tobytes().split(b",", 3)
        if parts[0][:1] != b"|" or len(parts) < 4 or not parts[2].strip().isdigit():
            warnings.append(f"a block was expected at byte {place}: what follows is damaged and not read")
            return
        name, begin = parts[0][1:].decode("latin-1"), place + sum(len(part) + 1 for part in parts[:3])
        end = begin + int(parts[2])
        if name == "CS" or name in PARAMETERS:
            yield place, name, content[begin:end]
        if end > size:
            warnings.append(f"the file ends within the block {name} at byte {place}: it was cut off")
        place = end + 1


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


def _channel(
    said: _Said, places: dict[int, Bytes], order: str, number: int, warnings: list[str]
) -> RecordedChannel | None:
    """Make a channel of a component; None if it is empty or not read, for a reason that is among the warnings."""
    bit, title = said.get("CN", (0, ""))
    size, kind, bits, mask, apart = said.get("CP", (0, 0, 0, 0, 0))
    index, first, shift, filled, x0, added = said.get("Cb", (0, 0, 0, None, 0.0, 0.0))
    form = NUMBERS.get(kind, "")
    reason = ""
    if bit > 0:
        reason = "a digital channel, which is a bit of a word, is not read; export it as numbers from imc FAMOS"
    elif filled and (form[1:] != str(size) or bits != 8 * size or mask or apart):
        reason = "its numbers are interleaved or of an unknown kind; left out"
    elif filled is None or (filled and index not in places):
        reason = "a block that its values need is missing: the file is damaged or was cut off"
    if reason or not filled:
        warnings += [f'"{title}": {reason}'] if reason else []
        return None
    is_scaled, factor, offset, unit = said.get("CR", (0, 1.0, 0.0, ""))
    scale = (offset, factor) if is_scaled == 1 else (0.0, 1.0)
    values = numbers_at(places[index], title, order + form, first + shift, filled // size, warnings, scale=scale)
    if not values.size:
        return None
    step, of_x = said.get("CD", (0.0, ""))
    second = TIME_UNITS.get(of_x.casefold())
    time = start = None
    if step > 0 and second is not None and _is_plain(said):
        time = even_times(values.size, step * second, x0 * second)
        start = moment_after(said.get("NT"), added)
    return RecordedChannel(title or f"channel {number}", unit or None, values, time, start=start)


FORMAT = Format(
    name="famos",
    summary="imc FAMOS files (imc bus format).",
    suffixes=(".raw", ".dat"),
    recognise=recognise,
    read=read,
)
