"""Is a document of the old Office programs (.xls) whole? Its chains of sectors are followed, each to its end."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

from colonnade.errors import ReadError

HEADER = 512
LAST_SECTOR = 0xFFFF_FFFA
"""From here on numbers of sectors have another meaning, such as the end of a chain."""
ENTRY = 128
STREAM, ROOT = 2, 5


class _BrokenError(Exception):
    """A chain of sectors leaves the file, comes back to itself or is too short."""


def check(path: Path) -> None:
    """
    Refuse an old Office document that is cut off or damaged, as its readers do not come to an end with it.

    Raises
    ------
    ReadError
        With what is wrong.
    """
    content = path.read_bytes()
    try:
        _check(content)
    except (_BrokenError, struct.error) as error:
        raise ReadError(
            f"{path.name}: it is not whole ({error}; {len(content)} bytes): a copy was interrupted, or the file is "
            "damaged. Copy it again, or save it as .xlsx."
        ) from error


def _check(content: bytes) -> None:
    shift, small_shift = struct.unpack_from("<HH", content, 30)
    directory, _, cutoff, small_table, _, further = struct.unpack_from("<6I", content, 48)
    if shift not in (9, 12) or small_shift != 6:
        raise _BrokenError(f"its sectors have 2^{shift} bytes")
    size = 1 << shift
    sectors = max((len(content) - 1) // size, 0)
    table = _table(content, size, sectors, further)
    if len(table) < sectors:
        table += [LAST_SECTOR] * (sectors - len(table))
    small = [
        number
        for sector in _chain(table, small_table, sectors)
        for number in struct.unpack_from(f"<{size // 4}I", _sector(content, sector, size))
    ]
    entries = b"".join(_sector(content, sector, size) for sector in _chain(table, directory, sectors))
    for start in range(0, len(entries), ENTRY):
        kind = entries[start + 66]
        first, length = struct.unpack_from("<II", entries, start + 116)
        if kind == ROOT or (kind == STREAM and length >= cutoff):
            held = sum(1 for _ in _chain(table, first, sectors)) * size
        elif kind == STREAM:
            held = sum(1 for _ in _chain(small, first, len(small))) << small_shift
        else:
            continue
        if held < length:
            raise _BrokenError(f"a part of {length} bytes has {held}")


def _table(content: bytes, size: int, sectors: int, further: int) -> list[int]:
    """Which sector follows upon each."""
    places = list(struct.unpack_from("<109I", content, 76))
    for _ in range(sectors):
        if further >= LAST_SECTOR:
            break
        numbers = struct.unpack_from(f"<{size // 4}I", _sector(content, further, size))
        places += numbers[:-1]
        further = numbers[-1]
    followers: list[int] = []
    for place in places:
        if place < LAST_SECTOR:
            followers += struct.unpack_from(f"<{size // 4}I", _sector(content, place, size))
        if len(followers) > 2 * sectors + size:
            raise _BrokenError("its table of sectors is larger than the file")
    return followers


def _sector(content: bytes, number: int, size: int) -> bytes:
    start = (number + 1) * size
    if start + size > len(content):
        raise _BrokenError(f"its tables reach to byte {start + size}")
    return content[start : start + size]


def _chain(table: list[int], first: int, most: int) -> Iterator[int]:
    """Follow a chain of sectors."""
    number = first
    for _ in range(most + 1):
        if number >= LAST_SECTOR:
            return
        if number >= len(table):
            raise _BrokenError(f"a chain leads to sector {number} of {len(table)}")
        yield number
        number = table[number]
    raise _BrokenError("a chain of sectors comes back to itself")
