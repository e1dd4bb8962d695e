"""Rows of a text -> columns of numbers, read by pandas; rows unlike the others come with their lines and faults."""

from __future__ import annotations

import csv
import warnings
from collections import deque
from collections.abc import Generator, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import datetime
from io import StringIO, TextIOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.errors import ReadError
from colonnade.readers.text.cells import WHITESPACE, Dialect, is_sample, kind_of, looks_like_numbers
from colonnade.readers.text.columns import Grouping, Timestamps
from colonnade.readers.text.encoding import UNREADABLE, Piece
from colonnade.signals.parallel import side_by_side, threads

if TYPE_CHECKING:
    import pandas as pd

Fault = Literal["comment", "text", "cut", "struck out", "long", "short"]


@dataclass(frozen=True)
class RowForm:
    """
    How rows are written, and what they hold.

    Attributes
    ----------
    dialect : Dialect
    kinds : tuple of str
        What each column holds, by `cells.kind_of`.
    trailing : int
        Nameless empty cells after these columns on every line, made by delimiters at its end.
    remark : bool
        Whether a row may have a further cell, which is not looked at.
    by_instrument : bool
        Whether an instrument's own program wrote them: each row is a sample in its place, whatever it holds, and may
        end in empty cells.
    ragged : bool
        Whether columns may end before the last row, as those of channels with fewer samples.
    exact : bool
        Whether numbers are read to their last digit, which takes three times as long.
    grouped : dict of int to str
        Columns of whole numbers with a sign between their thousands.
    """

    dialect: Dialect
    kinds: tuple[str, ...]
    trailing: int = 0
    remark: bool = False
    by_instrument: bool = False
    ragged: bool = False
    exact: bool = False
    grouped: Mapping[int, str] = field(default_factory=dict)

    def dialect_of(self, column: int) -> Dialect:
        """How the numbers of a column are written."""
        sign = self.grouped.get(column)
        return self.dialect if sign is None else replace(self.dialect, decimal=".,".replace(sign, ""), thousands=sign)

    @property
    def cells(self) -> int:
        """Cells that a row has at least, the empty ones at its end among them."""
        return len(self.kinds) + self.trailing

    @property
    def most_cells(self) -> int:
        """Cells that a row has at most."""
        return self.cells + self.remark


@dataclass(frozen=True)
class Row:
    """A row, by its number among the columns' values from 0, with its line in the file from 1."""

    row: int
    line: int
    text: str
    cells: list[str]


def fault_of(row: Row, form: RowForm, *, has_number: bool) -> Fault | None:
    """Name what is wrong with a row; None if it is a sample, though perhaps without some of its numbers."""
    dialect = form.dialect
    if not form.by_instrument:
        if dialect.is_comment(row.text):
            bare = row.text.lstrip().lstrip("".join(dialect.comments))
            return "struck out" if is_sample(bare, dialect, [*form.kinds, *["empty"] * form.trailing]) else "comment"
        if not has_number and not looks_like_numbers(row.text):
            # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
            return "text" if any(kind_of(cell, dialect) == "text" for cell in row.cells) else None
    beyond = row.cells[len(form.kinds) + form.remark :]
    if any(beyond) or (len(row.cells) > form.most_cells and not form.by_instrument):
        return "long"
    return "short" if len(row.cells) < form.cells else None


TAIL = 200
"""Rows at the end that show whether numbers are written with a fixed number of decimals."""


