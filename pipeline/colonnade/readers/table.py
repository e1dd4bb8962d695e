"""A block of rows of numbers within a text file -> columns, with the lines that are not as they should be."""

from __future__ import annotations

import csv
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from io import StringIO
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.cells import WHITESPACE, Dialect, decimals_of
from colonnade.readers.samples import numbers_of

Array = NDArray[np.float64]

ROWS_AT_ONCE = 20_000


@dataclass(frozen=True)
class Table:
    """
    Columns of numbers out of a text.

    Attributes
    ----------
    columns : tuple of ndarray, shape (n,)
        NaN where a cell holds no number, or the row has too many or too few cells.
    lines : ndarray of int, shape (n,)
        The line of each row in the file, from 1.
    blanked : ndarray of bool, shape (n,)
        Rows with too many or too few cells.
    ending : tuple of str
        The last two rows, or fewer where there are not so many.
    """

    columns: tuple[Array, ...]
    lines: NDArray[np.int64]
    blanked: NDArray[np.bool_]
    ending: tuple[str, ...]

    def without_last_row(self) -> Table:
        """Leave out the last row."""
        return Table(tuple(column[:-1] for column in self.columns), self.lines[:-1], self.blanked[:-1], ())


@dataclass
class _Pieces:
    """What has been read so far."""

    columns: list[list[Array]]
    lines: list[NDArray[np.int64]] = field(default_factory=list)
    blanked: list[NDArray[np.bool_]] = field(default_factory=list)
    ending: tuple[str, ...] = ()


def read_table(rows: Iterable[tuple[int, str]], dialect: Dialect, width: int, *, beyond: int = 0) -> Table:
    """
    Read rows of numbers.

    Parameters
    ----------
    rows : iterable of (int, str)
        Number and text of each line; none of them blank.
    dialect : Dialect
    width : int
        Columns of numbers.
    beyond : int
        Further cells that a row may have; they are not looked at.
    """
    pieces = _Pieces([[] for _ in range(width)])
    remaining = iter(rows)
    while piece := list(islice(remaining, ROWS_AT_ONCE)):
        numbers = np.array([number for number, _ in piece], dtype=np.int64)
        texts = [text for _, text in piece]
        columns = _at_once(texts, dialect, width, beyond)
        if columns is None or np.isnan(columns[-1]).any():  # a row that is too short has nothing in the last column
            columns, blanked = _one_by_one(texts, dialect, width, beyond)
        else:
            blanked = np.zeros(len(piece), dtype=bool)
        for column, values in zip(pieces.columns, columns, strict=True):
            column.append(values)
        pieces.lines.append(numbers)
        pieces.blanked.append(blanked)
        pieces.ending = (*pieces.ending, *texts)[-2:]
    if not pieces.lines:
        nothing = tuple(np.empty(0) for _ in range(width))
        return Table(nothing, np.empty(0, dtype=np.int64), np.empty(0, dtype=bool), ())
    return Table(
        tuple(np.concatenate(column) for column in pieces.columns),
        np.concatenate(pieces.lines),
        np.concatenate(pieces.blanked),
        pieces.ending,
    )


def _at_once(texts: list[str], dialect: Dialect, width: int, beyond: int) -> list[Array] | None:
    """Read rows as fast as pandas does; None where they are not all alike."""
    import pandas as pd
    from pandas.errors import ParserError, ParserWarning

    with warnings.catch_warnings():
        warnings.simplefilter("error", ParserWarning)
        try:
            frame = pd.read_csv(
                StringIO("\n".join(texts)),
                sep=r"\s+" if dialect.delimiter == WHITESPACE else dialect.delimiter,
                decimal=dialect.decimal,
                header=None,
                names=list(range(width + beyond + 1)),
                index_col=False,
                quoting=csv.QUOTE_NONE,
                skip_blank_lines=False,
                low_memory=False,
            )
        except (ParserError, ParserWarning):
            return None
    if len(frame) != len(texts) or frame[width + beyond].notna().any():
        return None
    return [numbers_of(frame[column], dialect) for column in range(width)]


def _one_by_one(texts: list[str], dialect: Dialect, width: int, beyond: int) -> tuple[list[Array], NDArray[np.bool_]]:
    """Read rows of which some are not as they should be."""
    values = np.full((len(texts), width), np.nan)
    blanked = np.zeros(len(texts), dtype=bool)
    for row, text in enumerate(texts):
        cells = dialect.split(text)
        if width <= len(cells) <= width + beyond or (len(cells) > width and not any(cells[width + beyond :])):
            values[row] = [dialect.number(cell) for cell in cells[:width]]
        else:
            blanked[row] = True
    values[np.isinf(values)] = np.nan
    return list(values.T.copy()), blanked


def without_cut_end(table: Table, dialect: Dialect) -> tuple[Table, list[str]]:
    """
    Mend the end of a file that has no line end, and so may have been cut off within its last line.

    Returns
    -------
    table : Table
        Without the last row, where that is not whole; its last number missing, where that has fewer decimals than
        the one above.
    warnings : list of str
    """
    if not table.lines.size:
        return table, []
    line, place = int(table.lines[-1]), len(table.columns) - 1
    if table.blanked[-1]:
        return table.without_last_row(), [f"line {line}: left out: the file ends here, before all cells of the row"]
    above, last = (dialect.split(text) for text in (table.ending * 2)[-2:])
    if len(last) == place + 1 <= len(above):
        have, usual = (decimals_of(cells[place], dialect.decimal) for cells in (last, above))
        if have < usual:
            column = table.columns[place].copy()
            column[-1] = np.nan
            return replace(table, columns=(*table.columns[:place], column)), [
                f'the file ends within a number: "{last[place]}" on line {line} has {have} decimals where the one '
                f"above has {usual}; it counts as missing"
            ]
    return table, []


def report_faults(table: Table, headings: Sequence[str], *, optional: Sequence[int] = ()) -> list[str]:
    """
    Tell of rows with too many or too few cells, and for each column of the cells without a number.

    Parameters
    ----------
    table : Table
    headings : sequence of str
        Of the columns.
    optional : sequence of int
        Columns, from 0, whose cells may be empty.
    """
    told = []
    if table.blanked.any():
        lines = table.lines[table.blanked]
        several = lines.size > 1
        told.append(
            f"{lines.size} row{'s' if several else ''} with too many or too few cells "
            f"({'first ' if several else ''}on line {lines[0]}): missing"
        )
    for number, (heading, column) in enumerate(zip(headings, table.columns, strict=True)):
        absent = np.isnan(column) & ~table.blanked
        if number not in optional and absent.any():
            lines = table.lines[absent]
            count = "1 cell holds no number (on" if lines.size == 1 else f"{lines.size} cells hold no number (first on"
            told.append(f'"{heading}": {count} line {lines[0]}); missing')
    return told
