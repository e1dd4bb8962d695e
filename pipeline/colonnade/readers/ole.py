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
WORKBOOKS = ("Workbook\0", "Book\0")
DIMENSIONS, PROTECTED = 0x200, 0x2F
EXTENTS = {10: "<4H2x", 14: "<2I2H2x"}
"""Form of a sheet's dimensions by the length of their record: first row, row behind the last one, columns likewise."""
CELLS = frozenset((0x06, 0xBD, 0xBE, 0xD6, 0xFD, 0x201, 0x203, 0x204, 0x205, 0x27E))
"""Records that begin with their row and column."""
SHEET, ROW_OF_NUMBERS = 0x809, 0xBD
MOST_ROWS, MOST_COLUMNS = 1 << 16, 1 << 8
ROOMY, FILLED = 2_000_000, 0.02
"""Cells between the first and the last one of a sheet that are fine, and which share has to be filled beyond that."""


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
        for workbook in _workbooks(content):
            _check_extent(workbook)
    except (_BrokenError, struct.error) as error:
        raise ReadError(
            f"{path.name}: it is not whole ({error}; {len(content)} bytes): a copy was interrupted, or the file is "
            "damaged. Copy it again, or save it as .xlsx."
        ) from error


def _check_extent(workbook: bytes) -> None:
    """Go through a workbook's records: cells far outside the others make its readers ask for endless memory."""
    sheets = [[0, 0, 0]]
    for kind, record in _records(workbook):
        if kind == PROTECTED:
            return
        if kind == SHEET:
            sheets.append([0, 0, 0])
            continue
        if kind == DIMENSIONS and len(record) in EXTENTS:
            _, rows, _, columns = struct.unpack(EXTENTS[len(record)], record)
        elif kind in CELLS and len(record) >= 4:
            rows, columns = (number + 1 for number in struct.unpack_from("<HH", record))
            filled, height, width = sheets[-1]
            filled += max(len(record) // 6 - 1, 0) if kind == ROW_OF_NUMBERS else 1
            sheets[-1] = [filled, max(height, rows), max(width, columns)]
        else:
            continue
        if rows > MOST_ROWS or columns > MOST_COLUMNS:
            raise _BrokenError(f"a sheet has cells up to row {rows} and column {columns}")
    for filled, height, width in sheets:
        if height * width > ROOMY and filled < FILLED * height * width:
            raise _BrokenError(f"a sheet has {filled} filled cells within {height * width}")


def _records(workbook: bytes) -> Iterator[tuple[int, bytes]]:
    place = 0
    while place + 4 <= len(workbook):
        kind, length = struct.unpack_from("<HH", workbook, place)
        yield kind, workbook[place + 4 : place + 4 + length]
        place += 4 + length


def _workbooks(content: bytes) -> Iterator[bytes]:
    """Follow every chain of sectors to its end; give the content of those that are a workbook."""
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
    pieces = b""
    for start in range(0, len(entries), ENTRY):
        kind = entries[start + 66]
        first, length = struct.unpack_from("<II", entries, start + 116)
        if kind not in (STREAM, ROOT):
            continue
        is_small = kind == STREAM and length < cutoff
        chain = list(_chain(small, first, len(small)) if is_small else _chain(table, first, sectors))
        held = len(chain) << (small_shift if is_small else shift)
        if held < length:
            raise _BrokenError(f"a part of {length} bytes has {held}")
        if kind == ROOT:
            pieces = b"".join(_sector(content, number, size) for number in chain)
        elif entries[start : start + 64].decode("utf-16-le", "replace").startswith(WORKBOOKS):
            parts = (
                pieces[number << small_shift : (number + 1) << small_shift]
                if is_small
                else _sector(content, number, size)
                for number in chain
            )
            yield b"".join(parts)[:length]


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
