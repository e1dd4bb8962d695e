"""MATLAB's format of version 7.3: HDF5 with MATLAB's classes as attributes; only the file itself is read, no links."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.readers.binary.unpacking import Unpacking, UnreadableError
from colonnade.readers.hdf5 import opening
from colonnade.readers.matlab.tree import Node, Numbers, Tree, object_reason

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
    tree = Tree()
    with opening.open_hdf5(path) as file:
        reader = _Reader(file, tree, path.stat().st_size)
        for name in file:
            if not name.startswith("#"):  # "#refs#" and "#subsystem#" are MATLAB's own
                reader.variable(name)
    return tree


class _Reader:
    """Reads one file; the tree also lists what is left out and what is damaged."""

    def __init__(self, file: h5py.File, tree: Tree, size: int) -> None:
        self._file = file
        self._tree = tree
        self._unpacking = Unpacking(size)
        self._parts = 0
        self._above: set[int] = set()  # addresses of the structs and cells that are being read

    def variable(self, name: str) -> None:
        """Read a variable into the tree."""
        node = self._child(self._file, name, name, 0)
        if node is not None:
            self._tree.variables[name] = node

    def _child(self, parent: h5py.Group, name: str, path: str, depth: int) -> Node | None:
        """Read what a group holds under a name."""
        try:
            return self._node(opening.member(parent, name), path, depth)
        except UnreadableError as reason:
            self._tree.left_out[path] = str(reason)
        except opening.DAMAGE as error:
            self._tree.warnings.append(f"variable {path} is damaged and not read: {error}")
        return None

    def _node(self, item: Any, path: str, depth: int) -> Node:
        import h5py

        if depth > opening.DEEPEST:
            raise UnreadableError(f"it holds structs and cells in one another, more than {opening.DEEPEST} levels")
        self._parts += 1
        if self._parts > opening.MOST_PARTS:
            raise UnreadableError(f"the file has more parts than the {opening.MOST_PARTS} that are read")
        matlab_class = item.attrs.get("MATLAB_class", b"")
        matlab_class = matlab_class.decode("latin-1") if isinstance(matlab_class, bytes) else str(matlab_class)
        if "MATLAB_object_decode" in item.attrs:
            raise UnreadableError(object_reason(matlab_class or "?"))
        if matlab_class == "function_handle":
            raise UnreadableError("it is a function; nothing in a recording is executed")
        own = opening.address(item)
        if own in self._above:
            raise UnreadableError("it contains itself")
        self._above.add(own)
        try:
            if isinstance(item, h5py.Group):
                return self._group(item, path, depth)
            if isinstance(item, h5py.Dataset):
                return self._dataset(item, matlab_class, path, depth)
        finally:
            self._above.remove(own)
        raise UnreadableError("it is not data")

    def _group(self, group: h5py.Group, path: str, depth: int) -> Node:
        """Read a struct, or an array of structs: then each field is a list of references, one an element."""
        if "MATLAB_sparse" in group.attrs:
            raise UnreadableError("it is a sparse matrix")
        fields = {}
        names = self._field_names(group)
        for name in names:
            value = self._child(group, name, f"{path}.{name}", depth + 1)
            if value is not None:
                fields[name] = value
        if not any(
            isinstance(value, list) and "MATLAB_class" not in group[name].attrs for name, value in fields.items()
        ):
            return fields
        count = max(len(value) for value in fields.values() if isinstance(value, list))
        return [
            {name: value[number] for name, value in fields.items() if isinstance(value, list) and number < len(value)}
            for number in range(count)
        ]

    @staticmethod
    def _field_names(group: h5py.Group) -> list[str]:
        """Names of fields, in MATLAB's order if the file keeps it."""
        ordered = group.attrs.get("MATLAB_fields")
        if ordered is None:
            return list(group)
        names = [b"".join(np.asarray(each).tolist()).decode("latin-1") for each in ordered]
        return [name for name in names if name in group] or list(group)

    def _dataset(self, dataset: h5py.Dataset, matlab_class: str, path: str, depth: int) -> Node:
        opening.expect_numbers_here(dataset)
        if dataset.attrs.get("MATLAB_empty", 0):
            return "" if matlab_class == "char" else np.empty((0, 0))
        if dataset.dtype.kind == "O":
            return self._cells(dataset, path, depth)
        if dataset.dtype.kind not in "fiub":
            is_complex = dataset.dtype.names == ("real", "imag")
            raise UnreadableError("it holds complex numbers" if is_complex else "it holds no numbers")
        if matlab_class and matlab_class not in NUMERIC | {"char"}:
            raise UnreadableError(object_reason(matlab_class))
        self._unpacking.take(dataset.nbytes)
        numbers = np.atleast_2d(dataset[()].T)
        return _text(numbers) if matlab_class == "char" else numbers

    def _cells(self, dataset: h5py.Dataset, path: str, depth: int) -> Node:
        """Read a cell array, or a field of an array of structs: references to elsewhere in the file."""
        import h5py

        if h5py.check_ref_dtype(dataset.dtype) is not h5py.Reference:
            raise UnreadableError("it holds no numbers")
        if dataset.size > opening.MOST_PARTS:
            raise UnreadableError(f"it has {dataset.size} parts, more than the {opening.MOST_PARTS} that are read")
        cells: list[Any] = []
        for number, reference in enumerate(dataset[()].ravel().tolist(), 1):
            place = f"{path}{{{number}}}"
            try:
                cells.append(self._node(self._file[reference], place, depth + 1))
            except UnreadableError as reason:
                self._tree.left_out[place] = str(reason)
        return cells


def _text(codes: Numbers) -> str:
    """Text of a matrix of characters' codes; its rows are lines."""
    if codes.ndim > 2:
        raise UnreadableError(f"it is a text of {codes.ndim} dimensions; texts of one or several lines are read")
    return "\n".join("".join(chr(code) for code in row if 0 < code < 0x110000).rstrip() for row in codes.tolist())
