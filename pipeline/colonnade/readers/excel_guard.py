"""Is a workbook whole, and of a size that its samples explain? Looked at before any of it is unpacked to memory."""

from __future__ import annotations

import re
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO
from xml.etree import ElementTree

from colonnade.errors import ReadError
from colonnade.readers.unpacking import swollen

SHEET = re.compile(r"xl/worksheets/[^/]+\.xml")
HIGH_ROW = re.compile(rb'"[A-Z]{1,3}([0-9]{5,7})"')
FAR_COLUMN = re.compile(rb'"([A-Z]{2,3})[0-9]{1,7}"')
PIECE = 1 << 20
ROOMY = 20_000_000
"""Cells between the first and the last one of a sheet that are fine, however few of them are filled."""
FILLED = 0.02
"""Share of them that has to be filled beyond that."""
TABLE_NAMES = "{urn:oasis:names:tc:opendocument:xmlns:table:1.0}"
OFFICE_NAMES = "{urn:oasis:names:tc:opendocument:xmlns:office:1.0}"


def check(path: Path) -> None:
    """
    Refuse a zipped workbook (.xlsx, .ods) that is cut off, damaged, or made to exhaust the memory.

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
                with archive.open(member) as stream:
                    filled, room = _extent(member.filename, stream)
                if room > ROOMY and filled < FILLED * room:
                    raise ReadError(
                        f"{path.name}: {member.filename} has {filled} filled cells within {room}: that is no table of "
                        "samples. Delete the stray cells far outside it, and save it again."
                    )
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        NotImplementedError,
        ElementTree.ParseError,
        RuntimeError,
    ) as error:
        raise ReadError(
            f"{path.name}: it is not whole ({error}; {size} bytes): a copy was interrupted, or the file is damaged or "
            "protected by a password. Copy or save it again."
        ) from error


def _extent(name: str, stream: IO[bytes]) -> tuple[int, int]:
    """Filled cells of a member of the archive, and cells in the rectangle around them; it is read to its check sum."""
    if SHEET.fullmatch(name):
        return _extent_xlsx(stream)
    if name == "content.xml":
        return _extent_ods(stream)
    for _ in _pieces(stream):
        pass
    return 0, 0


def _pieces(stream: IO[bytes]) -> Iterator[bytes]:
    """Go through a stream, each piece beginning with the end of the one before."""
    before = b""
    while piece := stream.read(PIECE):
        yield before + piece
        before = piece[-32:]


def _extent_xlsx(stream: IO[bytes]) -> tuple[int, int]:
    filled, last_row = 0, 10_000
    columns = {b"Z"}
    for piece in _pieces(stream):
        filled += piece.count(b"<c ")
        last_row = max(last_row, max(map(int, HIGH_ROW.findall(piece)), default=0))
        columns.update(FAR_COLUMN.findall(piece))
    return filled, last_row * max(map(_column_number, columns))


def _column_number(letters: bytes) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + letter - 64
    return number


def _extent_ods(stream: IO[bytes]) -> tuple[int, int]:
    filled, widest, row, last_row, width, in_row = 0, 0, 0, 0, 0, 0
    for event, element in ElementTree.iterparse(stream, events=("start", "end")):
        if event == "start" and element.tag == f"{TABLE_NAMES}table":
            row = 0
        elif event == "end" and element.tag == f"{TABLE_NAMES}table-cell":
            repeated = int(element.get(f"{TABLE_NAMES}number-columns-repeated", "1"))
            width += repeated
            if element.get(f"{OFFICE_NAMES}value-type"):
                in_row += repeated
                widest = max(widest, width)
            element.clear()
        elif event == "end" and element.tag == f"{TABLE_NAMES}table-row":
            repeated = int(element.get(f"{TABLE_NAMES}number-rows-repeated", "1"))
            row += repeated
            if in_row:
                filled, last_row = filled + in_row, max(last_row, row)
                if repeated * in_row > ROOMY:
                    return 0, repeated * in_row
            width = in_row = 0
            element.clear()
    return filled, widest * last_row
