"""Channels of files that hold vectors in structs and groups, not columns of one table."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.arrays import Array
from colonnade.readers.format import Options
from colonnade.readers.recording import RecordedChannel, Recording, TimeUnit


class UnreadableError(Exception):
    """A part of a file that is whole, but not read; its text is the reason."""


def recorded(path: Path, format: str, columns: list[RecordedChannel]) -> Recording:
    """
    Make a recording of columns of any numbers, with warnings of infinite values.

    A column without a name has the last part of its heading, or all of it if another column has that part.
    """
    last = [column.name or column.heading.rpartition(".")[2] for column in columns]
    counts = Counter(last)
    channels, warnings = [], []
    for column, short in zip(columns, last, strict=True):
        values, infinite = as_values(column.values)
        channels.append(replace(column, name=short if counts[short] == 1 else column.heading, values=values))
        warnings += [f"{column.heading}: {infinite}"] if infinite else []
    return Recording(path, format, tuple(channels), warnings=tuple(warnings))


def as_values(numbers: NDArray[Any]) -> tuple[Array, str]:
    """
    Take numbers as a channel's values.

    Parameters
    ----------
    numbers : ndarray, shape (n,)
        Booleans, integers or floats.

    Returns
    -------
    values : ndarray of float64, shape (n,)
        The array itself where it is one already and needs no change; NaN in place of infinities.
    warning : str
        How many infinities there were, such as "2 values are infinite, …"; empty if there are none.
    """
    values = np.ascontiguousarray(numbers, dtype=np.float64)
    with np.errstate(all="ignore"):
        if np.isfinite(values.sum()):  # one pass without a copy: the usual case
            return values, ""
    infinite = np.isinf(values)
    if not infinite.any():
        return values, ""
    count = int(infinite.sum())
    first = int(np.argmax(infinite)) + 1
    what = "1 value is" if count == 1 else f"{count} values are"
    return np.where(infinite, np.nan, values), f"{what} infinite, the first at sample {first}: taken as missing"


class ClockOptions(Options):
    """What can be said about a file of vectors."""

    time: str | int | None = Field(
        default=None, description="Channel, by name or number from 1, that is the clock of all that are as long as it."
    )
    time_unit: TimeUnit | None = Field(default=None, description="Unit of the times.")
