"""The numbers of one channel within a binary file, as its header describes them."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times

Bytes = NDArray[np.uint8]
LONGEST_NAME = 80
"""Characters of another file's name that are shown."""


@dataclass(frozen=True)
class StoredNumbers:
    """
    Where a channel's numbers stand.

    Attributes
    ----------
    name, unit : str
        Of the channel; the unit is empty if the file does not give it.
    file : str
        Name of the file with the bytes, in the header's folder; empty for a channel that rises evenly and is not
        stored, and where the header's own file has them.
    form : str
        As numpy spells it, `<f8`.
    first : int
        Byte of the first number.
    count : int
    stride : int
        Bytes from one number to the next.
    offset, factor : float
        Value = number × factor + offset; of an even channel, the number is that of the row, from 0.
    step : float
        Time step, s; 0 where the channel has none of its own.
    begin : float
        Time of the first value, s, if there is a step.
    end : int or None
        Byte behind the last one that may be the channel's; that of the file otherwise.
    """

    name: str
    unit: str
    file: str
    form: str
    first: int
    count: int
    stride: int
    offset: float = 0.0
    factor: float = 1.0
    step: float = 0.0
    begin: float = 0.0
    end: int | None = None


def read_stored(header: Path, stored: StoredNumbers, *, longest: int) -> tuple[Array, list[str]]:
    """
    Read a channel's numbers.

    Parameters
    ----------
    header : Path
        The file that describes them; the bytes stand in a file of the same folder.
    stored : StoredNumbers
    longest : int
        Values of the longest channel that is stored; one that rises evenly has no more, whatever its header says.

    Returns
    -------
    values : ndarray, shape (n,)
        As many as there are; NaN where one is missing.
    warnings : list of str
        Whether the file ends too early.

    Raises
    ------
    ReadError
        If the file with the bytes is missing.
    """
    if not stored.file:
        return even_times(min(stored.count, longest), stored.factor, stored.offset), []
    path = beside(header, stored.file)
    content = np.memmap(path, dtype=np.uint8, mode="r") if path.stat().st_size else np.empty(0, dtype=np.uint8)
    return values_at(content, stored, path.name)


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


def name_beside(header: Path, name: str) -> str:
    """Name of the file of the header's folder that is meant, whatever its case; a path out of it is not followed."""
    bare = PureWindowsPath(name).name
    with suppress(OSError, ValueError):  # a damaged name may be too long for one, or none
        if bare and header.with_name(bare).is_file():
            return bare
    for entry in header.parent.iterdir():
        if entry.name.casefold() == bare.casefold() and entry.is_file():
            return entry.name
    return bare


def beside(header: Path, name: str) -> Path:
    """
    Find a file of the header's folder, whatever its case.

    Raises
    ------
    ReadError
        If it is missing; a path out of the folder is not followed.
    """
    bare = name_beside(header, name)
    with suppress(OSError, ValueError):
        if bare and header.with_name(bare).is_file():
            return header.with_name(bare)
    named = bare if len(bare) <= LONGEST_NAME else f"{bare[:LONGEST_NAME]}…"
    raise ReadError(
        f'{header.name}: its values are in the file "{named}", which is not in its folder. Copy that file next to it.'
    )
