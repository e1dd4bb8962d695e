"""Whether a zipped workbook is whole and of a plausible size, checked before it is unpacked."""

from __future__ import annotations

import re
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from colonnade.errors import ReadError
from colonnade.readers.binary.unpacking import swollen

SHEET = re.compile(r"xl/worksheets/[^/]+\.xml")
HIGH_ROW = re.compile(rb'"[A-Z]{1,3}([0-9]{5,7})"')
FAR_COLUMN = re.compile(rb'"([A-Z]{2,3})[0-9]{1,7}"')
PIECE = 1 << 20
ROOMY = 20_000_000
"""Cells between the first and the last one of a sheet that are fine, however few of them are filled."""
FILLED = 0.02
"""Share of them that has to be filled beyond that."""


def check(path: Path) -> None:
    """
    Refuse a zipped workbook (.xlsx, .ods) that is cut off, damaged, or far larger than its samples.

    What reads workbooks checks no sums, and makes room for all cells up to the last one. Such a reading would be
    stopped; here it is said what to do.

    Raises
    ------
    ReadError
        With the figures.
    """
    size = path.stat().st_size
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
            if reason := swollen(sum(member.file_size for member in members), size):
                raise ReadError(f"{path.name}: {reason}.")
            for member in members:
                with archive.open(member) as stream:  # read to its end, where its check sum is compared
                    filled, room = _extent(stream, is_sheet=SHEET.fullmatch(member.filename) is not None)
                if room > ROOMY and filled < FILLED * room:
                    raise mostly_empty(path, member.filename, filled, room)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as error:
        raise ReadError(
            f"{path.name}: it is incomplete ({error}; {size} bytes): a copy was interrupted, or the file is damaged or "
            "protected by a password. Copy or save it again."
        ) from error


def mostly_empty(path: Path, name: str, filled: int, room: int) -> ReadError:
    """Say that a sheet holds hardly anything between its first and its last cell."""
    return ReadError(
        f"{path.name}: {name} has {filled} filled cells within {room}: that is not a table of samples. Delete the "
        "stray cells far outside it, and save it again."
    )


def _extent(stream: IO[bytes], *, is_sheet: bool) -> tuple[int, int]:
    """Filled cells of a sheet, and cells in the rectangle around them."""
    filled, last_row, columns = 0, 10_000, {b"Z"}
    for piece in _pieces(stream):
        if is_sheet:
            filled += piece.count(b"<c ")
            last_row = max(last_row, max(map(int, HIGH_ROW.findall(piece)), default=0))
            columns.update(FAR_COLUMN.findall(piece))
    return filled, last_row * max(map(_column_number, columns)) if is_sheet else 0


def _pieces(stream: IO[bytes]) -> Iterator[bytes]:
    """Go through a stream, each piece beginning with the end of the one before."""
    before = b""
    while piece := stream.read(PIECE):
        yield before + piece
        before = piece[-32:]


def _column_number(letters: bytes) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + letter - 64
    return number
