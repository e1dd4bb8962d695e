"""Small tables of text with units in their heads: lists of records, hazard curves."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

from colonnade.errors import ReadError, quoted
from colonnade.readers.files import irregular, unreachable
from colonnade.readers.text.encoding import detect_encoding, looks_binary, open_text

LARGEST_BYTES = 5_000_000
MOST_ROWS = 10_000
MOST_COLUMNS = 100

_HEAD = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*")


@dataclass(frozen=True)
class Head:
    """Head of a column, `interval [ms]`: its name, and its unit or None."""

    name: str
    unit: str | None


@dataclass(frozen=True)
class SmallTable:
    """
    A table of text.

    Attributes
    ----------
    name : str
        Of its file.
    heads : tuple of Head
    rows : tuple of (int, tuple of str)
        Line of each row in the file, and its cells, as many as there are heads; a decimal comma has become a point if
        the cells are not divided by commas.
    faults : tuple of (int, str)
        Line of each row that cannot be used, and why.
    """

    name: str
    heads: tuple[Head, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    faults: tuple[tuple[int, str], ...]


def read_table(path: Path, what: str) -> SmallTable:
    """
    Read a small table: comma, semicolon or tab, one row of heads, empty rows and rows that begin with # left out.

    Parameters
    ----------
    path : Path
    what : str
        What it is, for messages: "a list of records".

    Raises
    ------
    ReadError
        If it cannot be opened, is no such table, or is too large for one.
    """
    try:
        if kind := irregular(path):
            raise ReadError(f"{path.name}: this is {kind}; {what} was expected.")
        if (size := path.stat().st_size) > LARGEST_BYTES:
            raise ReadError(f"{path.name}: {size} bytes are too many for {what}; is it a record itself?")
        with open_text(path, detect_encoding(path).name) as stream:
            text = stream.read(LARGEST_BYTES).removeprefix("\ufeff")
    except OSError as error:
        raise ReadError(unreachable(path, error)) from None
    except ValueError as error:
        raise ReadError(f"{path.name}: {error}.") from None
    if said := looks_binary(text.splitlines()):
        raise ReadError(f"{path.name}: it is no text ({said}). {what.capitalize()} as CSV was expected.")
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip() and line[0] != "#"]
    if not lines:
        raise ReadError(f"{path.name}: the file is empty. {what.capitalize()} with a row of column heads was expected.")
    delimiter = max(",;\t", key=lines[0][1].count)
    try:
        heads = tuple(_head(cell) for cell in _cells(lines[0][1], delimiter))
    except ReadError as error:
        raise ReadError(f"{path.name}, line {lines[0][0]}: {error}") from None
    if len(lines) > MOST_ROWS or len(heads) > MOST_COLUMNS:
        raise ReadError(
            f"{path.name}: {len(lines)} rows of {len(heads)} columns are too many for {what}; at most {MOST_ROWS} of "
            f"{MOST_COLUMNS} were expected."
        )
    rows, faults = [], []
    for number, line in lines[1:]:
        try:
            rows.append((number, _row(_cells(line, delimiter), delimiter, len(heads))))
        except ReadError as error:
            faults.append((number, str(error)))
    return SmallTable(path.name, heads, tuple(rows), tuple(faults))


def _row(cells: list[str], delimiter: str, count: int) -> tuple[str, ...]:
    cells = [cell.strip() for cell in cells]
    if any(cells[count:]):
        raise ReadError(
            f"{len(cells)} cells are below {count} heads, the last {quoted(cells[-1])}. Put a cell that holds the "
            "separator in quotes."
        )
    if delimiter != ",":
        cells = [re.sub(r"^([+-]?\d+),(\d+)", r"\1.\2", cell) for cell in cells]
    return (*cells[:count], *("",) * (count - len(cells)))


def _cells(line: str, delimiter: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=delimiter, strict=True))
    except (csv.Error, StopIteration) as error:
        raise ReadError(f"this is no row of a table ({error}).") from None


def _head(cell: str) -> Head:
    found = _HEAD.fullmatch(cell)
    if found is None:
        return Head(cell.strip(), None)
    unit = found["unit"]
    return Head(found["name"].strip(), None if unit is None else unit.strip())
