"""Workbooks (.xlsx, .xls, .ods): one sheet's rows of numbers, with the rows of names and units above them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from colonnade.errors import ReadError, nearest
from colonnade.readers import excel_guard, ole
from colonnade.readers.announced import Announced, announced
from colonnade.readers.cells import Dialect
from colonnade.readers.clock import Clocks, find_clocks, in_seconds
from colonnade.readers.excel_cells import Block, column_kinds, find_block, take_column
from colonnade.readers.heading import Heading, HeadingLines, describe_columns, find_heading
from colonnade.readers.magic import OLE, head, look
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.row_layout import Named, Verdict, judge
from colonnade.readers.running_block import series_of, undecided
from colonnade.readers.values import TimeUnit

ZIP = b"PK\x03\x04"
LINES = Dialect("utf-8", delimiter="\t", decimal=".")
"""As what the rows above the samples are looked at."""


class ExcelOptions(BaseModel):
    """What can be said about a workbook; all of it is found where it is not said."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    sheet: str | int | None = Field(
        default=None, description="Name of the sheet, or its number from 1; else the one with most rows of numbers."
    )
    names_row: int | None = Field(
        default=None, ge=0, description="Row of the sheet with the columns' names, from 1; 0 where there is none."
    )
    units_row: int | None = Field(
        default=None, ge=0, description="Row with the columns' units, from 1; 0 where there is none."
    )
    time: str | int | None = Field(default=None, description="Name or number, from 1, of the column that is the clock.")
    time_unit: TimeUnit | None = Field(default=None, description="Unit of that column.")
    layout: Literal["columns", "running"] | None = Field(
        default=None,
        description='"columns" where each column is a channel, "running" where numbers run on from row to row.',
    )

    @model_validator(mode="after")
    def _unit_has_column(self) -> ExcelOptions:
        if self.time_unit is not None and self.time is None:
            raise ValueError("time_unit needs `time`: the column it belongs to")
        return self


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
        return Recognition(is_workbook, f"it starts as a zip archive, as workbooks do, but is not whole ({error})")
    if "xl/workbook.xml" in names:
        return Recognition(True, "an archive with xl/workbook.xml, as Excel writes it")
    if b"application/vnd.oasis.opendocument.spreadsheet" in first:
        return Recognition(True, "an archive of the kind OpenDocument spreadsheet")
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
    lines = ["\t".join(_plain(cell) for cell in row[: len(kinds)]) for row in rows[: block.first]]
    where = _heading_lines(lines, block, kinds, options)
    heading = describe_columns(lines, where, block.first, LINES, len(kinds))
    recording, warnings = _recorded(path, block, kinds, heading)
    told = announced("\n".join(lines))
    verdict = _layout(recording, kinds, told, heading, options)
    if verdict.layout != "columns":
        numbers = np.column_stack([channel.values for channel in recording.channels]).ravel()
        numbers = numbers[: numbers.size - int(np.argmax(np.isfinite(numbers[::-1])))]
        return series_of(replace(recording, notes=tuple(notes)), numbers, len(kinds), told, verdict)
    clocks = _clocks(recording, kinds, options)
    return replace(
        recording,
        channels=tuple(
            replace(channel, time=time, is_clock=number in clocks.columns)
            for number, (channel, time) in enumerate(zip(recording.channels, clocks.times, strict=True))
        ),
        notes=(*notes, *(_of_rows(note) for note in heading.notes), *clocks.notes),
        warnings=(*block.warnings, *(_of_rows(warning) for warning in heading.warnings), *warnings, *clocks.warnings),
    )


def rows_of_first_sheet(path: Path) -> list[list[Any]]:
    """
    Read all cells of a workbook's first sheet, as of a table that people wrote.

    Raises
    ------
    ReadError
        If it is no workbook, is damaged, or would exhaust the memory.
    """
    _expect_sound(path)
    return _sheet(path, 1)[1]


def _expect_sound(path: Path) -> None:
    recognition = recognise(path)
    if not recognition.yes:
        raise ReadError(f"{path.name}: {recognition.reason}.")
    (excel_guard if head(path).startswith(ZIP) else ole).check(path)


def _layout(
    recording: Recording, kinds: Sequence[str], told: Announced, heading: Heading, options: ExcelOptions
) -> Verdict:
    """Decide whether columns are channels: as given, by what they hold, else by the evidence."""
    if options.layout is not None:
        return Verdict(options.layout, ("as given",))
    if options.time is not None or any(kind != "number" for kind in kinds):
        return Verdict("columns")
    named: Named = "names" if heading.names_most else ""
    values = [channel.values for channel in recording.channels]
    verdict = judge(values, told, named=named, is_free=False, is_whole=True)
    if verdict.layout is None:
        raise ReadError(undecided(recording.path, len(values), verdict))
    return verdict


