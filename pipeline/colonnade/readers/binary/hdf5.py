"""One walk through an HDF5 file, for NetCDF-4, MATLAB 7.3 and plain HDF5: hard links only, nothing of another file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.errors import ReadError
from colonnade.readers.binary.numbers import UnreadableError

if TYPE_CHECKING:
    import h5py

DEEPEST = 20
"""Levels of groups in one another."""
MOST_PARTS = 10_000
"""Groups, variables, fields and cells that are examined; a recording has fewer."""
DAMAGE = (OSError, KeyError, ValueError, TypeError, RuntimeError, UnicodeError, MemoryError)
"""What h5py raises for a damaged part of a file."""


def open_hdf5(path: Path) -> h5py.File:
    """
    Open an HDF5 file for reading.

    Raises
    ------
    ReadError
        If it was cut off, with the bytes it should have, or is damaged.
    """
    import h5py

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


class Walk:
    """
    A walk through the groups and datasets that lie in a file itself; what a dataset gives is up to those who inherit.

    Attributes
    ----------
    left_out : dict of str to str
        Path -> why it is not read.
    warnings : list of str
        Of parts that are damaged.
    """

    SEPARATOR = "/"

    def __init__(self) -> None:
        self.left_out: dict[str, str] = {}
        self.warnings: list[str] = []
        self._parts = 0

    def read(self, file: h5py.File) -> dict[str, Any]:
        """What the members of the file itself give, by name."""
        return self.members(file, "", (_address(file),))

    def members(self, group: h5py.Group, path: str, around: tuple[int, ...]) -> dict[str, Any]:
        """What the members of a group give, by name; `around` are the addresses of the groups that it lies in."""
        found = {}
        for name in self.names(group):
            place = f"{path}{self.SEPARATOR}{name}" if path else name
            value = self.guarded(place, self._member, group, name, place, around)
            if value is not None:
                found[name] = value
        return found

    def names(self, group: h5py.Group) -> list[str]:
        """Names of a group's members, in their order."""
        return list(group)[:MOST_PARTS]

    def item(self, item: Any, path: str, around: tuple[int, ...]) -> Any:
        """
        What a group or a dataset gives.

        Raises
        ------
        UnreadableError
            If it is neither, contains itself, or has its numbers elsewhere.
        """
        import h5py

        own = _address(item)
        self._parts += 1
        if own in around:
            raise UnreadableError("it contains itself")
        if len(around) > DEEPEST:
            raise UnreadableError(f"it lies in more than {DEEPEST} groups, structs or cells in one another")
        if self._parts > MOST_PARTS:
            raise UnreadableError(f"the file has more parts than the {MOST_PARTS} that are read")
        if isinstance(item, h5py.Group):
            return self.group(item, path, (*around, own))
        if not isinstance(item, h5py.Dataset):
            raise UnreadableError("it is not data")
        if item.external or item.is_virtual:
            raise UnreadableError("its numbers are in another file; only this file is read")
        if item.shape is None:
            raise UnreadableError("it holds nothing")
        return self.dataset(item, path, (*around, own))

    def group(self, group: h5py.Group, path: str, around: tuple[int, ...]) -> Any:
        """What a group gives."""
        return self.members(group, path, around)

    def dataset(self, dataset: h5py.Dataset, path: str, around: tuple[int, ...]) -> Any:
        """What a dataset gives; UnreadableError if it has no numbers."""
        raise NotImplementedError

    def _member(self, group: h5py.Group, name: str, path: str, around: tuple[int, ...]) -> Any:
        import h5py

        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise UnreadableError("it is a link to another place or file; only this file is read")
        return self.item(group[name], path, around)

    def guarded(self, path: str, read: Callable[..., Any], *arguments: Any) -> Any:
        """What a part gives; None if it is left out or damaged, which is noted."""
        try:
            return read(*arguments)
        except UnreadableError as reason:
            self.left_out[path] = str(reason)
        except DAMAGE as error:
            self.warnings.append(f"{path} is damaged, or cannot be unpacked here, and is not read: {error}")
        return None


def _address(item: h5py.Group | h5py.Dataset) -> int:
    """Where an object is in the file, by which one that holds itself is found."""
    import h5py

    return int(h5py.h5o.get_info(item.id).addr)
