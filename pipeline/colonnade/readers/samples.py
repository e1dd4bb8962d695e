"""The samples of a text file: numbers as fast as pandas reads them, everything that is not a number told."""

from __future__ import annotations

import csv
import warnings
from collections import deque
from collections.abc import Generator, Iterable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.errors import ReadError
from colonnade.readers.body import Body, Piece
from colonnade.readers.cells import WHITESPACE, Dialect
from colonnade.readers.timestamps import Timestamps
from colonnade.signals.parallel import side_by_side, threads

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]


@dataclass
class Samples:
    """
    Columns of numbers, with the rows that deserve a look.

    Attributes
    ----------
    columns : list of ndarray, shape (n,)
        NaN where there is no number; seconds from the first for columns of timestamps.
    doubtful : ndarray of int
        Rows, from 0, that may have the wrong number of cells or may be no samples at all.
    start : datetime or None
        Of the first timestamp that has a date.
    skipped : int
        Rows of the file before the first of these.
    reaches_end : bool
        Whether the file's last row is among them.
    """

    columns: list[Array]
    doubtful: NDArray[np.int64]
    start: datetime | None = None
    skipped: int = 0
    reaches_end: bool = True


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

    def place(self, frame: pd.DataFrame, before: int, dialect: Dialect) -> int:
        """Say whether a piece, with `before` rows in front, lies wholly ahead of it (-1) or behind it (1); else 0."""
        if self.column is None:
            first, last = float(before), float(before + len(frame) - 1)
        else:
            times = numbers_of(frame[self.column], dialect)
            if np.isnan(times).all():
                return 0
            first, last = float(np.nanmin(times)), float(np.nanmax(times))
        return -1 if last < self.low else 1 if first > self.high else 0


@dataclass
class _Pieces:
    """What has been read so far; a column's pieces are joined one column at a time, so that little is held twice."""

    columns: list[list[Array]]
    doubtful: list[NDArray[np.int64]] = field(default_factory=list)
    rows: int = 0


def read_samples(
    path: Path,
    dialect: Dialect,
    first: int,
    kinds: Sequence[str],
    trailing: int,
    missing: Sequence[str],
    stretch: Stretch | None = None,
) -> Samples:
    """
    Read the rows from the line of the first sample on.

    Parameters
    ----------
    path : Path
    dialect : Dialect
    first : int
        Index of the line of the first sample, from 0.
    kinds : sequence of str
        What each column holds: "number", "time", "text" or "empty".
    trailing : int
        Empty cells after these columns on every line.
    missing : sequence of str
        Further texts that stand for a missing value, numbers such as "-999" among them.
    stretch : Stretch, optional
        Rows that are wanted; some before and after them come along. Default: all.

    Raises
    ------
    ReadError
        If the text cannot be cut into rows and cells.
    """
    from pandas.errors import ParserError, ParserWarning

    widest = len(kinds) + trailing + 1
    try:
        # A quotation mark may hide the line end, so with these each line is looked at.
        return _read(path, dialect, first, kinds, trailing, missing, stretch, widest if dialect.quoted else None)
    except (ParserError, ParserWarning):
        # Some line has more cells than pandas was told of.
        pass
    try:
        return _read(path, dialect, first, kinds, trailing, missing, stretch, widest)
    except (ParserError, ParserWarning) as error:
        raise ReadError(
            f"{path.name}: the lines from {first + 1} on cannot be cut into cells ({str(error).strip()}). "
            "Look there for lines unlike the others."
        ) from error


