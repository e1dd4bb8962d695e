"""imc FAMOS files (.raw, .dat): blocks between `|XX,` and `;` that describe the channels, and one with their bytes."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from colonnade.readers.binary.numbers import Bytes, numbers_at
from colonnade.readers.clock import even_times, moment_after, on_one_zero
from colonnade.readers.format import Format, Options
from colonnade.readers.head import by_mark
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

NUMBERS = {1: "u1", 2: "i1", 3: "u2", 4: "i2", 5: "u4", 6: "i4", 7: "f4", 8: "f8", 12: "u8", 14: "i8"}
"""Kinds of numbers, by the block CP."""
LARGEST_HEAD = 40
TEXTS = {"CD": 3, "CR": 5, "CN": 4}
"""Blocks with a text, and its place among their fields, behind that of its length."""
KEYS = ("CF", "CG", "CC", "CD", "NT", "CP", "Cb", "CR", "CN", "CS")
"""Blocks that are read: byte order, data set, component, step, start, packing, place, scale, name and the bytes."""

_Fields = dict[str, list[bytes]]
"""The fields of the blocks that describe one channel, by their keys."""

recognise = by_mark((b"|CF,",), '"|CF,", the mark of imc FAMOS')


def read(path: Path, options: Options) -> Recording:
    """Read an imc FAMOS file."""
    warnings: list[str] = []
    components: list[_Fields] = []
    places: dict[bytes, Bytes] = {}
    data_set: _Fields = {}
    current, order = data_set, "<"
    for key, block in _blocks(np.memmap(path, dtype=np.uint8, mode="r"), warnings):
        if key == "CS":
            index = block[:LARGEST_HEAD].tobytes().split(b",", 1)[0]
            places[index.strip()] = block[len(index) + 1 :]
            continue
        fields = block.tobytes().split(b",", TEXTS.get(key, -1))
        if key == "CF":
            order = ">" if fields[0] == b"2" else "<"
        elif key == "CG":
            data_set = current = {key: fields}
        elif key == "CC":
            components.append(current := {**data_set})
        else:
            current[key] = fields
    if "CG" in current and current is data_set:
        warnings.append("the last data set has no channel: the file was cut off")
    channels: list[RecordedChannel] = []
    for number, said in enumerate(components, 1):
        name = _text(said, "CN") or f"channel {number}"
        try:
            channels += _channel(name, said, places, order, warnings)
        except KeyError as error:
            warnings.append(f'"{name}" is left out: its block {error} is missing: the file is damaged or was cut off')
        except (ValueError, IndexError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: {error}')
    timed, start = on_one_zero(channels)
    has_clock = any(channel.time is not None for channel in timed)
    note = "clock: each channel's own start and step" if has_clock else "no clock: x is not an even time"
    return Recording(path, "famos", timed, start, (note,), tuple(warnings))


def _blocks(content: Bytes, warnings: list[str]) -> Iterator[tuple[str, Bytes]]:
    """Go from block to block: the key of each, and what it holds."""
    place, size = 0, content.size
    while place < size:
        if content[place] in b" \t\r\n\0":
            place += 1
            continue
        parts = content[place : place + LARGEST_HEAD].tobytes().split(b",", 3)
        if parts[0][:1] != b"|" or len(parts) < 4 or not parts[2].strip().isdigit():
            warnings.append(f"a block was expected at byte {place}: what follows is damaged and not read")
            return
        key, begin = parts[0][1:].decode("latin-1"), place + sum(len(part) + 1 for part in parts[:3])
        end = begin + int(parts[2])
        if key in KEYS:
            yield key, content[begin:end]
        if end > size:
            warnings.append(f"the file ends within the block {key} at byte {place}: it was cut off")
        place = end + 1


def _text(said: _Fields, key: str) -> str:
    """The text of a block, which stands behind its length; empty where there is none."""
    *_, length, text = [b"", b"", *said.get(key, [])]
    return text[: int(length) if length.strip().isdigit() else 0].decode("cp1252", "replace")


def _channel(
    name: str, said: _Fields, places: dict[bytes, Bytes], order: str, warnings: list[str]
) -> Iterator[RecordedChannel]:
    """Make a channel of a component, none if it holds no value; KeyError or ValueError where it cannot be read."""
    size, kind, bits, mask, apart = (int(said["CP"][field]) for field in (1, 2, 3, 4, 7))
    first, shift, filled = (int(said["Cb"][field]) for field in (4, 6, 7))
    form = NUMBERS.get(kind, "")
    if int(said.get("CN", [b"0"] * 3)[2]) > 0 or form[1:] != str(size) or bits != 8 * size or mask or apart:
        raise ValueError("bits of words and numbers that are interleaved are not read; export it as numbers from FAMOS")
    is_scaled, factor, offset, *_ = said.get("CR", [b"0"] * 3)
    scale = (float(offset), float(factor)) if is_scaled == b"1" else (0.0, 1.0)
    values = numbers_at(
        places[said["Cb"][3].strip()], name, order + form, first + shift, filled // size, warnings, scale=scale
    )
    step, second = float(said.get("CD", [b"0"])[0]), TIME_UNITS.get(_text(said, "CD").casefold())
    time = start = None
    if step > 0 and second is not None and int(said.get("CG", [b"", b"1"])[1]) == 1:
        time = even_times(values.size, step * second, float(said["Cb"][9]) * second)
        if "NT" in said:
            day, month, year, hour, minute = map(int, said["NT"][:5])
            begun = datetime(year, month, day, hour, minute) + timedelta(seconds=float(said["NT"][5]))
            start = moment_after(begun, float(said["Cb"][10]))
    if values.size:
        yield RecordedChannel(name, _text(said, "CR") or None, values, time, start=start)


FORMAT = Format(
    name="famos",
    summary="imc FAMOS files (imc bus format).",
    suffixes=(".raw", ".dat"),
    recognise=recognise,
    read=read,
)