@dataclass
class Rows:
    """
    Columns of numbers, with the rows that deserve a look.

    Attributes
    ----------
    form : RowForm
        How they are written.
    size : int
        Number of the rows.
    columns : list of ndarray, shape (n,)
        NaN without a number; seconds from the first for columns of timestamps.
    faults : dict of str to list of Row
        Rows that are not as they should be, in their order.
    without_number : dict of int to Row
        By its number in the columns, the first other row without a number in a column.
    skipped : int
        Rows of the file before the first of these.
    reaches_end : bool
        Whether the file's last row is among them.
    """

    form: RowForm
    size: int = 0
    columns: list[Array] = field(default_factory=list)
    faults: dict[Fault, list[Row]] = field(default_factory=dict)
    without_number: dict[int, Row] = field(default_factory=dict)
    skipped: int = 0
    reaches_end: bool = True
    _last: deque[tuple[int, Piece]] = field(default_factory=lambda: deque(maxlen=2))

    def __post_init__(self) -> None:
        kinds = self.form.kinds
        # A column's pieces are joined one column at a time, so that little is held twice.
        self._pieces: list[list[Array]] = [[] for _ in kinds]
        self._clocks = {column: Timestamps() for column, kind in enumerate(kinds) if kind == "time"}
        self._grouping = {column: Grouping(self.form.dialect) for column, kind in enumerate(kinds) if kind == "number"}
        self._complete = set(range(len(kinds)))

    @property
    def grouped(self) -> dict[int, str]:
        """The sign between thousands of the columns whose numbers seem to have one."""
        return {column: found.sign for column, found in self._grouping.items() if found.sign is not None}

    @property
    def start(self) -> datetime | None:
        """The first timestamp that has a date."""
        return next((clock.start for clock in self._clocks.values() if clock.start is not None), None)

    def tail(self) -> list[Row]:
        """Cut the last rows, up to `TAIL`, into cells again."""
        dialect = self.form.dialect
        lines = [
            (first + number, *found) for first, piece in self._last for number, found in enumerate(piece.rows(dialect))
        ]
        return [Row(row, line, text, dialect.split(text)) for row, line, text in lines[-TAIL:]]

    def add(self, piece: Piece, frame: pd.DataFrame, numbers: Mapping[int, Array]) -> None:
        """Add a piece, cut into cells, to the columns; look at the rows of it that may not be as they should be."""
        columns = [
            self._clocks[column].seconds(frame[column]) if kind == "time" else numbers[column]
            for column, kind in enumerate(self.form.kinds)
        ]
        for column, grouping in self._grouping.items():
            if not grouping.is_refuted:
                grouping.look(frame[column], columns[column])
        absent = [np.isnan(values) for values in columns]
        self._look(piece, _doubtful(frame, absent, self.form), absent)
        for pieces, values in zip(self._pieces, columns, strict=True):
            pieces.append(values)
        self._last.append((self.size, piece))
        self.size += len(frame)

    def _look(self, piece: Piece, doubtful: Mask, absent: list[Mask]) -> None:
        """Find the faults of doubtful rows, and the first row without a number in each column that had all so far."""
        lacking = {column for column in self._complete if absent[column].any()}
        if not doubtful.any() and not lacking:
            return
        sought = set(np.flatnonzero(doubtful).tolist())
        sought.update(*(np.flatnonzero(absent[column] & ~doubtful)[:1].tolist() for column in lacking))
        for number, (line, text) in enumerate(piece.rows(self.form.dialect)):
            if number not in sought:
                continue
            sought.remove(number)
            row = Row(self.size + number, line, text, self.form.dialect.split(text))
            empty = [column for column, missing in enumerate(absent) if missing[number]]
            fault = fault_of(row, self.form, has_number=len(empty) < len(absent)) if doubtful[number] else None
            if fault is not None:
                self.faults.setdefault(fault, []).append(row)
            elif not lacking.isdisjoint(empty):
                self.without_number[row.row] = row
                lacking.difference_update(empty)
                self._complete.difference_update(empty)
            if not sought:
                return

    def join(self) -> None:
        """Make a column of its pieces."""
        self.columns = side_by_side(_joined, self._pieces)


@dataclass(frozen=True)
class Stretch:
    """
    The part of a long file that is wanted.

    Attributes
    ----------
    low, high : float
        Values of the clock, in its own unit, or numbers of rows from 0.
    column : int or None
        The clock; without it rows are counted.
    """

    low: float
    high: float
    column: int | None = None

    def place(self, rows: int, numbers: Mapping[int, Array], before: int) -> int:
        """Say whether a piece, with `before` rows in front, is wholly ahead of it (-1) or behind it (1); else 0."""
        if self.column is None:
            first, last = float(before), float(before + rows - 1)
        else:
            times = numbers[self.column]
            if np.isnan(times).all():
                return 0
            first, last = float(np.nanmin(times)), float(np.nanmax(times))
        return -1 if last < self.low else 1 if first > self.high else 0


def read_rows(path: Path, pieces: Iterable[Piece], form: RowForm, stretch: Stretch | None = None) -> Rows:
    """
    Read rows of numbers.

    Parameters
    ----------
    path : Path
        The file, for messages.
    pieces : iterable of Piece
    form : RowForm
    stretch : Stretch, optional
        What is wanted of them; some rows on either side may come along. Default: all.

    Raises
    ------
    ReadError
        If lines cannot be cut into cells.
    """
    from pandas.errors import ParserError, ParserWarning

    taken = Rows(form)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", ParserWarning)  # pandas only warns when it drops cells
            with closing(_cut(pieces, form)) as frames:
                for piece, frame, numbers in frames:
                    place = 0 if stretch is None else stretch.place(len(frame), numbers, taken.skipped + taken.size)
                    if place < 0 and not taken.size:
                        taken.skipped += len(frame)
                        continue
                    if place > 0 and taken.size:
                        taken.reaches_end = False
                        break
                    taken.add(piece, frame, numbers)
    except (ParserError, ParserWarning) as error:
        raise ReadError(
            f"{path.name}: its lines cannot be split into cells ({str(error).strip()}). Look for lines that differ "
            "from the others."
        ) from error
    taken.join()
    return taken


