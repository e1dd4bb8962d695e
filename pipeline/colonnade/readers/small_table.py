"""Small tables that people write, as CSV or in a workbook: test logs, lists of records, hazard curves."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import NamedTuple

from colonnade.errors import ReadError, nearest, quoted
from colonnade.readers.files import irregular, unreachable
from colonnade.readers.text.encoding import Text, looks_binary
from colonnade.readers.text.heading import take_apart

LARGEST_BYTES = 10_000_000
WORKBOOKS = (".xlsx", ".xlsm", ".xlsb", ".xls", ".ods")


class Head(NamedTuple):
    """Head of a column, `interval [ms]`: its name, and its unit or None."""

    name: str
    unit: str | None


@dataclass(frozen=True)
class SmallTable:
    """
    A table as people write it.

    Attributes
    ----------
    name : str
        Of its file.
    heads : tuple of Head
    rows : tuple of (int, tuple of str)
        Number of each row in the file, and its cells, as many as there are heads.
    has_decimal_comma : bool
        Whether a comma in a number is its decimal sign: it does not divide the cells.
    """

    name: str
    heads: tuple[Head, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    has_decimal_comma: bool

    def places(self, known: Collection[str], ignored: str) -> tuple[dict[str, int], list[str]]:
        """
        Find the columns that are known by their heads, in whatever case.

        Parameters
        ----------
        known : collection of str
        ignored : str
            What is said of another column: "is not a key of a test".

        Returns
        -------
        places : dict of str to int
        notes : list of str
            On columns that are ignored.

        Raises
        ------
        ReadError
            If a head is there twice, or nearly one that is known; with a line for each.
        """
        places: dict[str, int] = {}
        notes, wrong = [], []
        for index, head in enumerate(self.heads):
            name = head.name.casefold()
            if name in places:
                wrong.append(f"{self.name}: duplicate column head {quoted(head.name)}.")
            elif name in known:
                places[name] = index
            elif get_close_matches(name, known, n=1, cutoff=0.75):
                wrong.append(f"{self.name}: unknown column {quoted(head.name)}.{nearest(head.name, known)}")
            elif name:
                notes.append(f"{self.name}: column {quoted(head.name)} {ignored}; it is ignored.")
        if wrong:
            raise ReadError("\n".join(wrong))
        return places, notes

    def quantity(self, index: int, cell: str) -> str:
        """Write the number in a cell of a column with a decimal point, and with the unit of the head if it has none."""
        text = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", cell) if self.has_decimal_comma else cell
        unit = self.heads[index].unit
        return f"{text} {unit}" if unit and re.fullmatch(r"[-+0-9.eE]+", text) else text


def read_table(path: Path, what: str) -> SmallTable:
    """
    Read a small table: comma, semicolon or tab, or the first sheet of a workbook.

    It has one row of heads; empty rows and rows that begin with # are left out.

    Parameters
    ----------
    path : Path
    what : str
        What it is, for messages: "a list of records".

    Raises
    ------
    ReadError
        If it cannot be opened, is no such table, is too large for one, or has rows that cannot be used.
    """
    try:
        if kind := irregular(path):
            raise ReadError(f"{path.name}: this is {kind}; {what} was expected.")
        if (size := path.stat().st_size) > LARGEST_BYTES:
            raise ReadError(f"{path.name}: {size} bytes are too many for {what}; is it a recording?")
        if path.suffix.lower() in WORKBOOKS:
            from colonnade.readers.binary.excel import cells_of_first_sheet

            delimiter, rows = "", list(enumerate(cells_of_first_sheet(path), 1))
        else:
            with Text.of(path).open() as stream:
                text = stream.read(LARGEST_BYTES).removeprefix("\ufeff")
            if said := looks_binary(text.splitlines()):
                raise ReadError(f"{path.name}: it is no text ({said}). {what.capitalize()} as CSV was expected.")
            first = next((line for line in text.splitlines() if line.strip() and line[0] != "#"), "")
            delimiter = max(",;\t", key=first.count)
            rows = list(_rows(path, text, delimiter))
    except OSError as error:
        raise ReadError(unreachable(path, error)) from None
    except ValueError as error:
        raise ReadError(f"{path.name}: {error}.") from None
    stripped = ((number, [cell.strip() for cell in cells]) for number, cells in rows)
    rows = [(number, cells) for number, cells in stripped if any(cells) and not cells[0].startswith("#")]
    if not rows:
        raise ReadError(f"{path.name}: the file is empty. {what.capitalize()} with a row of column heads was expected.")
    heads = tuple(Head(*take_apart(cell)) for cell in rows[0][1])
    width = len(heads)
    if wrong := [
        f"{path.name}, row {number}: {len(cells)} cells are below {width} heads, the last {quoted(cells[-1])}. Put a "
        "cell that holds the separator in quotes."
        for number, cells in rows[1:]
        if any(cells[width:])
    ]:
        raise ReadError("\n".join(wrong))
    filled = tuple((number, (*cells[:width], *("",) * (width - len(cells)))) for number, cells in rows[1:])
    return SmallTable(path.name, heads, filled, delimiter != ",")


def _rows(path: Path, text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Give the rows of CSV by number; ReadError at the first that is none."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    number = 1
    try:
        for cells in reader:
            yield number, cells
            number = reader.line_num + 1
    except csv.Error as error:
        raise ReadError(f"{path.name}, row {number}: this is no row of a table ({error}).") from None
