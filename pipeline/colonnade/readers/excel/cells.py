"""Cells of a sheet: its rows of numbers, and the values of a column."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta
from itertools import chain
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.text.lines.cells import MISSING
from colonnade.readers.text.lines.timestamps import past_midnight

MOMENTS = (datetime, date, time, timedelta)
FULL = 0.6
"""Share of the usual number of numbers that a row of samples has at least."""


@dataclass(frozen=True)
class Block:
    """
    Rows of numbers in a sheet.

    Attributes
    ----------
    first : int
        Index of the first of them, from 0.
    rows : list of list
        Their cells.
    numbers : list of int
        Their numbers in the sheet, from 1.
    warnings : tuple of str
        What is among them or below and is not a sample.
    """

    first: int
    rows: list[list[Any]]
    numbers: list[int]
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class CellColumn:
    """A column's values, when it starts where these are moments, and what is wrong in it."""

    values: Array
    start: datetime | None
    warnings: tuple[str, ...]


def find_block(rows: list[list[Any]], after: int = 0) -> Block | None:
    """
    Find the rows of numbers of a sheet, below the first `after` ones; None if there are none.

    A title or a list of settings above them has fewer numbers than the samples have.
    """
    found = ((index, sum(map(_is_number, row))) for index, row in enumerate(rows) if index >= after)
    counts = {index: count for index, count in found if count}
    usual = max(Counter(counts.values()).items(), key=lambda item: item[1], default=(0, 0))[0]
    first = next((index for index, count in counts.items() if count >= FULL * usual), None)
    if first is None:
        return None
    kept = [index for index in counts if index >= first]
    last = kept[-1]
    warnings = []
    if missing := sorted(set(range(first, last + 1)).difference(kept)):
        warnings.append(
            f"rows among the samples without any number, left out: {len(missing)}, the first is row {missing[0] + 1}"
        )
    if any(map(_is_filled, chain.from_iterable(rows[last + 1 :]))):
        warnings.append(f"text below the last sample in row {last + 1} is not read")
    return Block(first, [rows[index] for index in kept], [index + 1 for index in kept], tuple(warnings))


def column_kinds(block: Block) -> tuple[str, ...]:
    """
    Say what each column mostly holds: `number`, `time`, `text` or `empty`.

    Empty columns at the end are left out.
    """
    width = max(len(row) for row in block.rows)
    kinds = []
    for number in range(width):
        held = Counter(_kind(row[number]) for row in block.rows if number < len(row))
        del held["empty"]
        kinds.append(held.most_common(1)[0][0] if held else "empty")
    while kinds and kinds[-1] == "empty":
        kinds.pop()
    return tuple(kinds)


def take_column(block: Block, number: int, kind: str) -> CellColumn:
    """Give a column's values, NaN if a cell holds none; text that is a number is read as one, with a warning."""
    cells = [row[number] if number < len(row) else "" for row in block.rows]
    if kind == "time":
        return _moments(cells)
    values = np.full(len(cells), np.nan)
    as_text: list[int] = []
    unread: list[int] = []
    for index, cell in enumerate(cells):
        if isinstance(cell, (int, float)):
            values[index] = cell
        elif isinstance(cell, MOMENTS):
            unread.append(index)
        elif (parsed := _parsed(cell)) is not None:
            values[index] = parsed
            as_text.append(index)
        elif cell.strip() and (cell.strip().casefold() not in MISSING or cell.startswith("#")):
            unread.append(index)
    values[np.isinf(values)] = np.nan
    warnings = []
    if as_text:
        warnings.append(
            f"numbers that are written as text: {len(as_text)}, the first in row {block.numbers[as_text[0]]}"
        )
    if unread:
        text, row = str(cells[unread[0]])[:30], block.numbers[unread[0]]
        warnings.append(f'cells that hold no number: {len(unread)}, the first is "{text}" in row {row}')
    return CellColumn(values, None, tuple(warnings) if kind == "number" else ())


def _moments(cells: list[Any]) -> CellColumn:
    """Seconds since the first of dates with times, or of times of day."""
    dated = sum(isinstance(cell, (datetime, date)) for cell in cells) * 2 > sum(isinstance(c, MOMENTS) for c in cells)
    origin: datetime | None = None
    seconds = np.full(len(cells), np.nan)
    for index, cell in enumerate(cells):
        if dated and isinstance(cell, date):
            moment = cell if isinstance(cell, datetime) else datetime(cell.year, cell.month, cell.day)
            origin = origin or moment
            seconds[index] = (moment - origin).total_seconds()
        elif not dated and isinstance(cell, timedelta):
            seconds[index] = cell.total_seconds()
        elif not dated and isinstance(cell, time):
            seconds[index] = cell.hour * 3600 + cell.minute * 60 + cell.second + cell.microsecond / 1e6
    if not dated:
        seconds = past_midnight(seconds)
        known = np.isfinite(seconds)
        seconds = seconds - seconds[known][0] if known.any() else seconds
    return CellColumn(seconds, origin, ())


def _parsed(text: str) -> float | None:
    """Number in a text, with a decimal point or comma; None if it is not one."""
    bare = text.strip()
    if bare.count(",") == 1 and "." not in bare:
        bare = bare.replace(",", ".")
    if not bare.replace(".", "").lstrip("+-")[:1].isdigit():
        return None
    try:
        return float(bare)
    except ValueError:
        return None


def _is_number(cell: object) -> bool:
    return isinstance(cell, (int, float, *MOMENTS)) or (isinstance(cell, str) and _parsed(cell) is not None)


def _is_filled(cell: object) -> bool:
    return not isinstance(cell, str) or bool(cell.strip())


def _kind(cell: object) -> str:
    if isinstance(cell, MOMENTS):
        return "time"
    if not _is_filled(cell):
        return "empty"
    return "number" if _is_number(cell) else "text"
