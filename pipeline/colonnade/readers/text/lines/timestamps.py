"""Dates and times of day in text -> seconds since the first of them."""

from __future__ import annotations

import re
from contextlib import suppress
from datetime import datetime, timedelta, timezone
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

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
