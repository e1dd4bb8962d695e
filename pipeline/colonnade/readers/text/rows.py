"""Rows of a text become columns of numbers, in one pass of pandas, a row a line; odd ones come with their lines."""

from __future__ import annotations

import csv
import warnings
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from datetime import datetime
from io import BytesIO
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.readers.text.dialect import WHITESPACE, Dialect, kind_of, looks_like_numbers
from colonnade.readers.text.encoding import UNREADABLE, Piece
from colonnade.signals.samples import side_by_side, threads

if TYPE_CHECKING:
    import pandas as pd

Fault = Literal["comment", "text", "cut", "long", "short"]


class Row(NamedTuple):
    """A line, by its number in the file from 1, with what is wrong with it."""

    line: int
    text: str
    cells: list[str]
    fault: Fault | None = None


@dataclass(frozen=True)
class RowForm:
    """
    How rows are written, and what they hold.

    Attributes
    ----------
    dialect : Dialect
    kinds : tuple of str
        What each column holds, by `dialect.kind_of`, or "empty".
    trailing : int
        Nameless cells after these columns: empty ones on every line, made by delimiters at its end.
    by_instrument : bool
        Whether an instrument's own program wrote them: each row is a sample in its place, whatever it holds, and may
        end in empty cells. A trailing cell is then a remark, which is not looked at.
    ragged : bool
        Whether columns may end before the last row, as those of channels with fewer samples.
    exact : bool
        Whether numbers are read to their last digit, which takes three times as long.
    """

    dialect: Dialect
    kinds: tuple[str, ...]
    trailing: int = 0
    by_instrument: bool = False
    ragged: bool = False
    exact: bool = False

    @property
    def most_cells(self) -> int:
        """Cells that a row has at most."""
        return len(self.kinds) + self.trailing

    def fault_of(self, row: Row, *, has_number: bool) -> Fault | None:
        """Name what is wrong with a row; None if it is a sample, though perhaps without some of its numbers."""
        dialect, cells, width = self.dialect, row.cells, len(self.kinds)
        if self.by_instrument:
            is_short = len(cells) < width and not self.ragged
            return "long" if any(cells[self.most_cells :]) else "short" if is_short else None
        if dialect.is_comment(row.text):
            return "comment"
        if not has_number and not looks_like_numbers(row.text):
            # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
            return "text" if any(kind_of(cell, dialect) == "text" for cell in cells) else None
        if len(cells) > self.most_cells or any(cells[width:]):
            return "long"
        return "short" if len(cells) < self.most_cells else None


class Rows(NamedTuple):
    """
    Columns of numbers, with the lines that deserve a look.

    Attributes
    ----------
    form : RowForm
        How they are written.
    line : int
        Number of the first line.
    columns : list of ndarray, shape (n,)
        A value a line: NaN without a number; seconds from the first for columns of timestamps.
    blank : ndarray of bool, shape (n,)
        Lines that hold nothing.
    odd : list of Row
        Rows with a fault; others so that of each column the first without a number is among them.
    start : datetime or None
        The first timestamp, if it has a date; in its own zone if it has one.
    is_cut : bool
        Whether the file ends within a line.
    """

    form: RowForm
    line: int
    columns: list[Array]
    blank: Mask
    odd: list[Row]
    start: datetime | None
    is_cut: bool


def read_rows(pieces: Iterable[Piece], form: RowForm) -> Rows:
    """Read rows of numbers."""
    from pandas.errors import ParserWarning

    with warnings.catch_warnings():
        warnings.simplefilter("error", ParserWarning)  # pandas only warns when it drops cells
        parts = [*_parts(pieces, form)]
    columns = [[part.columns[number] for part in parts] for number in range(len(form.kinds))]
    for part in parts:
        part.columns.clear()
    # A column's pieces are joined one column at a time, so that little is held twice.
    joined = side_by_side(_joined, columns)
    for column in [column for column, kind in enumerate(form.kinds) if kind == "time"]:
        known = joined[column][~np.isnan(joined[column])]
        joined[column] = (joined[column] - known[:1].sum()) / 1e6
    if not parts:
        return Rows(form, 1, joined, np.empty(0, dtype=bool), [], None, is_cut=False)
    blank = np.concatenate([part.blank for part in parts])
    odd = [row for part in parts for row in part.odd]
    return Rows(form, parts[0].line, joined, blank, odd, parts[0].start, parts[-1].is_cut)


def _parts(pieces: Iterable[Piece], form: RowForm) -> Iterator[Rows]:
    """Read pieces, several at the same time; they come in their order."""
    waiting: deque[Future[Rows]] = deque()
    with ThreadPoolExecutor(threads()) as pool:
        for piece in pieces:
            waiting.append(pool.submit(_part, piece, form))
            if len(waiting) > threads():
                yield waiting.popleft().result()
        for part in waiting:
            yield part.result()


