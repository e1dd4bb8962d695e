"""Workbooks (.xlsx, .xls, .ods): one sheet's rows of numbers, with the rows of names and units above them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from datetime import date, datetime, time, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import Field, TypeAdapter

from colonnade.errors import ReadError, nearest
from colonnade.readers.bounded.process import run_bounded
from colonnade.readers.files import in_one_line
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import OLE, ZIP, Head, from_head
from colonnade.readers.recording import Recording
from colonnade.readers.text.delimited import read_text
from colonnade.readers.text.delimited_header import DelimitedOptions, TableOptions
from colonnade.readers.text.encoding import Encoding, Text

if TYPE_CHECKING:
    from python_calamine import CalamineSheet

NUMBER_AS_TEXT = re.compile(r"\s*[+-]?\d+(?:[.,]\d*)?(?:[eE][+-]?\d+)?\s*")
"""A cell of text that is a number, with a decimal point or comma."""


class ExcelOptions(TableOptions):
    """What can be said about a workbook; all of it is found if it is not given."""

    sheet: str | int | None = Field(
        default=None,
        description="Name of the sheet, or its number from 1; by default the one with most rows of numbers.",
    )


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is a workbook, by its first bytes and what its archive holds."""
    import zipfile

    first = head.content
    if first.startswith(OLE):
        return Recognition(True, "starts as a workbook of Excel 97 to 2003, or another old Office document")
    if not first.startswith(ZIP):
        return Recognition(False, "it does not start as a workbook of Excel or OpenDocument")
    try:
        with zipfile.ZipFile(head.path) as archive:
            names = set(archive.namelist())
    except (zipfile.BadZipFile, ValueError, NotImplementedError) as error:
        is_workbook = b"xl/" in first or b"spreadsheet" in first or b"[Content_Types].xml" in first
        return Recognition(is_workbook, f"it starts as a zip archive, as workbooks do, but is incomplete ({error})")
    if "xl/workbook.xml" in names:
        return Recognition(True, "an archive with xl/workbook.xml, as Excel writes it")
    if b"application/vnd.oasis.opendocument.spreadsheet" in first:
        return Recognition(True, "an archive marked as an OpenDocument spreadsheet")
    if "xl/workbook.bin" in names:
        return Recognition(False, "it is a workbook in Excel's binary form (.xlsb): save it as .xlsx")
    return Recognition(False, "it is a zip archive without a workbook in it")


def read(path: Path, options: ExcelOptions) -> Recording:
    """
    Read a sheet of a workbook, as the text that its rows would be.

    Raises
    ------
    ReadError
        If it is none, is damaged, holds no rows of numbers, or lacks what the options name.
    """
    recognise.expected(path)
    rows, note = _sheet(path, options.sheet)
    text = Text(path, Encoding("utf-8", ""), "".join(f"{line}\n" for line in _lines(rows)))
    given = options.model_dump(exclude={"sheet"}, exclude_unset=True)
    recording = read_text(text, DelimitedOptions(delimiter="\t", decimal=".", **given))
    return replace(
        recording,
        format="excel",
        notes=(note, *map(_of_rows, recording.notes)),
        warnings=tuple(map(_of_rows, recording.warnings)),
    )


def cells_of_first_sheet(path: Path) -> list[list[str]]:
    """
    Read all cells of a workbook's first sheet as text, as for a table that people wrote; dates as ISO 8601.

    Raises
    ------
    ReadError
        If it is not a workbook, or is damaged.
    """
    function, within = "colonnade.readers.binary.excel:cells_here", path.absolute().parent
    return run_bounded(function, path, {}, _cells, kind="excel", within=within, modules=FORMAT.modules)


def cells_here(path: Path) -> tuple[list[list[str]], list[Any]]:
    """Read the cells of a workbook's first sheet in this process, for another one."""
    recognise.expected(path)
    return [[_typed(cell) for cell in row] for row in _sheet(path, 1)[0]], []


def _cells(header: Any, arrays: list[Any]) -> list[list[str]]:
    return TypeAdapter(list[list[str]]).validate_python(header)


def _lines(rows: list[list[Any]]) -> Iterator[str]:
    """Rows as lines of cells between tabs; a cell that is farther right than those of all other rows adds no column."""
    lengths = Counter(map(len, rows))
    width = max((length for length, count in lengths.items() if count > 1), default=max(lengths))
    for row in rows:
        yield "\t".join(map(_plain, row)) + "\t" * (width - len(row) if row else 0)


