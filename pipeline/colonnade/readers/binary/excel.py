"""Workbooks (.xlsx, .xls, .ods): one sheet's rows as the lines of a text, which the text reader reads."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from datetime import date, datetime, time, timedelta
from pathlib import Path
from typing import Any

from pydantic import Field, TypeAdapter

from colonnade.errors import ReadError, nearest
from colonnade.readers.bounded.process import run_bounded
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import OLE, ZIP, Head, from_head
from colonnade.readers.recording import Recording
from colonnade.readers.text.delimited import DelimitedOptions, TableOptions, read_text
from colonnade.readers.text.encoding import Text

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
    """Say whether a file is a workbook, by its first bytes and the names of the first parts of its archive."""
    first = head.content
    if first.startswith(OLE):
        return Recognition(True, "starts as a workbook of Excel 97 to 2003, or another old Office document")
    if not first.startswith(ZIP):
        return Recognition(False, "it does not start as a workbook of Excel or OpenDocument")
    if b"xl/" in first or b"opendocument.spreadsheet" in first:
        return Recognition(True, "an archive with parts of a workbook, as Excel or OpenDocument write it")
    return Recognition(False, "it is a zip archive without a workbook in it")


def read(path: Path, options: ExcelOptions) -> Recording:
    """Read a sheet of a workbook, as the text that its rows would be."""
    recognise.expected(path)
    rows, note = _sheet(path, options.sheet)
    text = Text(path, "utf-8", "".join(f"{line}\n" for line in _lines(rows)))
    given = options.model_dump(exclude={"sheet"}, exclude_unset=True)
    recording = read_text(text, DelimitedOptions(delimiter="\t", decimal=".", **given))
    notes, warnings = (tuple(map(_of_rows, said)) for said in (recording.notes, recording.warnings))
    return replace(recording, format="excel", notes=(note, *notes), warnings=warnings)


def cells_of_first_sheet(path: Path) -> list[list[str]]:
    """
    Read all cells of a workbook's first sheet as text, as for a table that people wrote; dates as ISO 8601.

    Raises
    ------
    ReadError
        If it is not a workbook, or is damaged.
    """
    function, within = "colonnade.readers.binary.excel:cells_here", path.absolute().parent
    take = TypeAdapter(list[list[str]]).validate_python
    return run_bounded(
        function, path, {}, lambda header, _: take(header), kind="excel", within=within, modules=FORMAT.modules
    )


def cells_here(path: Path) -> tuple[list[list[str]], list[Any]]:
    """Read the cells of a workbook's first sheet in this process, for another one."""
    recognise.expected(path)
    return [[_typed(cell) for cell in row] for row in _sheet(path, 1)[0]], []


def _sheet(path: Path, wanted: str | int | None) -> tuple[list[list[Any]], str]:
    """Give a sheet's rows, each up to its last cell that is filled, and a note on which it is."""
    import python_calamine

    book = python_calamine.CalamineWorkbook.from_path(str(path))
    names = list(book.sheet_names)
    numbered: dict[str | int, str] = {**dict(enumerate(names, 1)), **{name: name for name in names}}
    if wanted is not None and wanted not in numbered:
        raise ReadError(f'{path.name}: sheet "{wanted}" is missing.{nearest(str(wanted), names)}')
    sheets = {}
    for name in names if wanted is None else [numbered[wanted]]:
        rows = book.get_sheet_by_name(name).to_python(skip_empty_area=False)
        sheets[name] = [row[: max((end for end, cell in enumerate(row, 1) if cell != ""), default=0)] for row in rows]
    samples = {name: sum(any(map(_is_number, row)) for row in rows) for name, rows in sheets.items()}
    best = max(samples, key=lambda name: samples[name], default="")
    if wanted is None and not samples.get(best):
        listed = ", ".join(f'"{name}"' for name in names)
        raise ReadError(f"{path.name}: no sheet holds rows of numbers ({listed or 'it has no sheet'}).")
    why = ", the one with most rows of numbers; `sheet` names another" if len(sheets) > 1 else ""
    return sheets[best], f'sheet "{best}"{why}'


def _is_number(cell: object) -> bool:
    return isinstance(cell, (int, float)) or (isinstance(cell, str) and NUMBER_AS_TEXT.fullmatch(cell) is not None)


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


def _plain(cell: object) -> str:
    """Text of a cell on one line, as a text file would have it."""
    if isinstance(cell, (int, float)):  # True and False, too, are numbers
        return repr(+cell) if cell % 1 or abs(cell) >= 1e15 else str(int(cell))
    if isinstance(cell, timedelta):
        minutes, seconds = divmod(cell.total_seconds(), 60)
        return f"{minutes // 60:02.0f}:{minutes % 60:02.0f}:{seconds:09.6f}"
    if isinstance(cell, (date, time)):
        is_day = isinstance(cell, date) and not isinstance(cell, datetime)
        return f"{cell.isoformat()}T00:00:00" if is_day else cell.isoformat()
    text = " ".join(str(cell).split())
    return text.replace(",", ".") if NUMBER_AS_TEXT.fullmatch(text) else text


def _of_rows(text: str) -> str:
    """Speak of rows where those of a text file are its lines."""
    return re.sub(r"\bline(s?) (?=\d)", r"row\1 ", re.sub(r"\bon (?=line \d)", "in ", text))


FORMAT = Format(
    name="excel",
    summary="Workbooks of Excel (.xlsx, .xls) and OpenDocument (.ods): one sheet, values as last calculated.",
    suffixes=(".xlsx", ".xlsm", ".xls", ".ods"),
    options=ExcelOptions,
    recognise=recognise,
    read=read,
    modules=("python_calamine", "pandas"),
)
