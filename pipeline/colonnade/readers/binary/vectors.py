"""Channels in files that hold vectors in structs and groups, not columns of one table."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.readers.recording import RecordedChannel, Recording


class UnreadableError(Exception):
    """A part of a file that is whole, but not read; its text is the reason."""


@dataclass(frozen=True)
class Column:
    """
    One column of numbers.

    Attributes
    ----------
    path : str
        As it is reached in the file: `run.top`, `x[2]` (the second column of x).
    scope : tuple of str
        Structs or groups that contain it, outermost first.
    values : ndarray of numbers, shape (n,)
    name, unit : str or None
        If the file gives them with the numbers.
    """

    path: str
    scope: tuple[str, ...]
    values: NDArray[Any]
    name: str | None = None
    unit: str | None = None


def named(columns: list[Column]) -> list[Column]:
    """Name columns without a name by the last part of their path, or by all of it if another column has that part."""
    last = [column.name or column.path.rpartition(".")[2] for column in columns]
    counts = Counter(last)
    return [
        replace(column, name=short if counts[short] == 1 else column.path)
        for column, short in zip(columns, last, strict=True)
    ]


def recorded(path: Path, format: str, columns: list[Column]) -> tuple[Recording, list[str]]:
    """Make channels of columns that have names, in their order, with warnings of infinite values."""
    channels, warnings = [], []
    for column in columns:
        values, infinite = as_values(column.values)
        channels.append(RecordedChannel(column.name or column.path, column.unit, values, heading=column.path))
        warnings += [f"{column.path}: {infinite}"] if infinite else []
    return Recording(path, format, tuple(channels)), warnings


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
