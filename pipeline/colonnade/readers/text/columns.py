"""Columns whose cells are no plain numbers: dates and times of day, and marks between thousands."""

from __future__ import annotations

import re
from contextlib import suppress
from datetime import datetime, timedelta, timezone
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.readers.text.cells import MARKED, Dialect

if TYPE_CHECKING:
    import pandas as pd

DAY = 86400.0
DATED = r"\d+[-/.]\d+[-/.]\d+[T ]"
DOTTED = r"^(\d{1,2})\.(\d{1,2})\.(\d{4})"
ZONED = r"(?::\d{2}(?:\.\d+)?\s?)(Z|[+-]\d{2}:?\d{2})$"


class Timestamps:
    """
    A column of timestamps, read piece by piece.

    `2013-04-26T10:15:00.125`, with or without zone, `26.04.2013 10:15:00,125` (day first) and `10:15:00.125` are
    read, to a microsecond. Times of day go on after midnight.

    Attributes
    ----------
    start : datetime or None
        The first timestamp, in its own zone if it has one; None for times of day.
    """

    def __init__(self) -> None:
        self.start: datetime | None = None
        self._origin: int | None = None

    def seconds(self, texts: pd.Series) -> NDArray[np.float64]:
        """
        Read the next piece.

        Parameters
        ----------
        texts : Series of str, shape (n,)

        Returns
        -------
        seconds : ndarray, shape (n,)
            Since the first timestamp of the first piece, s; NaN without a timestamp.
        """
        import pandas as pd

        texts = texts.astype("str").str.strip().str.strip('"').str.replace(",", ".", regex=False)
        filled = texts.dropna()
        dated = bool(len(filled)) and filled.str.match(DATED).mean() > 0.5
        if dated:
            texts = texts.str.replace(DOTTED, r"\3-\2-\1", regex=True).str.replace("/", "-", regex=False)
            moments = pd.to_datetime(texts, format="ISO8601", errors="coerce", utc=True)
            ticks = moments.dt.tz_localize(None).to_numpy().astype("datetime64[us]")
        else:
            ticks = pd.to_timedelta(texts, errors="coerce").to_numpy().astype("timedelta64[us]")
        known = ~np.isnat(ticks)
        whole = ticks.astype(np.int64)
        if self._origin is None and known.any():
            first = int(np.argmax(known))
            self._origin = int(whole[first])
            if dated:
                moment = moments.iloc[first].to_pydatetime(warn=False)
                zone = re.search(ZONED, texts.iloc[first])
                self.start = _in_zone(moment, zone[1]) if zone else moment.replace(tzinfo=None)
        seconds = np.full(whole.shape, np.nan)
        seconds[known] = (whole[known] - (self._origin or 0)) / 1e6
        return seconds


def _in_zone(moment: datetime, zone: str) -> datetime:
    """Give an instant in the zone that is written, `Z`, `+02:00` or `-0330`; one that no clock has stays in UTC."""
    if zone == "Z":
        return moment
    offset = timedelta(hours=int(zone[1:3]), minutes=int(zone[-2:]))
    with suppress(ValueError, OverflowError):
        return moment.astimezone(timezone(-offset if zone[0] == "-" else offset))
    return moment


def past_midnight(seconds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Let times of day go on when the clock was set back by most of a day, as at midnight."""
    known = np.isfinite(seconds)
    steps = np.diff(seconds[known], prepend=seconds[known][:1])
    turned = seconds.copy()
    turned[known] += DAY * np.cumsum(steps < -DAY / 2)
    return turned


_WHOLE = re.compile(r"[+\-\N{MINUS SIGN}]?\d{1,3}", re.ASCII)
LARGE, THOUSAND = 100.0, 1000.0
"""A number without a mark between thousands is below the second; some above the first are on the way there."""
MANY = 50
"""Different numbers that have a mark, so many that decimals would differ in their number of digits."""


class Grouping:
    """
    What speaks for and against thousands that are marked in a column.

    All numbers from 1000 on have three digits after each mark, and those below have no mark. Decimals would have other
    numbers of digits, too, unless all have three.
    """

    def __init__(self, dialect: Dialect) -> None:
        self._dialect, self._signs = dialect, set[str]()
        self._has_small = self._has_large = self.is_refuted = False
        self._marked = 0

    @property
    def sign(self) -> str | None:
        """The mark; None if nothing speaks for one."""
        is_likely = self._has_small and (self._has_large or self._marked >= MANY) and not self.is_refuted
        return next(iter(self._signs)) if is_likely and len(self._signs) == 1 else None

    def look(self, cells: pd.Series, values: Array) -> None:
        """Look at further cells, unless it is refuted: as text, or as the numbers that they were read as."""
        if cells.dtype.kind in "biuf":
            self._look_at_numbers(np.abs(values[np.isfinite(values)]))
            return
        for cell in cells.dropna().unique():
            text = str(cell).strip().strip('"')
            if marked := MARKED.fullmatch(text):
                self._signs.add(marked[1])
                self._marked += 1
            elif _WHOLE.fullmatch(text):
                self._has_small = True
                self._has_large |= abs(self._dialect.number(text)) >= LARGE
            elif any(map(str.isdecimal, text)):
                self.is_refuted = True
                return

    def _look_at_numbers(self, sizes: Array) -> None:
        whole = sizes == np.rint(sizes)
        thousandths = np.unique(THOUSAND * sizes[~whole])
        far = (sizes >= THOUSAND).any() or (thousandths < THOUSAND).any()
        self.is_refuted = bool(far or (np.abs(thousandths - np.rint(thousandths)) > 1e-6).any())
        self._has_small |= bool(whole.any())
        self._has_large |= bool((sizes[whole] >= LARGE).any())
        self._marked += thousandths.size
        self._signs |= {self._dialect.decimal} if thousandths.size else set()