def _typed(cell: object) -> str:
    """Text of a cell as it was typed."""
    if isinstance(cell, (date, time)):
        return cell.isoformat()
    return cell if isinstance(cell, str) else _plain(cell)


def _of_rows(text: str) -> str:
    """Speak of rows where those of a text file are its lines."""
    return re.sub(r"\bline(s?) (?=\d)", r"row\1 ", re.sub(r"\bon (?=line \d)", "in ", text))


def _plain(cell: object) -> str:
    """Text of a cell on one line, as a text file would have it."""
    if isinstance(cell, (int, float)):  # True and False, too, are numbers
        return repr(+cell) if cell % 1 or abs(cell) >= 1e15 else str(int(cell))
    if isinstance(cell, timedelta):
        minutes, seconds = divmod(cell.total_seconds(), 60)
        return f"{minutes // 60:02.0f}:{minutes % 60:02.0f}:{seconds:09.6f}"
    if isinstance(cell, date) and not isinstance(cell, datetime):
        return f"{cell.isoformat()}T00:00:00"
    if isinstance(cell, (datetime, time)):
        return cell.isoformat()
    text = " ".join(str(cell).split())
    return text.replace(",", ".") if NUMBER_AS_TEXT.fullmatch(text) else text


def _sheet(path: Path, wanted: str | int | None) -> tuple[list[list[Any]], str]:
    """Give a sheet's rows, and a note on which it is."""
    import python_calamine

    try:
        book = python_calamine.CalamineWorkbook.from_path(str(path))
        names = list(book.sheet_names)
        sheets = {name: _rows(book.get_sheet_by_name(name)) for name in _chosen(path, names, wanted)}
    except (OSError, ReadError):
        raise
    except BaseException as error:  # a panic within calamine is not an Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit, MemoryError)):
            raise
        raise ReadError(
            f"{path.name}: it cannot be opened as a workbook ({in_one_line(error)}): it is damaged, was cut off, is "
            "protected by a password, or is another kind of document. Copy it again, or save it again as .xlsx or CSV."
        ) from None
    samples = {name: sum(any(map(_is_number, row)) for row in rows) for name, rows in sheets.items()}
    name = max(samples, key=lambda name: samples[name], default="")
    if wanted is not None:
        return sheets[name], f'sheet "{name}"'
    if not samples.get(name):
        listed = ", ".join(f'"{name}"' for name in names)
        raise ReadError(f"{path.name}: no sheet holds rows of numbers ({listed or 'it has no sheet'}).")
    others = ", ".join(f'"{other}"' for other in names if other != name)
    why = f", the one with most rows of numbers; not read: {others}" if others else ""
    return sheets[name], f'sheet "{name}"{why}'


def _rows(sheet: CalamineSheet) -> list[list[Any]]:
    """All rows of a sheet, each up to its last cell that is filled."""
    rows = sheet.to_python(skip_empty_area=False)
    return [row[: next((end for end in range(len(row), 0, -1) if row[end - 1] != ""), 0)] for row in rows]


def _is_number(cell: object) -> bool:
    return isinstance(cell, (int, float)) or (isinstance(cell, str) and NUMBER_AS_TEXT.fullmatch(cell) is not None)


def _chosen(path: Path, names: list[str], wanted: str | int | None) -> list[str]:
    if wanted is None:
        return names
    if isinstance(wanted, int):
        if not 1 <= wanted <= len(names):
            raise ReadError(f"{path.name}: sheet {wanted} is missing; it has sheets 1 to {len(names)}.")
        return [names[wanted - 1]]
    if wanted not in names:
        raise ReadError(f'{path.name}: sheet "{wanted}" is missing.{nearest(wanted, names)}')
    return [wanted]


FORMAT = Format(
    name="excel",
    summary="Workbooks of Excel (.xlsx, .xls) and OpenDocument (.ods): one sheet, values as last calculated.",
    suffixes=(".xlsx", ".xlsm", ".xls", ".ods"),
    options=ExcelOptions,
    recognise=recognise,
    read=read,
    modules=("python_calamine", "pandas"),
)