def _of_rows(text: str) -> str:
    """Speak of rows where the heading of a text file would speak of lines."""
    return text.replace("on line ", "in row ").replace("line ", "row ")


def _plain(cell: object) -> str:
    """Text of a cell on one line; a number as Excel shows it."""
    text = f"{cell:g}" if isinstance(cell, float) else str(cell)
    return " ".join(text.split())


def _sheet(path: Path, wanted: str | int | None) -> tuple[str, list[list[Any]], list[str]]:
    """Give a sheet's name, its rows and a note on which it is."""
    import python_calamine

    try:
        book = python_calamine.CalamineWorkbook.from_path(str(path))
        names = list(book.sheet_names)
        chosen = _chosen(path, names, wanted)
        sheets = [(name, book.get_sheet_by_name(name).to_python(skip_empty_area=False)) for name in chosen]
    except (OSError, ReadError):
        raise
    except BaseException as error:  # a panic within calamine is no Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit, MemoryError)):
            raise
        raise ReadError(
            f"{path.name}: it cannot be opened as a workbook ({' '.join(str(error).split())[:150]}): it is damaged, "
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


def _samples(rows: list[list[Any]]) -> int:
    """Count the rows of numbers of a sheet."""
    block = find_block(rows)
    return 0 if block is None else len(block.rows)


def _chosen(path: Path, names: list[str], wanted: str | int | None) -> list[str]:
    if wanted is None:
        return names
    if isinstance(wanted, int):
        if not 1 <= wanted <= len(names):
            raise ReadError(f"{path.name}: there is no sheet {wanted}; it has sheets 1 to {len(names)}.")
        return [names[wanted - 1]]
    if wanted not in names:
        raise ReadError(f'{path.name}: there is no sheet "{wanted}".{nearest(wanted, names)}')
    return [wanted]


def _heading_lines(lines: list[str], block: Block, kinds: Sequence[str], options: ExcelOptions) -> HeadingLines:
    """Rows of names and units: as given, else as found."""
    found = find_heading(lines, 0, block.first, LINES, list(kinds))
    names = found.names if options.names_row is None else options.names_row - 1
    units = found.units if options.units_row is None else options.units_row - 1
    if options.names_row is not None and options.units_row is None and units == names:
        units = None
    if options.units_row is not None and options.names_row is None and names == units:
        names = None
    return HeadingLines(
        names if names is not None and names >= 0 else None, units if units is not None and units >= 0 else None
    )


def _recorded(path: Path, block: Block, kinds: Sequence[str], heading: Heading) -> tuple[Recording, list[str]]:
    """Turn columns of cells into channels, with warnings of cells that hold no number."""
    channels, warnings = [], []
    start: datetime | None = None
    for number, kind in enumerate(kinds):
        head_text = heading.headings[number]
        column = take_column(block, number, kind)
        start = start or column.start
        if kind in ("number", "time"):
            warnings += [f'"{head_text}": {warning}' for warning in column.warnings]
        channels.append(RecordedChannel(heading.names[number], heading.units[number], column.values, heading=head_text))
    return Recording(path, "excel", tuple(channels), start), warnings


def _clocks(recording: Recording, kinds: tuple[str, ...], options: ExcelOptions) -> Clocks:
    """Times of the channels: by the column that was given, else by those found."""
    found = find_clocks(recording.channels, kinds)
    if options.time is None:
        return found
    clock = recording.channel(options.time)
    number = next(index for index, channel in enumerate(recording.channels) if channel is clock)
    if not np.isfinite(clock.values).any():
        raise ReadError(
            f'{recording.path.name}: column "{clock.heading}" holds no number, so it cannot be the clock. '
            "Name a column of times, or leave `time` out."
        )
    time, how = (
        (clock.values, "timestamps") if kinds[number] == "time" else in_seconds(clock, options.time_unit or clock.unit)
    )
    note = f'clock: "{clock.heading}", as given ({how})'
    return Clocks(frozenset((number,)), (time,) * len(recording.channels), (note,), ())


FORMAT = Format(
    name="excel",
    summary="Workbooks of Excel (.xlsx, .xls) and OpenDocument (.ods): one sheet, values as last calculated.",
    suffixes=(".xlsx", ".xlsm", ".xls", ".ods"),
    options=ExcelOptions,
    recognise=recognise,
    read=read,
    modules=("python_calamine",),
)
