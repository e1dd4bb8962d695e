"""Opening HDF5, also for MATLAB 7.3 and NetCDF-4, with plain messages for incomplete files."""

from __future__ import annotations

import mmap
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.errors import ReadError
from colonnade.readers.binary.unpacking import UnreadableError

if TYPE_CHECKING:
    import h5py

DEEPEST = 20
"""Levels of groups in one another."""
MOST_PARTS = 10_000
"""Groups, variables, fields and cells that are examined; a recording has fewer."""
DAMAGE = (OSError, KeyError, ValueError, TypeError, RuntimeError, UnicodeError, MemoryError)
"""What h5py raises for a damaged part of a file."""
HEAP = b"GCOL\x01\0\0\0"
"""Mark, version and three zeros with which HDF5 begins a heap."""


def open_hdf5(path: Path) -> h5py.File:
    """
    Open an HDF5 file for reading.

    Raises
    ------
    ReadError
        If it was cut off, with the bytes it should have, or is damaged.
    """
    import h5py

    if (place := _broken_heap(path)) is not None:
        raise ReadError(f"{path.name}: its table of texts at byte {place} is damaged. Copy the file again.")
    try:
        return h5py.File(path, "r")
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        if isinstance(error, OSError) and error.errno is not None and not path.is_file():
            raise
        size, words = path.stat().st_size, str(error)
        _, found, after = words.partition("stored_eof = ")
        declared = after[: len(after) - len(after.lstrip("0123456789"))]
        if found and declared and int(declared) > size:
            raise ReadError(
                f"{path.name}: it ends after {size} of {declared} bytes: a copy or a recording was interrupted, and "
                "HDF5 does not open such a file. Copy it again."
            ) from error
        raise ReadError(f"{path.name}: HDF5 does not open it ({words}): the file is damaged. Copy it again.") from error


def _broken_heap(path: Path) -> int | None:
    """
    Find a heap of texts and references whose objects do not lie in one another's order; None if all do.

    HDF5 itself does not come to an end with one whose free space has no size.
    """
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as content:
        place = content.find(HEAP)
        while place >= 0:
            size = struct.unpack("<Q", content[place + 8 : place + 16].ljust(8, b"\0"))[0]
            position, end = place + 16, place + size
            while end <= len(content) and position + 16 <= end:
                index, _, _, length = struct.unpack("<HHIQ", content[position : position + 16])
                step = length if index == 0 else 16 + length + (-length % 8)
                if step < 16 or position + step > end:
                    return place
                position += step
            place = content.find(HEAP, place + 8)
    return None


def member(group: h5py.Group, name: str) -> Any:
    """Take what a group holds under a name; UnreadableError for a link, as only the file itself is read."""
    import h5py

    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise UnreadableError("it is a link to another place or file; only this file is read")
    return group[name]


def expect_numbers_here(dataset: h5py.Dataset) -> None:
    """Raise UnreadableError if a dataset's numbers are taken from another file, or it has none."""
    if dataset.external or dataset.is_virtual:
        raise UnreadableError("its numbers are in another file; only this file is read")
    if dataset.shape is None:
        raise UnreadableError("it holds nothing")


def address(item: h5py.Group | h5py.Dataset) -> int:
    """Where an object is in the file, by which one that holds itself is found."""
    import h5py

    return int(h5py.h5o.get_info(item.id).addr)