def _cut(pieces: Iterable[Piece], form: RowForm) -> Generator[tuple[Piece, pd.DataFrame, dict[int, Array]], None, None]:
    """Cut pieces into cells and numbers, several at the same time; they come in their order."""
    waiting: deque[tuple[Piece, Future[tuple[pd.DataFrame, dict[int, Array]]]]] = deque()
    with ThreadPoolExecutor(threads()) as pool:
        for piece in pieces:
            waiting.append((piece, pool.submit(_cells_and_numbers, piece.text, form)))
            if len(waiting) > threads():
                done, found = waiting.popleft()
                yield done, *found.result()
        while waiting:
            done, found = waiting.popleft()
            yield done, *found.result()


def _cells_and_numbers(text: str, form: RowForm) -> tuple[pd.DataFrame, dict[int, Array]]:
    """Cut a text into cells, and read all columns but those of timestamps, which go on from piece to piece."""
    frame = _frame(text, form)
    columns = (column for column, kind in enumerate(form.kinds) if kind != "time")
    return frame, {column: numbers_of(frame[column], form.dialect_of(column)) for column in columns}


def _frame(text: str, form: RowForm) -> pd.DataFrame:
    """
    Cut a text into cells.

    pandas drops a line with too many cells, or hands it only to its slow engine. So there is a column more than there
    should be, which shows a row with one cell too many, and only a piece with longer rows is narrowed line by line.
    """
    import pandas as pd
    from pandas.errors import ParserError, ParserWarning

    dialect = form.dialect
    separator = "\x1f" if dialect.quoted else dialect.delimiter
    options: dict[str, Any] = {
        "sep": r"\s+" if separator == WHITESPACE else separator,
        "decimal": dialect.decimal,
        "header": None,
        "names": range(form.most_cells + 1),
        "index_col": False,
        "quoting": csv.QUOTE_NONE,
        "skipinitialspace": dialect.padded,  # costs a quarter of the speed
        "na_values": list(dialect.own_missing),
        "dtype": dict.fromkeys(form.grouped, str),
        "low_memory": False,
        "float_precision": "round_trip" if form.exact else None,
    }
    if not dialect.quoted:
        try:
            return pd.DataFrame(pd.read_csv(_Stream(text), **options))
        except (ParserError, ParserWarning):
            pass  # some line has more cells than pandas was prepared for
    # A quotation mark that is never closed could take all that follows with it: each line is cut by itself.
    narrowed = (_narrowed(line, form, separator) for line in StringIO(text, newline=""))
    return pd.DataFrame(pd.read_csv(_Stream("".join(narrowed)), **options))


def _narrowed(line: str, form: RowForm, separator: str) -> str:
    """Write a line without its quotation marks; one with too many cells as so many unreadable ones."""
    bare = line.rstrip("\r\n")
    if form.dialect.is_blank(bare):
        return line
    cells = form.dialect.split(bare)
    while form.by_instrument and len(cells) > form.most_cells and not cells[-1]:
        cells.pop()
    if len(cells) > form.most_cells + 1:
        cells = [UNREADABLE] * (form.most_cells + 1)
    return separator.join(cells) + line[len(bare) :]


class _Stream(TextIOBase):
    """A text that is read at once, and not encoded or copied before."""

    def __init__(self, text: str) -> None:
        self._text = text

    def readable(self) -> bool:
        """Tell pandas that it may read."""
        return True

    def read(self, size: int | None = -1, /) -> str:
        """Give all that is left."""
        text, self._text = self._text, ""
        return text


def _doubtful(frame: pd.DataFrame, absent: Sequence[Mask], form: RowForm) -> Mask:
    """Rows that may have the wrong number of cells or be no samples at all."""
    # A row without any number lacks the first; text there says nothing of the others.
    doubtful: Mask = np.logical_and.reduce(absent) if form.kinds[0] == "text" else absent[0].copy()
    for beyond in range(len(form.kinds) + form.remark, frame.shape[1]):
        doubtful |= frame[beyond].notna().to_numpy()
    # A short row has nothing in the last column that ever holds something.
    for column in {0, max((column for column, kind in enumerate(form.kinds) if kind != "empty"), default=0)}:
        doubtful |= frame[column].isna().to_numpy() if form.kinds[column] == "text" else absent[column]
    return doubtful


def _joined(pieces: list[Array]) -> Array:
    """One array in place of its pieces."""
    whole = np.concatenate(pieces) if pieces else np.empty(0)
    pieces.clear()
    return whole


def numbers_of(series: pd.Series, dialect: Dialect) -> Array:
    """Values of a column: what pandas has read as numbers, else each cell by itself."""
    if series.dtype.kind in "biuf":
        values = series.to_numpy(dtype=np.float64, copy=True)  # a view would keep all columns of its piece
    else:
        values = np.fromiter(map(dialect.number, series.to_list()), dtype=np.float64, count=len(series))
    return values if np.isfinite(values).all() else np.where(np.isinf(values), np.nan, values)


def filled_length(values: Array) -> int:
    """Count the values up to the last number."""
    known = np.flatnonzero(~np.isnan(values))
    return int(known[-1]) + 1 if known.size else 0
