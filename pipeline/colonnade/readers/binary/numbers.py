"""Numbers of a binary file as the values of channels: at a place of its bytes, in groups of HDF5, in structs."""

from __future__ import annotations

import zlib
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import ClockOptions, with_clocks
from colonnade.readers.recording import RecordedChannel, Recording

if TYPE_CHECKING:
    import h5py

Bytes = NDArray[np.uint8]
Key = TypeVar("Key")
MOST_COLUMNS = 1000
"""Of one matrix; a wider one does not hold channels."""


class UnreadableError(Exception):
    """A part of a file that is whole, but not read; its text is the reason."""


DAMAGE = (OSError, KeyError, ValueError, TypeError, RuntimeError, MemoryError, zlib.error)
"""What h5py and scipy raise for a part of a file that is damaged or too large."""


@dataclass
class Told:
    """What is said of a file: why parts are left out, by their paths, warnings of damaged ones, and notes."""

    left_out: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def guarded(self, path: str, read: Callable[..., Any], *arguments: Any) -> Any:
        """What a part gives; None if it is left out or damaged, which is noted."""
        try:
            return read(*arguments)
        except UnreadableError as reason:
            self.left_out[path] = str(reason)
        except DAMAGE as error:
            self.warnings.append(f"{path} is damaged and not read: {error}")
        return None

    def parts(self, read: Callable[[Any, str, Told], Any], parts: Mapping[Key, tuple[str, Any]]) -> dict[Key, Any]:
        """What parts give, each of which is there with its path, but for those that are left out or damaged."""
        read_parts = {key: self.guarded(path, read, part, path, self) for key, (path, part) in parts.items()}
        return {key: each for key, each in read_parts.items() if each is not None}


def columns_of(table: NDArray[Any]) -> dict[str, NDArray[Any]]:
    """Columns of a matrix by what is put behind its name, `[2]`, or a vector; UnreadableError for other tables."""
    if table.ndim == 1:
        return {"": table}
    if table.ndim > 2 or table.shape[1] > MOST_COLUMNS:
        size = " × ".join(map(str, table.shape))
        raise UnreadableError(f"an array of {size}; vectors, and matrices of up to {MOST_COLUMNS} channels, are read")
    return {f"[{number}]": column for number, column in enumerate(table.T, 1)}


def member(group: h5py.Group, name: str) -> h5py.Group | h5py.Dataset:
    """Open a member of a group; UnreadableError for what netCDF4 and h5py would follow into other files."""
    import h5py

    item = group[name] if isinstance(group.get(name, getlink=True), h5py.HardLink) else None
    is_own = isinstance(item, h5py.Dataset) and not (item.external or item.is_virtual or item.shape is None)
    if not (is_own or isinstance(item, h5py.Group)):
        raise UnreadableError(
            "it holds nothing, or is a link, or its numbers are in another file; only this one is read"
        )
    return item


def numbers_at(
    content: Bytes,
    name: str,
    form: str,
    first: int,
    count: int,
    warnings: list[str],
    *,
    stride: int = 0,
    scale: tuple[float, float] = (0.0, 1.0),
    file: str = "the file",
) -> Array:
    """
    Take a channel's numbers out of the bytes of a file; that some are missing is warned of.

    `count` numbers of a numpy `form` begin at the byte `first`, one every `stride` bytes, by default without gaps. A
    value is offset + number × factor, by the `scale`, NaN where that is infinite. As many are given as there are.
    """
    kind = np.dtype(form)
    stride = stride or kind.itemsize
    room = (content.size - first - kind.itemsize) // stride + 1
    there = max(min(count, room), 0) if first >= 0 else 0
    if there < count:
        warnings.append(f'"{name}": {file} ends after {there} of its {count} values')
    if not there:
        return np.empty(0)
    raw = np.ndarray(there, kind, content, offset=first, strides=(stride,))
    with np.errstate(invalid="ignore", over="ignore"):
        values = raw.astype(np.float64) * scale[1] + scale[0]
    values[~np.isfinite(values)] = np.nan
    return values


def recorded(
    path: Path,
    format: str,
    columns: Sequence[RecordedChannel],
    told: Told,
    options: ClockOptions,
    scalars: Mapping[str, float] | None = None,
    yielding: Collection[int] = (),
) -> Recording:
    """
    Make a recording of columns of any numbers, on the clocks that they have or that are found, with what is said.

    A column without a name has the last part of its heading, or all of it if another column has that part. Infinite
    values are missing.

    Raises
    ------
    ReadError
        If there is no column, with all that is said.
    """
    left_out = [f"{place} is left out: {why}" for place, why in told.left_out.items()]
    if not columns:
        raise ReadError("\n  ".join([f"{path.name}: no column of numbers in it.", *told.warnings, *left_out]))
    last = [column.name or column.heading.rpartition(".")[2] for column in columns]
    counts = Counter(last)
    channels = []
    for column, short in zip(columns, last, strict=True):
        values = np.ascontiguousarray(column.values, dtype=np.float64)
        if np.isinf(values).any():
            values = np.where(np.isinf(values), np.nan, values)
        channels.append(replace(column, name=short if counts[short] == 1 else column.heading, values=values))
    recording = Recording(path, format, tuple(channels), warnings=tuple(told.warnings))
    found = with_clocks(recording, options.time, options.time_unit, scalars, yielding)
    return replace(found, notes=(*told.notes, *found.notes, *left_out))
