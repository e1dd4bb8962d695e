"""Rows of a text become columns of numbers, in one pass of pandas, a row a line; damage is told with its line."""

from __future__ import annotations

import csv
import warnings
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.readers.text.dialect import MISSING, WHITESPACE, Dialect, kind_of, looks_like_numbers
from colonnade.readers.text.encoding import UNREADABLE, Piece
from colonnade.signals.samples import side_by_side, threads

if TYPE_CHECKING:
    import pandas as pd

NUMERIC = ("number", "time")
"""Kinds of columns of which each cell should hold a number."""
SHOWN = 50
"""Characters of a line that a message quotes."""

Fault = Literal["blank", "text", "short", "long", "cut"]
SENTENCES: dict[Fault, str] = {
    "text": "left out: text without a number",
    "short": "counted as missing: fewer than {} cells",
    "long": "counted as missing: more than {} cells",
    "cut": "left out: the file ends here, before all {} cells",
}


@dataclass(frozen=True)
class RowForm:
    """
    How rows are written, and what they hold.

    Attributes
    ----------
    dialect : Dialect
    kinds : tuple of str
        What each column holds, as of `dialect.Sniffed`.
    trailing : int
        Cells behind these columns: empty ones on every row, made by delimiters at its end.
    has_remarks : bool
        Whether a cell behind these columns may be on any row, and is not looked at.
    is_ragged : bool
        Whether columns may end before the last row, and rows before the last cell.
    exact : bool
        Whether numbers are read to their last digit, which takes three times as long.
    """

    dialect: Dialect
    kinds: tuple[str, ...]
    trailing: int = 0
    has_remarks: bool = False
    is_ragged: bool = False
    exact: bool = False

    @property
    def width(self) -> int:
        """Columns, and what is behind them and not looked at."""
        return len(self.kinds) + self.has_remarks

    def fault_of(self, line: str, *, has_number: bool) -> Fault | None:
        """Name what is wrong with a row; None if it is a sample, though perhaps without some of its numbers."""
        if self.dialect.is_blank(line) or self.dialect.is_comment(line):
            return "blank"
        cells = self.dialect.split(line)
        if not has_number and not looks_like_numbers(line):
            # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
            return "text" if any(kind_of(cell, self.dialect) == "text" for cell in cells) else None
        if len(cells) < len(self.kinds) + self.trailing and not self.is_ragged:
            return "short"
        return "long" if any(cells[self.width :]) else None


class Faulty(NamedTuple):
    """A line, by its number in the file from 1, with what is wrong with it."""

    line: int
    text: str
    fault: Fault


class Part(NamedTuple):
    """The rows of a piece of a text; microseconds of timestamps."""

    columns: list[Array]
    faulty: list[Faulty]
    last: int
    """Number of the last line."""
    gap: tuple[int, str] | None
    """The first line with a cell without a number, and that cell."""


def read_rows(pieces: Iterable[Piece], form: RowForm, headings: Sequence[str]) -> tuple[list[Array], list[str]]:
    """
    Read a column of numbers for each heading, and give warnings of what is damaged.

    NaN is where no number is; columns of timestamps are seconds from the first. A line without any number, with text,
    is left out, as is a last line with too few cells, and blank lines and comments in silence. Another row with too
    many or too few counts as missing, because a value may be in its neighbour's column.
    """
    from pandas.errors import ParserWarning

    with warnings.catch_warnings():
        warnings.simplefilter("error", ParserWarning)  # pandas only warns when it drops cells
        parts = [*_parts(pieces, form)]
    faulty = [row for part in parts for row in part.faulty]
    if faulty and (faulty[-1].line, faulty[-1].fault) == (parts[-1].last, "short"):
        faulty[-1] = faulty[-1]._replace(fault="cut")
        parts[-1].columns[:] = [column[:-1] for column in parts[-1].columns]
    by_column = [[part.columns[number] for part in parts] for number in range(len(headings))]
    for part in parts:
        part.columns.clear()
    # A column's pieces are joined one column at a time, so that little is held twice.
    columns = side_by_side(_joined, by_column)
    for number, kind in zip(range(len(headings)), form.kinds, strict=False):
        if kind == "time":
            known = columns[number][~np.isnan(columns[number])]
            columns[number] = (columns[number] - known[:1].sum()) / 1e6
    damaged = {fault: [row for row in faulty if row.fault == fault] for fault in SENTENCES}
    told = [_listed(rows, SENTENCES[fault].format(len(form.kinds))) for fault, rows in damaged.items() if rows]
    gap = next((part.gap for part in parts if part.gap is not None), None)
    if gap is not None and not form.is_ragged:
        counts = [
            (heading, int(np.isnan(column).sum()) - len(damaged["short"] + damaged["long"]))
            for heading, column, kind in zip(headings, columns, form.kinds, strict=False)
            if kind in NUMERIC
        ]
        told.append(_lacking([each for each in counts if each[1]], *gap))
    return columns, told


def _listed(rows: list[Faulty], what: str) -> str:
    lines = ", ".join(str(row.line) for row in rows[:5])
    more = f" and {len(rows) - 5} more" if len(rows) > 5 else ""
    return f"line{'s' if len(rows) > 1 else ''} {lines}{more}: {what} ({_shown(rows[0].text)})"


