"""Rows of a text become columns of numbers, in one pass of pandas; rows unlike the others come with their lines."""

from __future__ import annotations

import csv
import warnings
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from datetime import datetime
from io import BytesIO
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.readers.recording import DAY
from colonnade.readers.text.dialect import MARKED, WHITESPACE, Dialect, is_sample, kind_of, looks_like_numbers
from colonnade.readers.text.encoding import UNREADABLE, Piece
from colonnade.signals.samples import side_by_side, threads

if TYPE_CHECKING:
    import pandas as pd

Fault = Literal["comment", "text", "cut", "struck out", "long", "short"]


class Row(NamedTuple):
    """A row, by its number among the columns' values from 0, with its line in the file from 1 and what is wrong."""

    row: int
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

    @property
    def most_cells(self) -> int:
        """Cells that a row has at most."""
        return len(self.kinds) + self.trailing + self.remark

    def fault_of(self, row: Row, *, has_number: bool) -> Fault | None:
        """Name what is wrong with a row; None if it is a sample, though perhaps without some of its numbers."""
        dialect, cells = self.dialect, row.cells
        if not self.by_instrument:
            if dialect.is_comment(row.text):
                bare = row.text.lstrip().lstrip("".join(dialect.comments))
                return (
                    "struck out" if is_sample(bare, dialect, (*self.kinds, *["empty"] * self.trailing)) else "comment"
                )
            if not has_number and not looks_like_numbers(row.text):
                # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
                return "text" if any(kind_of(cell, dialect) == "text" for cell in cells) else None
        is_long = len(cells) > self.most_cells and not self.by_instrument
        if is_long or any(cells[len(self.kinds) + self.remark :]):
            return "long"
        return "short" if len(cells) < len(self.kinds) + self.trailing else None


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
    odd : list of Row
        Rows with a fault; others so that of each column the first without a number is among them.
    start : datetime or None
        The first timestamp, if it has a date; in its own zone if it has one.
    tail : list of Row
        The last rows, up to `TAIL`, of a file that ends within a line.
    """

    form: RowForm
    size: int = 0
    columns: list[Array] = field(default_factory=list)
    odd: list[Row] = field(default_factory=list)
    start: datetime | None = None
    tail: list[Row] = field(default_factory=list)


TAIL = 200
"""Rows at the end that show whether numbers are written with a fixed number of decimals."""


def read_rows(pieces: Iterable[Piece], form: RowForm) -> Rows:
    """Read rows of numbers."""
    from pandas.errors import ParserWarning

    rows = Rows(form)
    columns: list[list[Array]] = [[] for _ in form.kinds]
    last: deque[Piece] = deque(maxlen=2)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ParserWarning)  # pandas only warns when it drops cells
        for piece, part in _parts(pieces, form):
            rows.odd += [row._replace(row=row.row + rows.size) for row in part.odd]
            rows.start = rows.start if rows.size else _start(part.frame, form)
            for whole, values in zip(columns, part.columns, strict=True):
                whole.append(values)
            rows.size += part.size
            last.append(piece)
    # A column's pieces are joined one column at a time, so that little is held twice.
    rows.columns = side_by_side(_joined, columns)
    for column, kind in enumerate(form.kinds):
        if kind == "time":
            known = rows.columns[column][~np.isnan(rows.columns[column])]
            rows.columns[column] = (rows.columns[column] - known[:1].sum()) / 1e6
    ending = last[-1].text.rstrip(UNREADABLE + "\x1a") if last else ""
    if ending and not ending.endswith("\n"):
        lines = [each for line, text in last for each in enumerate(text.split("\n"), line)]
        filled = [(line, text) for line, text in lines if not form.dialect.is_blank(text)]
        numbered = enumerate(filled, rows.size - len(filled))
        rows.tail = [Row(row, line, text, form.dialect.split(text)) for row, (line, text) in numbered][-TAIL:]
    return rows


class _Part(NamedTuple):
    """What a piece holds: rows, their values, their cells (with blank lines), and the rows that deserve a look."""

    size: int
    columns: list[Array]
    frame: pd.DataFrame
    odd: list[Row]


def _parts(pieces: Iterable[Piece], form: RowForm) -> Iterator[tuple[Piece, _Part]]:
    """Read pieces, several at the same time; they come in their order."""
    waiting: deque[tuple[Piece, Future[_Part]]] = deque()
    with ThreadPoolExecutor(threads()) as pool:
        for piece in pieces:
            if piece.text.isspace():
                continue
            waiting.append((piece, pool.submit(_part, piece, form)))
            if len(waiting) > threads():
                done, part = waiting.popleft()
                yield done, part.result()
        while waiting:
            done, part = waiting.popleft()
            yield done, part.result()


def _part(piece: Piece, form: RowForm) -> _Part:
    """Read a piece: one row a line, whose blank ones are then left out."""
    frame = _frame(piece.text, form)
    columns = [_values(frame[column], kind, form, column) for column, kind in enumerate(form.kinds)]
    absent = [np.isnan(values) for values in columns]
    doubtful = _doubtful(frame, absent, form)
    firsts = (np.flatnonzero(missing & ~doubtful)[:1].tolist() for missing in absent)
    wanted = sorted({*np.flatnonzero(doubtful).tolist()}.union(*firsts))
    texts = piece.text.split("\n") if wanted else []
    odd: list[Row] = []
    blank: list[int] = []
    lacking: set[int] = set()
    for number in wanted:
        text = texts[number]
        if form.dialect.is_blank(text):
            blank.append(number)
            continue
        row = Row(number - len(blank), piece.line + number, text, form.dialect.split(text))
        without = {column for column, missing in enumerate(absent) if missing[number]}
        fault = form.fault_of(row, has_number=len(without) < len(absent)) if doubtful[number] else None
        if fault is not None or not without <= lacking:
            odd.append(row._replace(fault=fault))
            lacking |= without if fault is None else set()
    columns = [np.delete(values, blank) for values in columns] if blank else columns
    return _Part(len(frame) - len(blank), columns, frame, odd)


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
        "skip_blank_lines": False,
        "na_values": list(dialect.missing),
        "dtype": dict.fromkeys(form.grouped, str),
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
    for beyond in range(len(form.kinds) + form.remark, frame.shape[1]):
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


def _values(cells: pd.Series, kind: str, form: RowForm, column: int) -> Array:
    """Values of a column: what pandas has read as numbers, else each cell by itself; µs of timestamps."""
    if kind == "time":
        return _ticks(_stamps(cells))
    if cells.dtype.kind in "biuf":
        values = cells.to_numpy(dtype=np.float64, copy=True)  # a view would keep all columns of its piece
    else:
        dialect = form.dialect
        if sign := form.grouped.get(column):
            dialect = replace(dialect, decimal=".,".replace(sign, ""), thousands=sign)
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


def _start(frame: pd.DataFrame, form: RowForm) -> datetime | None:
    """Find the first date with time of the first column that has one."""
    import pandas as pd

    for column in [column for column, kind in enumerate(form.kinds) if kind == "time"]:
        stamps = _stamps(frame[column])
        dated = stamps[stamps.str.match(DATED) & ~np.isnan(_ticks(stamps))]
        if len(dated):
            return pd.Timestamp(dated.iloc[0]).to_pydatetime(warn=False)
    return None


def past_midnight(seconds: Array) -> Array:
    """Let times of day go on when the clock was set back by most of a day, as at midnight."""
    known = np.isfinite(seconds)
    steps = np.diff(seconds[known], prepend=seconds[known][:1])
    turned = seconds.copy()
    turned[known] += DAY * np.cumsum(steps < -DAY / 2)
    return turned


THOUSAND = 1000.0
"""A number without a mark between thousands is below it."""
LARGE = 100.0
"""Some numbers above it have no mark where others have one, on the way there."""
MANY = 50
"""Different numbers that have a mark, so many that decimals would differ in their number of digits."""


def marks_suspected(rows: Rows) -> dict[int, str]:
    """
    Find columns whose numbers may be whole, with a point or comma between thousands, and that sign.

    As decimal signs these leave three decimals to each number that is not whole, and no number from 1000 on; as others
    they leave no number at all.
    """
    found = {
        column: mark[1]
        for row in rows.odd
        for column, (cell, kind) in enumerate(zip(row.cells, rows.form.kinds, strict=False))
        if kind == "number" and row.fault is None and (mark := MARKED.fullmatch(cell.strip('"')))
    }
    for column, kind in enumerate(rows.form.kinds):
        values = np.abs(rows.columns[column])
        if kind == "number" and not any(map(_is_decimal, (values[:1000], values))) and (values % 1 > 0).any():
            found[column] = rows.form.dialect.decimal
    return found


def _is_decimal(sizes: Array) -> bool:
    """Whether numbers cannot have lost a mark between their thousands."""
    thousandths = THOUSAND * sizes[sizes % 1 > 0]
    is_far = bool((sizes >= THOUSAND).any() or (thousandths < THOUSAND).any())
    return is_far or bool((np.abs(thousandths - np.rint(thousandths)) > 1e-6).any())


def are_marked(numbers: Array, again: Array) -> bool:
    """Whether numbers that were read again with a mark between thousands are all whole, on both sides of a thousand."""
    known = np.abs(again[np.isfinite(numbers) | np.isfinite(again)])
    if not known.size or not (known == np.rint(known)).all():
        return False
    small = known[known < THOUSAND]
    return bool(small.size) and bool((small >= LARGE).any() or np.unique(known[known >= THOUSAND]).size >= MANY)