def _part(piece: Piece, form: RowForm) -> Rows:
    """Read a piece: one row a line, the blank ones too; microseconds of timestamps."""
    frame = _frame(piece.text, form)
    columns = [_values(frame[column], kind, form.dialect) for column, kind in enumerate(form.kinds)]
    absent = [np.isnan(values) for values in columns]
    doubtful = _doubtful(frame, absent, form)
    blank = np.zeros(len(frame), dtype=bool)
    odd: list[Row] = []
    sound = ~doubtful
    texts = piece.text.split("\n") if doubtful.any() or any(missing.any() for missing in absent) else []
    for number in np.flatnonzero(doubtful).tolist():
        if form.dialect.is_blank(texts[number]):
            blank[number] = True
            continue
        row = Row(piece.line + number, texts[number], form.dialect.split(texts[number]))
        fault = form.fault_of(row, has_number=not all(missing[number] for missing in absent))
        if fault is None:
            sound[number] = True
        else:
            odd.append(row._replace(fault=fault))
    firsts = {int(np.argmax(gaps)) for missing in absent if (gaps := missing & sound).any()}
    odd += [Row(piece.line + number, texts[number], form.dialect.split(texts[number])) for number in firsts]
    start = next((_first_date(frame[column]) for column, kind in enumerate(form.kinds) if kind == "time"), None)
    ending = piece.text.rstrip(UNREADABLE + "\x1a")
    is_cut = ending != "" and not ending.endswith("\n")
    return Rows(form, piece.line, columns, blank, odd, start, is_cut)


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
        "skip_blank_lines": False,
        "na_values": list(dialect.missing),
        "low_memory": False,
        "float_precision": "round_trip" if form.exact else None,
    }
    if not dialect.quoted:
        try:
            return pd.DataFrame(pd.read_csv(BytesIO(text.encode()), **options))
        except (ParserError, ParserWarning):
            pass  # some line has more cells than pandas was prepared for
    # A quotation mark that is never closed could take all that follows with it: each line is cut by itself.
    narrowed = "\n".join(_narrowed(line, form, separator) for line in text.split("\n"))
    return pd.DataFrame(pd.read_csv(BytesIO(narrowed.encode()), **options))


def _narrowed(line: str, form: RowForm, separator: str) -> str:
    """Write a line without its quotation marks; one with too many cells as so many unreadable ones."""
    if form.dialect.is_blank(line):
        return line
    cells = form.dialect.split(line)
    while form.by_instrument and len(cells) > form.most_cells and not cells[-1]:
        cells.pop()
    if len(cells) > form.most_cells + 1:
        cells = [UNREADABLE] * (form.most_cells + 1)
    return separator.join(cells)


def _doubtful(frame: pd.DataFrame, absent: list[Mask], form: RowForm) -> Mask:
    """Rows that may have the wrong number of cells or be no samples at all."""
    # A row without any number lacks the first; text there says nothing of the others. A short row lacks the last.
    filled = [column for column, kind in enumerate(form.kinds) if kind != "empty"] or [0]
    doubtful: Mask = np.logical_and.reduce(absent)
    for column in (filled[0], filled[-1]):
        doubtful |= frame[column].isna().to_numpy() if form.kinds[column] == "text" else absent[column]
    for beyond in range(form.most_cells if form.by_instrument else len(form.kinds), frame.shape[1]):
        doubtful |= frame[beyond].notna().to_numpy()
    return doubtful


def _joined(pieces: list[Array]) -> Array:
    """One array in place of its pieces."""
    whole = np.concatenate(pieces) if pieces else np.empty(0)
    pieces.clear()
    return whole


def filled_length(values: Array) -> int:
    """Count the values up to the last number."""
    known = np.flatnonzero(~np.isnan(values))
    return int(known[-1]) + 1 if known.size else 0


def _values(cells: pd.Series, kind: str, dialect: Dialect) -> Array:
    """Values of a column: what pandas has read as numbers, else each cell by itself; µs of timestamps."""
    if kind == "time":
        return _ticks(_stamps(cells))
    if cells.dtype.kind in "biuf":
        values = cells.to_numpy(dtype=np.float64, copy=True)  # a view would keep all columns of its piece
    else:
        values = np.fromiter(map(dialect.number, cells.to_list()), dtype=np.float64, count=len(cells))
    return values if np.isfinite(values).all() else np.where(np.isinf(values), np.nan, values)


DATED = r"\d+-\d+-\d+[T ]"
DOTTED = r"^(\d{1,2})\.(\d{1,2})\.(\d{4})"


def _stamps(cells: pd.Series) -> pd.Series:
    """Write timestamps, `26.04.2013 10:15:00,125` (day first) among them, as ISO 8601 does."""
    cells = cells.astype("str").str.strip().str.strip('"').str.replace(",", ".", regex=False)
    return cells.str.replace(DOTTED, r"\3-\2-\1", regex=True).str.replace("/", "-", regex=False)


def _ticks(stamps: pd.Series) -> Array:
    """Microseconds of dates since 1970, or of times of day since midnight; NaN without a timestamp."""
    import pandas as pd

    filled = stamps.dropna()
    if len(filled) and filled.str.match(DATED).mean() > 0.5:
        moments = pd.to_datetime(stamps, format="ISO8601", errors="coerce", utc=True).dt.tz_localize(None)
        ticks = moments.to_numpy().astype("datetime64[us]")
    else:
        ticks = pd.to_timedelta(stamps, errors="coerce").to_numpy().astype("timedelta64[us]")
    return np.where(np.isnat(ticks), np.nan, ticks.astype(np.int64))


def _first_date(cells: pd.Series) -> datetime | None:
    """Find the first date with time of a column."""
    import pandas as pd

    stamps = _stamps(cells)
    dated = stamps[stamps.str.match(DATED) & ~np.isnan(_ticks(stamps))]
    return pd.Timestamp(dated.iloc[0]).to_pydatetime(warn=False) if len(dated) else None
