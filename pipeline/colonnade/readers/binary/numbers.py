"""Numbers of a binary file as the values of channels: at a place of its bytes, or in structs and groups."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.arrays import Array
from colonnade.readers.format import Options
from colonnade.readers.recording import RecordedChannel, Recording, TimeUnit

Bytes = NDArray[np.uint8]


@dataclass(frozen=True)
class StoredNumbers:
    """
    Where a channel's numbers stand.

    Attributes
    ----------
    name : str
        Of the channel.
    form : str
        As numpy spells it, `<f8`.
    first : int
        Byte of the first number.
    count : int
    stride : int
        Bytes from one number to the next.
    offset, factor : float
        Value = number × factor + offset.
    end : int or None
        Byte behind the last one that may be the channel's; that of the file otherwise.
    """

    name: str
    form: str
    first: int
    count: int
    stride: int
    offset: float = 0.0
    factor: float = 1.0
    end: int | None = None


def values_at(content: Bytes, stored: StoredNumbers, file: str = "the file") -> tuple[Array, list[str]]:
    """
    Take a channel's numbers out of the bytes of a file, called `file` in a warning.

    Returns
    -------
    values : ndarray, shape (n,)
        As many as there are; NaN where one is missing.
    warnings : list of str
        Whether the bytes end too early.
    """
    form = np.dtype(stored.form)
    end = content.size if stored.end is None else stored.end
    room = (end - stored.first - form.itemsize) // stored.stride + 1
    there = max(min(stored.count, room), 0) if stored.first >= 0 else 0
    warnings = []
    if there < stored.count:
        warnings.append(f'"{stored.name}": {file} ends after {there} of its {stored.count} values')
    if not there:
        return np.empty(0), warnings
    raw = np.ndarray(there, form, content, offset=stored.first, strides=(stored.stride,))
    with np.errstate(invalid="ignore", over="ignore"):
        values = raw.astype(np.float64) * stored.factor + stored.offset
    values[~np.isfinite(values)] = np.nan
    return values, warnings


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