def _lacking(counts: list[tuple[str, int]], line: int, cell: str) -> str:
    """Say how many cells of which columns hold no number, and where the first is."""
    names = ", ".join(f'"{heading}"' for heading, _ in counts[:3])
    more = f" and {len(counts) - 3} more columns" if len(counts) > 3 else ""
    total = sum(count for _, count in counts)
    cells = "1 cell holds no number (on" if total == 1 else f"{total} cells hold no number (first on"
    return f"{names}{more}: {cells} line {line}: {_shown(cell) or 'nothing'}); missing"


def _shown(text: str) -> str:
    plain = "".join(character if character.isprintable() else " " for character in text.strip())
    return f'"{plain[:SHOWN]}{"…" * (len(plain) > SHOWN)}"' if plain else ""


def _parts(pieces: Iterable[Piece], form: RowForm) -> Iterator[Part]:
    """Read pieces, several at the same time; they come in their order."""
    waiting: deque[Future[Part]] = deque()
    with ThreadPoolExecutor(threads()) as pool:
        for piece in pieces:
            waiting.append(pool.submit(_part, piece, form))
            if len(waiting) > threads():
                yield waiting.popleft().result()
        for part in waiting:
            yield part.result()


def _part(piece: Piece, form: RowForm) -> Part:
    """Read a piece: one row a line, the blank ones too, before those that are no samples are left out."""
    frame = _frame(piece.text, form)
    columns = [_values(frame[column], kind, form.dialect) for column, kind in enumerate(form.kinds)]
    absent = np.array([np.isnan(values) for values in columns])
    doubtful = _doubtful(frame, absent, form)
    numeric = [column for column, kind in enumerate(form.kinds) if kind in NUMERIC]
    lacking: Mask = np.logical_or.reduce(absent[numeric])
    lines = piece.text.split("\n") if (doubtful | lacking).any() else []
    left_out = np.zeros(len(frame), dtype=bool)
    faulty: list[Faulty] = []
    for number in np.flatnonzero(doubtful).tolist():
        fault = form.fault_of(lines[number], has_number=not absent[:, number].all())
        if fault is None:
            continue
        lacking[number] = False
        left_out[number] = fault in ("blank", "text")
        for values in columns:
            values[number] = np.nan
        if fault != "blank":
            faulty.append(Faulty(piece.line + number, lines[number], fault))
    gap = None
    if lacking.any():
        number = int(np.argmax(lacking))
        column = numeric[int(np.argmax(absent[numeric, number]))]
        gap = (piece.line + number, "".join(form.dialect.split(lines[number])[column : column + 1]))
    if left_out.any():
        columns = [values[~left_out] for values in columns]
    return Part(columns, faulty, piece.line + len(frame) - 1, gap)


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
        "names": range(form.width + form.trailing + 1),
        "index_col": False,
        "quoting": csv.QUOTE_NONE,
        "skip_blank_lines": False,
        "na_values": list(dialect.missing - MISSING),
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
    cells, most = form.dialect.split(line), form.width + form.trailing + 1
    return separator.join([UNREADABLE] * most if any(cells[most:]) else cells[:most])


def _doubtful(frame: pd.DataFrame, absent: NDArray[np.bool_], form: RowForm) -> Mask:
    """Rows that may have the wrong number of cells or be no samples at all."""
    # A row without any number lacks the first; text there says nothing of the others. A short row lacks the last.
    filled = [column for column, kind in enumerate(form.kinds) if kind != "empty"] or [0]
    doubtful: Mask = np.logical_and.reduce(absent)
    for column in (filled[0], filled[-1]):
        doubtful |= frame[column].isna().to_numpy() if form.kinds[column] == "text" else absent[column]
    for beyond in range(form.width, frame.shape[1]):
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
        return _ticks(cells)
    if cells.dtype.kind in "biuf":
        values = cells.to_numpy(dtype=np.float64, copy=True)  # a view would keep all columns of its piece
    else:
        values = np.fromiter(map(dialect.number, cells.to_list()), dtype=np.float64, count=len(cells))
    return values if np.isfinite(values).all() else np.where(np.isinf(values), np.nan, values)


DATED = r"\d+-\d+-\d+[T ]"
DOTTED = r"^(\d{1,2})\.(\d{1,2})\.(\d{4})"


def _ticks(cells: pd.Series) -> Array:
    """Microseconds of dates, `26.04.2013 10:15:00,125` among them, or of times of day; NaN without a timestamp."""
    import pandas as pd

    stamps = cells.astype("str").str.strip().str.strip('"').str.replace(",", ".", regex=False)
    stamps = stamps.str.replace(DOTTED, r"\3-\2-\1", regex=True).str.replace("/", "-", regex=False)
    if stamps.dropna().str.match(DATED).mean() > 0.5:
        moments = pd.to_datetime(stamps, format="ISO8601", errors="coerce", utc=True).dt.tz_localize(None)
        ticks = moments.to_numpy().astype("datetime64[us]")
    else:
        ticks = pd.to_timedelta(stamps, errors="coerce").to_numpy().astype("timedelta64[us]")
    return np.where(np.isnat(ticks), np.nan, ticks.astype(np.int64))
