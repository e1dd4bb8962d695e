"""MATLAB's format of versions 5 to 7: SciPy reads each variable separately, so a damaged one does no harm."""

from __future__ import annotations

import struct
import warnings
import zlib
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.binary.matlab_columns import FUNCTION, Node, Tree, object_reason
from colonnade.readers.binary.numbers import UnreadableError

HEADER = 128
MATRIX, COMPRESSED = 14, 15
OPAQUE = 17
"""Class of an object whose form MathWorks does not publish."""


def read_v5(path: Path) -> Tree:
    """
    Read all variables of a MATLAB file of version 5 to 7.

    Raises
    ------
    ReadError
        If its header is not MATLAB's.
    """
    content = memoryview(path.read_bytes())
    order = {b"IM": "<", b"MI": ">"}.get(bytes(content[126:HEADER]))
    if order is None:
        raise ReadError(
            f'{path.name}: its bytes 127 and 128 should be "IM" or "MI" and are {bytes(content[126:HEADER])!r}: the '
            f"header is damaged, or the file ends within it ({len(content)} bytes). Copy it again."
        )
    tree = Tree()
    position = HEADER
    while position < len(content):
        if len(content) - position < 8:
            tree.warnings.append(f"it ends after {len(content)} bytes, within the start of a variable")
            break
        kind, size = struct.unpack(order + "II", content[position : position + 8])
        start, end = position + 8, position + 8 + size
        if kind not in (MATRIX, COMPRESSED):
            tree.warnings.append(
                f"at byte {position} of {len(content)} a variable was expected, an element of type {kind} was found: "
                "the file is damaged, what follows is not read"
            )
            break
        name = _name(content[start:end], order, kind)
        if end > len(content):
            tree.warnings.append(
                f"it ends after {len(content)} of {end} bytes, within variable {name}: a copy or a recording was "
                "interrupted; that variable is not read"
            )
            break
        try:
            value = _loaded(content, slice(position, end))
            if value is not None:
                tree.variables[name] = _node(value, name, tree.left_out)
        except UnreadableError as reason:
            tree.left_out[name] = str(reason)
        except (Exception, MemoryError) as error:
            tree.warnings.append(f"variable {name} is damaged and not read: {str(error) or 'too large for the memory'}")
        position = end
    return tree


def _name(content: memoryview, order: str, kind: int) -> str:
    """Find the name of a variable that may not be whole; `?` where even that is lost."""
    with suppress(zlib.error, struct.error, UnicodeError):
        if kind == COMPRESSED:
            content = memoryview(zlib.decompressobj().decompress(content[:-4], 4096))[8:]  # without the check sum
        # The class is in the first 16 bytes. Then comes the size, which an opaque object does not have, then the name.
        array_class, _, _, size = struct.unpack(order + "4I", content[8:24])
        place = 16 if array_class & 0xFF == OPAQUE else 24 + size + (-size % 8)
        first, length = struct.unpack(order + "2I", content[place : place + 8])
        is_short = first >> 16  # then its length, and the name is in place of the second word
        name = content[place + 4 :][:is_short] if is_short else content[place + 8 :][:length]
        return bytes(name).decode("utf-8") or "?"
    return "?"


def _loaded(content: memoryview, part: slice) -> Any:
    """Have SciPy read one variable; None for MATLAB's own data about its objects, which has no name."""
    from scipy.io import loadmat

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        variables = loadmat(BytesIO(b"".join((content[:HEADER], content[part]))), simplify_cells=True)
    return next((value for name, value in variables.items() if not name.startswith("__")), None)


def _node(value: Any, path: str, left_out: dict[str, str]) -> Node:
    """
    Take apart what SciPy has read.

    Raises
    ------
    UnreadableError
        If it is not data. A part that is not is left out with its reason, by the path from the variable to it.
    """
    if isinstance(value, dict):
        return _parts({name: (f"{path}.{name}", part) for name, part in value.items()}, left_out)
    if isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype.kind == "O"):
        parts = value if isinstance(value, list) else value.ravel(order="F").tolist()
        brackets = "()" if any(isinstance(part, dict) for part in parts) else "{}"
        numbered = {k: (f"{path}{brackets[0]}{k}{brackets[1]}", part) for k, part in enumerate(parts, 1)}
        return list(_parts(numbered, left_out).values())
    if reason := _refusal(value):
        raise UnreadableError(reason)
    value = np.asarray(value)
    if value.dtype.kind == "U":
        return "\n".join(text.rstrip() for text in value.ravel().tolist())
    numbers: Node = value
    return numbers


def _parts(parts: dict[Any, tuple[str, Any]], left_out: dict[str, str]) -> dict[Any, Node]:
    """Take cells or fields apart, each with its path; what is not data is left out."""
    nodes: dict[Any, Node] = {}
    for key, (path, part) in parts.items():
        try:
            nodes[key] = _node(part, path, left_out)
        except UnreadableError as reason:
            left_out[path] = str(reason)
    return nodes


def _refusal(value: Any) -> str:
    """Say why a variable is not data; empty if it is."""
    from scipy.io.matlab import MatlabFunction, MatlabObject, MatlabOpaque
    from scipy.sparse import issparse

    if issparse(value):
        return "it is a sparse matrix"
    if isinstance(value, MatlabFunction):
        return FUNCTION
    if isinstance(value, MatlabOpaque):
        return object_reason(value["s2"].item().decode("latin-1"))
    if isinstance(value, MatlabObject):
        return object_reason(value.classname)
    kind = np.asarray(value).dtype.kind
    if kind == "c":
        return "it holds complex numbers"
    if kind == "U" and np.ndim(value) > 1:
        return f"it is a text of {np.ndim(value) + 1} dimensions; texts of one or several lines are read"
    return "" if kind in "fiubU" else f"it is of kind {kind}, which is not read"
