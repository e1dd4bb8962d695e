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
from colonnade.readers.binary.unpacking import Unpacking, UnreadableError
from colonnade.readers.matlab.tree import Node, Tree, object_reason

HEADER = 128
MATRIX, COMPRESSED = 14, 15
OPAQUE = 17
"""Class of an object whose form MathWorks does not publish."""
MOST_PARTS = 100_000
"""Cells, or structs times fields, of one array; a recording has fewer."""


def read_v5(path: Path) -> Tree:
    """
    Read all variables of a MATLAB file of version 5 to 7.

    Raises
    ------
    ReadError
        If its header is not MATLAB's.
    """
    content = memoryview(path.read_bytes())
    orders = {b"IM": "<", b"MI": ">"}
    order = orders.get(bytes(content[126:HEADER]))
    if order is None:
        raise ReadError(
            f'{path.name}: its bytes 127 and 128 should be "IM" or "MI" and are {bytes(content[126:HEADER])!r}: the '
            f"header is damaged, or the file ends within it ({len(content)} bytes). Copy it again."
        )
    tree, unpacking = Tree(), Unpacking(len(content))
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
            matrix = content[start:end]
            if kind == COMPRESSED:
                matrix = _unpacked(matrix, order, unpacking)
            value = _loaded(content[:HEADER], matrix, order)
            if value is not None:
                tree.variables[name] = _node(value, name, tree.left_out)
        except UnreadableError as reason:
            tree.left_out[name] = str(reason)
        except MemoryError:
            tree.left_out[name] = "it needs more memory than a file of its size explains"
        except Exception as error:
            tree.warnings.append(f"variable {name} is damaged and not read: {error}")
        position = end
    return tree


def _unpacked(content: memoryview, order: str, unpacking: Unpacking) -> memoryview:
    """Unpack a compressed variable, as far as it says that it reaches and no further."""
    unpacker = zlib.decompressobj()
    start = unpacker.decompress(content, 8)
    if len(start) < 8:
        raise ValueError("its compressed content is empty")
    kind, size = struct.unpack(order + "II", start)
    if kind != MATRIX:
        raise ValueError(f"its compressed content is of type {kind}")
    unpacking.take(size)
    unpacked = unpacker.decompress(unpacker.unconsumed_tail, size) if size else b""
    if len(unpacked) < size:
        raise ValueError(f"it unpacks to {len(unpacked)} of {size} bytes")
    unpacker.decompress(unpacker.unconsumed_tail, 1)  # goes through the check sum at its end
    return memoryview(unpacked)


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


def _loaded(header: memoryview, matrix: memoryview, order: str) -> Any:
    """Have SciPy read one variable; None for MATLAB's own data about its objects, which has no name."""
    from scipy.io import loadmat

    stream = BytesIO(b"".join((header, struct.pack(order + "II", MATRIX, len(matrix)), matrix)))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        variables = loadmat(stream)
    return next((value for name, value in variables.items() if not name.startswith("__")), None)


def _node(value: Any, path: str, left_out: dict[str, str]) -> Node:
    """
    Take apart what SciPy has read.

    Raises
    ------
    UnreadableError
        If it is not data. A part that is not is left out with its reason, by the path from the variable to it.
    """
    if reason := _refusal(value):
        raise UnreadableError(reason)
    if value.dtype.kind == "U":
        return "\n".join(text.rstrip() for text in value.ravel().tolist())
    if value.dtype.kind in "fiub":
        numbers: Node = value
        return numbers
    parts = value.ravel(order="F")
    fields = parts.dtype.names
    if len(parts) * len(fields or (0,)) > MOST_PARTS:
        raise UnreadableError(f"it has {len(parts)} parts, more than the {MOST_PARTS} that are read")
    if fields is None:
        return [_part(cell, f"{path}{{{number}}}", left_out) for number, cell in enumerate(parts, 1)]
    structs = []
    for number, each in enumerate(parts, 1):
        place = path if len(parts) == 1 else f"{path}({number})"
        values = {field: _part(each[field], f"{place}.{field}", left_out) for field in fields}
        structs.append({field: node for field, node in values.items() if node is not None})
    return structs[0] if len(structs) == 1 else structs


def _part(value: Any, path: str, left_out: dict[str, str]) -> Any:
    """A cell or a field; None if it is not data."""
    try:
        return np.empty((0, 0)) if value is None else _node(value, path, left_out)
    except UnreadableError as reason:
        left_out[path] = str(reason)
        return None


def _refusal(value: Any) -> str:
    """Say why a variable is not data; empty if it is."""
    from scipy.io.matlab import MatlabFunction, MatlabObject, MatlabOpaque
    from scipy.sparse import issparse

    if issparse(value):
        return "it is a sparse matrix"
    if isinstance(value, MatlabFunction):
        return "it is a function; nothing in a recording is executed"
    if isinstance(value, MatlabOpaque):
        return object_reason(value["s2"].item().decode("latin-1"))
    if isinstance(value, MatlabObject):
        return object_reason(value.classname)
    if value.dtype.kind == "c":
        return "it holds complex numbers"
    if value.dtype.kind == "U" and value.ndim > 1:
        return f"it is a text of {value.ndim + 1} dimensions; texts of one or several lines are read"
    return "" if value.dtype.kind in "fiubUOV" else f"it is of kind {value.dtype.kind}, which is not read"