def _read(
    path: Path,
    dialect: Dialect,
    first: int,
    kinds: Sequence[str],
    trailing: int,
    missing: Sequence[str],
    stretch: Stretch | None,
    widest: int | None,
) -> Samples:
    from pandas.errors import ParserWarning

    width = len(kinds) + trailing
    options: dict[str, Any] = {
        "decimal": dialect.decimal,
        "header": None,
        # One column more than there should be: what ends up in it shows rows with too many cells.
        "names": range(width + 1),
        "index_col": False,
        "quoting": csv.QUOTE_NONE,
        "skipinitialspace": dialect.padded,  # costs a quarter of the speed
        "na_values": list(missing),
        "low_memory": False,
    }
    pieces = _Pieces([[] for _ in kinds])
    clocks = {column: Timestamps() for column, kind in enumerate(kinds) if kind == "time"}
    with warnings.catch_warnings(), Body(path, dialect, first, widest) as body:
        warnings.simplefilter("error", ParserWarning)  # pandas only warns where it drops cells
        options["sep"] = r"\s+" if body.separator == WHITESPACE else body.separator
        with closing(_frames(body.pieces(), options)) as frames:
            skipped, reaches_end = 0, True
            for frame in frames:
                place = 0 if stretch is None else stretch.place(frame, skipped + pieces.rows, dialect)
                if place < 0 and not pieces.rows:
                    skipped += len(frame)
                    continue
                if place > 0 and pieces.rows:
                    reaches_end = False
                    break
                _take(frame, pieces, clocks, dialect, kinds)
    if not pieces.rows:
        raise ReadError(
            f"{path.name}: none of its {skipped} samples lies within the test's window. Look at the file's times and "
            "at the test's `window`, which counts from the file's own zero."
        )
    columns = side_by_side(_joined, pieces.columns)
    starts = [clock.start for clock in clocks.values() if clock.start is not None]
    return Samples(columns, np.concatenate(pieces.doubtful), starts[0] if starts else None, skipped, reaches_end)


def _frames(texts: Iterable[str], options: dict[str, Any]) -> Generator[pd.DataFrame, None, None]:
    """Cut pieces of text into cells, several at the same time; they come in their order."""
    import pandas as pd

    waiting: deque[Future[pd.DataFrame]] = deque()
    with ThreadPoolExecutor(threads()) as pool:
        for text in texts:
            waiting.append(pool.submit(lambda text: pd.read_csv(Piece(text), **options), text))
            if len(waiting) > threads():
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()


def _joined(pieces: list[Array]) -> Array:
    """One array in place of its pieces."""
    whole = np.concatenate(pieces)
    pieces.clear()
    return whole


def _take(
    frame: pd.DataFrame,
    pieces: _Pieces,
    clocks: dict[int, Timestamps],
    dialect: Dialect,
    kinds: Sequence[str],
) -> None:
    """Add a piece of the table to the columns."""
    doubtful = np.zeros(len(frame), dtype=bool)
    for beyond in range(len(kinds), frame.shape[1]):
        doubtful |= frame[beyond].notna().to_numpy()
    nothing = np.ones(len(frame), dtype=bool)
    # A short row has nothing in the last column that ever holds something.
    outer = {0, max((column for column, kind in enumerate(kinds) if kind != "empty"), default=0)}
    for column, kind in enumerate(kinds):
        series = frame[column]
        values = clocks[column].seconds(series) if kind == "time" else numbers_of(series, dialect)
        absent = np.isnan(values)
        nothing &= absent
        if column in outer:
            doubtful = doubtful | (series.isna().to_numpy() if kind == "text" else absent)
        pieces.columns[column].append(values)
    pieces.doubtful.append(np.flatnonzero(doubtful | nothing) + pieces.rows)
    pieces.rows += len(frame)


def numbers_of(series: pd.Series, dialect: Dialect) -> Array:
    """Values of a column: what pandas has read as numbers, else each cell by itself."""
    if series.dtype.kind in "biuf":
        values = series.to_numpy(dtype=np.float64)
    else:
        values = np.fromiter(map(dialect.number, series.to_list()), dtype=np.float64, count=len(series))
    infinite = np.isinf(values)
    return np.where(infinite, np.nan, values) if infinite.any() else values
