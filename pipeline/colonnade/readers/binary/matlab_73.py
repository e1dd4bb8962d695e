"""MATLAB's format of version 7.3: HDF5 with MATLAB's classes as attributes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.readers.binary.hdf5 import MOST_PARTS, Walk, open_hdf5
from colonnade.readers.binary.matlab_columns import FUNCTION, Node, Numbers, Tree, object_reason
from colonnade.readers.binary.numbers import UnreadableError

if TYPE_CHECKING:
    import h5py

NUMERIC = frozenset(
    ("double", "single", "logical", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)))
)


def read_v73(path: Path) -> Tree:
    """
    Read all variables of a MATLAB file of version 7.3.

    Raises
    ------
    ReadError
        If it was cut off or is damaged.
    """
    with open_hdf5(path) as file:
        walk = _Variables(file)
        return Tree(walk.read(file), walk.left_out, walk.warnings)


class _Variables(Walk):
    """Variables as nodes."""

    SEPARATOR = "."

    def __init__(self, file: h5py.File) -> None:
        super().__init__()
        self._file = file

    def names(self, group: h5py.Group) -> list[str]:
        """Names of variables or fields, in MATLAB's order if the file keeps it, without those of MATLAB's own."""
        ordered = group.attrs.get("MATLAB_fields", ())
        told = [b"".join(np.asarray(each).tolist()).decode("latin-1") for each in ordered]
        return [name for name in told if name in group] or [name for name in super().names(group) if name[:1] != "#"]

    def item(self, item: Any, path: str, around: tuple[int, ...]) -> Any:
        """Refuse what only MATLAB can open."""
        matlab_class = _class(item)
        if "MATLAB_object_decode" in item.attrs:
            raise UnreadableError(object_reason(matlab_class or "?"))
        if matlab_class == "function_handle":
            raise UnreadableError(FUNCTION)
        return super().item(item, path, around)

    def group(self, group: h5py.Group, path: str, around: tuple[int, ...]) -> Node:
        """Read a struct, or an array of structs: then each field is a list of references, one an element."""
        if "MATLAB_sparse" in group.attrs:
            raise UnreadableError("it is a sparse matrix")
        fields = self.members(group, path, around)
        lists = {name: value for name, value in fields.items() if isinstance(value, list) and not _class(group[name])}
        if not lists:
            return fields
        count = max(map(len, lists.values()))
        return [{name: value[k] for name, value in lists.items() if k < len(value)} for k in range(count)]

    def dataset(self, dataset: h5py.Dataset, path: str, around: tuple[int, ...]) -> Node:
        """Read numbers, text or cells."""
        matlab_class = _class(dataset)
        if dataset.attrs.get("MATLAB_empty", 0):
            return "" if matlab_class == "char" else np.empty((0, 0))
        if dataset.dtype.kind == "O":
            return self._cells(dataset, path, around)
        if dataset.dtype.kind not in "fiub":
            is_complex = dataset.dtype.names == ("real", "imag")
            raise UnreadableError("it holds complex numbers" if is_complex else "it holds no numbers")
        if matlab_class and matlab_class not in NUMERIC | {"char"}:
            raise UnreadableError(object_reason(matlab_class))
        numbers = np.atleast_2d(dataset[()].T)
        return _text(numbers) if matlab_class == "char" else numbers

    def _cells(self, dataset: h5py.Dataset, path: str, around: tuple[int, ...]) -> Node:
        """Read a cell array, or a field of an array of structs: references to elsewhere in the file."""
        import h5py

        if h5py.check_ref_dtype(dataset.dtype) is not h5py.Reference:
            raise UnreadableError("it holds no numbers")
        if dataset.size > MOST_PARTS:
            raise UnreadableError(f"it has {dataset.size} parts, more than the {MOST_PARTS} that are read")
        cells: list[Any] = []
        for number, reference in enumerate(dataset[()].ravel().tolist(), 1):
            place = f"{path}{{{number}}}"
            cells.append(self.guarded(place, self._referred, reference, place, around))
        return [cell for cell in cells if cell is not None]

    def _referred(self, reference: h5py.Reference, path: str, around: tuple[int, ...]) -> Node:
        node: Node = self.item(self._file[reference], path, around)
        return node


def _class(item: Any) -> str:
    told = item.attrs.get("MATLAB_class", b"")
    return told.decode("latin-1") if isinstance(told, bytes) else str(told)


def _text(codes: Numbers) -> str:
    """Text of a matrix of characters' codes; its rows are lines."""
    if codes.ndim > 2:
        raise UnreadableError(f"it is a text of {codes.ndim} dimensions; texts of one or several lines are read")
    return "\n".join("".join(chr(code) for code in row if 0 < code < 0x110000).rstrip() for row in codes.tolist())
