"""Workbooks (.xlsx, .xls, .ods): one sheet's rows of numbers, with the rows of names and units above them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date, time
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError, nearest
from colonnade.readers.binary.magic import OLE, ZIP, head, look
from colonnade.readers.excel import guard
from colonnade.readers.excel.cells import CellColumn, column_kinds, find_block, take_column
from colonnade.readers.format import Format, Recognition
from colonnade.readers.recording import Recording
from colonnade.readers.refusal import in_one_line
from colonnade.readers.text.heading import describe_columns, find_heading
from colonnade.readers.text.layout import declared_layout, header_claims, series_of
from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.rows import filled_length
from colonnade.readers.text.table import Table, TableOptions

if TYPE_CHECKING:
    from python_calamine import CalamineSheet

LARGE, LOOKED_AT = 1_000_000, 1000
"""Cells of a sheet beyond which its first rows are looked at before the others, and how many rows these are."""
LINES = Dialect("utf-8", delimiter="\t", decimal=".")
"""As what the rows above the samples are looked at."""


class ExcelOptions(TableOptions):
    """What can be said about a workbook; all of it is found if it is not given."""

    sheet: str | int | None = Field(
        default=None,
        description="Name of the sheet, or its number from 1; by default the one with most rows of numbers.",
    )


def recognise(path: Path) -> Recognition:
    """Say whether a file is a workbook, by its first bytes and what its archive holds."""
    import zipfile

    first = head(path)
    if first.startswith(OLE):
        return Recognition(True, "starts as a workbook of Excel 97 to 2003, or another old Office document")
    if not first.startswith(ZIP):
        what = look(first)
        return Recognition(
            False, "it does not start as a workbook of Excel or OpenDocument" + (f"; {what}" if what else "")
        )
    try:
        with zipfile.ZipFile(path) as archive:
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
    Read a sheet of a workbook.

    Raises
    ------
    ReadError
        If it is none, is damaged, would exhaust the memory, holds no rows of numbers, or lacks what the options name.
    """
    _expect_sound(path)
    name, rows, notes = _sheet(path, options.sheet)
    block = find_block(rows, after=max(options.names_row or 0, options.units_row or 0))
    if block is None:
        raise ReadError(f'{path.name}: sheet "{name}" holds no rows of numbers below row {options.names_row or 0}.')
    kinds = column_kinds(block)
    lines = ["\t".join(map(_plain, row[: len(kinds)])) for row in rows[: block.first]]
    where = options.heading_lines(find_heading(lines, 0, block.first, LINES, list(kinds)))
    heading = describe_columns(lines, where, block.first, LINES, len(kinds))
    columns = [take_column(block, number, kind) for number, kind in enumerate(kinds)]
    values = [column.values for column in columns]
    claims = header_claims("\n".join(lines))

    def series() -> Array:
        numbers = np.column_stack(values).ravel()
        return numbers[: filled_length(numbers)]

    layout = options.given_layout(kinds) or declared_layout(
        path, values, claims, series, is_named=heading.names_most, is_free=False
    )
    if layout.kind != "columns":
        recording = Recording(path, "excel", (), notes=tuple(notes))
        return series_of(recording, series(), len(kinds), claims, layout)
    start = next((column.start for column in columns if column.start), None)
    recording = Table(path, "excel", heading, kinds, values, start).recording(options, claims)
    return replace(
        recording,
        notes=(*notes, *map(_of_rows, heading.notes), *recording.notes),
        warnings=(
            *block.warnings,
            *map(_of_rows, heading.warnings),
            *_unread(heading.headings, columns),
            *recording.warnings,
        ),
    )


def _unread(headings: Sequence[str], columns: Sequence[CellColumn]) -> list[str]:
    return [
        f'"{heading}": {warning}'
        for heading, column in zip(headings, columns, strict=True)
        for warning in column.warnings
    ]


def rows_of_first_sheet(path: Path) -> list[list[str]]:
    """
    Read all cells of a workbook's first sheet as text, as for a table that people wrote; dates as ISO 8601.

    Raises
    ------
    ReadError
        If it is not a workbook, is damaged, or would exhaust the memory.
    """
    _expect_sound(path)
    return [[_typed(cell) for cell in row] for row in _sheet(path, 1)[1]]


def _typed(cell: object) -> str:
    """Text of a cell; Excel keeps every number as a float: 1.0 was typed as 1."""
    if isinstance(cell, float) and cell.is_integer() and abs(cell) < 1e15:
        return str(int(cell))
    return cell.isoformat() if isinstance(cell, (date, time)) else str(cell)


def _expect_sound(path: Path) -> None:
    recognition = recognise(path)
    if not recognition.yes:
        raise ReadError(f"{path.name}: {recognition.reason}.")
    if head(path).startswith(ZIP):
        guard.check(path)


def _of_rows(text: str) -> str:
    """Speak of rows where the heading of a text file would speak of lines."""
    return text.replace("on line ", "in row ").replace("line ", "row ")


def _plain(cell: object) -> str:
    """Text of a cell on one line; a number with the digits that Excel keeps."""
    text = f"{cell:.15g}" if isinstance(cell, float) else str(cell)
    return " ".join(text.split())


def _sheet(path: Path, wanted: str | int | None) -> tuple[str, list[list[Any]], list[str]]:
    """Give a sheet's name, its rows and a note on which it is."""
    import python_calamine

    try:
        book = python_calamine.CalamineWorkbook.from_path(str(path))
        names = list(book.sheet_names)
        chosen = _chosen(path, names, wanted)
        sheets = [(name, _rows(path, book.get_sheet_by_name(name))) for name in chosen]
    except (OSError, ReadError):
        raise
    except BaseException as error:  # a panic within calamine is not an Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit, MemoryError)):
            raise
        raise ReadError(
            f"{path.name}: it cannot be opened as a workbook ({in_one_line(error)}): it is damaged, "
            "protected by a password, or another kind of document. Save it again as .xlsx, or as CSV."
        ) from None
    name, rows = max(sheets, key=lambda sheet: _samples(sheet[1]), default=("", []))
    if wanted is None and not _samples(rows):
        listed = ", ".join(f'"{name}"' for name in names)
        raise ReadError(f"{path.name}: no sheet holds rows of numbers ({listed or 'it has no sheet'}).")
    others = [f'"{other}"' for other in names if other != name]
    why = (
        ""
        if wanted is not None or not others
        else f", the one with most rows of numbers; not read: {', '.join(others)}"
    )
    return name, rows, [f'sheet "{name}"{why}']


def _rows(path: Path, sheet: CalamineSheet) -> list[list[Any]]:
    """Give all cells of a sheet, unless most of them are empty because of a few far outside."""
    if sheet.total_height * sheet.total_width > LARGE:
        first = list(islice(sheet.iter_rows(), LOOKED_AT))
        filled, cells = sum(cell != "" for row in first for cell in row), sum(map(len, first))
        if filled < guard.FILLED * cells:
            raise guard.mostly_empty(path, f'sheet "{sheet.name}"', filled, cells)
    return sheet.to_python(skip_empty_area=False)


def _samples(rows: list[list[Any]]) -> int:
    """Count the rows of numbers of a sheet."""
    block = find_block(rows)
    return 0 if block is None else len(block.rows)


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
    modules=("python_calamine",),
)
