"""MATLAB's format of versions 5 to 7: a chain of elements, read within their own bounds and nothing executed."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.matlab_tree import Node, Numbers, Tree, object_reason
from colonnade.readers.unpacking import swollen

HEADER = 128
MATRIX, COMPRESSED = 14, 15
NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
TEXTS = {1: "latin-1", 2: "utf-8", 4: "utf-16", 16: "utf-8", 17: "utf-16", 18: "utf-32"}
CELL, STRUCT, OBJECT, CHAR, SPARSE = 1, 2, 3, 4, 5
NUMERIC = range(6, 16)
FUNCTION, OPAQUE = 16, 17
COMPLEX = 0x08
MOST_PARTS = 100_000
"""Cells, or structs times fields, of one array; more are no recording."""
DEEPEST = 20
"""Levels of structs and cells in one another."""


class _DamagedError(Exception):
    """An element does not fit into the one that it is in."""


class _UnreadableError(Exception):
    """A variable that is whole, but no data."""


@dataclass(frozen=True)
class _Bytes:
    """Part of a file: its bytes and their order, `<` or `>`."""

    content: memoryview
    order: str


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
    tree = Tree()
    position, unpacked = HEADER, 0
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
        if end > len(content):
            name = _name_of_part(content[start:], order, kind)
            tree.warnings.append(
                f"it ends after {len(content)} of {end} bytes, within variable {name}: a copy or a recording was "
                "interrupted; that variable is not read"
            )
            break
        unpacked += _variable(tree, content[start:end], order, kind, len(content), unpacked)
        position = end
    return tree


def _variable(tree: Tree, content: memoryview, order: str, kind: int, packed: int, before: int) -> int:
    """
    Read a top-level element into the tree, or say there why it cannot be read.

    Returns
    -------
    unpacked : int
        Bytes that were unpacked for it; `before` of them were for those before, of the `packed` ones of the file.
    """
    name = _name_of_part(content, order, kind)
    unpacked = 0
    try:
        if kind == COMPRESSED:
            content = _unpacked(content, order, packed, before)
            unpacked = len(content)
        element = _matrix(_Bytes(content, order), tree.left_out, "", 0)
        if element is not None and element[0]:  # MATLAB's own data for its objects has no name
            tree.variables[element[0]] = element[1]
    except _UnreadableError as reason:
        tree.left_out[name] = str(reason)
    except (_DamagedError, zlib.error, struct.error, UnicodeError, ValueError) as error:
        tree.warnings.append(f"variable {name} is damaged and not read: {error}")
    return unpacked


def _unpacked(content: memoryview, order: str, packed: int, before: int) -> memoryview:
    """Unpack a compressed variable, as far as it says that it reaches and no further."""
    unpacker = zlib.decompressobj()
    start = unpacker.decompress(content, 8)
    if len(start) < 8:
        raise _DamagedError("its compressed content is empty")
    kind, size = struct.unpack(order + "II", start)
    if kind != MATRIX:
        raise _DamagedError(f"its compressed content is of type {kind}")
    if reason := swollen(before + size, packed):
        raise _UnreadableError(reason)
    unpacked = unpacker.decompress(unpacker.unconsumed_tail, size) if size else b""
    if len(unpacked) < size:
        raise _DamagedError(f"it unpacks to {len(unpacked)} of {size} bytes")
    unpacker.decompress(unpacker.unconsumed_tail, 1)  # goes through the check sum at its end
    return memoryview(unpacked)


def _elements(part: _Bytes) -> Iterator[tuple[int, memoryview]]:
    """Go through the elements of a matrix: type and content of each."""
    position, content = 0, part.content
    while position + 8 <= len(content):
        kind, size = struct.unpack(part.order + "II", content[position : position + 8])
        if kind >> 16:  # a small element: size and type in one word, content in the next
            kind, size = kind & 0xFFFF, kind >> 16
            if size > 4:
                raise _DamagedError(f"a small element of {size} bytes")
            yield kind, content[position + 4 : position + 4 + size]
            position += 8
            continue
        start = position + 8
        if start + size > len(content):
            raise _DamagedError(f"an element of {size} bytes where {len(content) - start} are left")
        yield kind, content[start : start + size]
        position = start + size + (-size % 8)


def _next(elements: Iterator[tuple[int, memoryview]], what: str) -> tuple[int, memoryview]:
    found = next(elements, None)
    if found is None:
        raise _DamagedError(f"its {what} is missing")
    return found


def _matrix(part: _Bytes, left_out: dict[str, str], above: str, depth: int) -> tuple[str, Node] | None:
    """
    Read a matrix: its name and content.

    Returns None where it is none of data; `left_out` then says why, by the path from the variable to it.
    """
    if depth > DEEPEST:
        raise _DamagedError(f"structs and cells in one another, more than {DEEPEST} levels")
    elements = _elements(part)
    flags = _integers(*_next(elements, "class"), part.order)
    if not flags:
        raise _DamagedError("its class is missing")
    array_class, is_complex = flags[0] & 0xFF, bool(flags[0] >> 8 & COMPLEX)
    if array_class == OPAQUE:  # name, kind of object system, class
        texts = [bytes(_next(elements, "class name")[1]).decode("latin-1") for _ in range(3)]
        if texts[0]:
            left_out[above + texts[0]] = object_reason(texts[2])
        return None
    shape = _integers(*_next(elements, "size"), part.order)
    name = bytes(_next(elements, "name")[1]).decode("utf-8").rstrip("\0")
    if any(size < 0 for size in shape) or len(shape) < 2:
        raise _DamagedError(f"its size is {shape}")
    path = above + name
    try:
        return name, _content(elements, array_class, is_complex, shape, part.order, left_out, path, depth)
    except _UnreadableError as reason:
        left_out[path] = str(reason)
        return None


def _content(
    elements: Iterator[tuple[int, memoryview]],
    array_class: int,
    is_complex: bool,
    shape: list[int],
    order: str,
    left_out: dict[str, str],
    path: str,
    depth: int,
) -> Node:
    count = math.prod(shape)
    if array_class in NUMERIC:
        if is_complex:
            raise _UnreadableError("it holds complex numbers")
        kind, content = _next(elements, "numbers")
        numbers = _array(kind, content, order)
        if numbers.size != count:
            raise _DamagedError(f"{numbers.size} numbers for an array of {' × '.join(map(str, shape))}")
        shaped: Numbers = numbers.reshape(shape, order="F")
        return shaped
    if array_class == CHAR:
        kind, content = _next(elements, "text")
        return _text(kind, content, order, shape)
    if array_class in (CELL, STRUCT, OBJECT):
        return _parts(elements, array_class, count, order, left_out, path, depth)
    raise _UnreadableError(
        {
            SPARSE: "it is a sparse matrix",
            FUNCTION: "it is a function, and nothing in a recording is executed",
        }.get(array_class, f"it is of class {array_class}, which is not MATLAB's")
    )


def _parts(
    elements: Iterator[tuple[int, memoryview]],
    array_class: int,
    count: int,
    order: str,
    left_out: dict[str, str],
    path: str,
    depth: int,
) -> Node:
    """Read the cells of a cell array or the fields of structs."""
    if array_class == OBJECT:
        class_name = bytes(_next(elements, "class name")[1]).decode("latin-1")
        raise _UnreadableError(object_reason(class_name))
    if array_class == CELL:
        _check_parts(count)
        places = [f"{path}{{{number}}}" for number in range(1, count + 1)]
        return [_inner(elements, order, left_out, place, depth) for place in places]
    width = _integers(*_next(elements, "field names' length"), order)
    names = bytes(_next(elements, "field names")[1])
    if not width or width[0] <= 0:
        raise _DamagedError("its fields have no names")
    fields = [
        names[start : start + width[0]].split(b"\0")[0].decode("latin-1") for start in range(0, len(names), width[0])
    ]
    _check_parts(count * max(len(fields), 1))
    structs = []
    for number in range(1, count + 1):
        place = path if count == 1 else f"{path}({number})"
        values = {field: _inner(elements, order, left_out, f"{place}.{field}", depth) for field in fields}
        structs.append({field: value for field, value in values.items() if value is not None})
    return structs[0] if count == 1 else structs


def _check_parts(count: int) -> None:
    if count > MOST_PARTS:
        raise _UnreadableError(f"it has {count} parts, more than the {MOST_PARTS} that are read")


def _inner(
    elements: Iterator[tuple[int, memoryview]], order: str, left_out: dict[str, str], place: str, depth: int
) -> Any:
    kind, content = _next(elements, "content")
    if kind != MATRIX:
        raise _DamagedError(f"a part of type {kind}")
    if not len(content):
        return np.empty((0, 0))
    found = _matrix(_Bytes(content, order), left_out, place, depth + 1)
    return None if found is None else found[1]


def _array(kind: int, content: memoryview, order: str) -> Any:
    if kind not in NUMBERS:
        raise _DamagedError(f"numbers of type {kind}")
    return np.frombuffer(content, dtype=np.dtype(order + NUMBERS[kind]))


def _integers(kind: int, content: memoryview, order: str) -> list[int]:
    if kind not in (5, 6):
        raise _DamagedError(f"integers of type {kind}")
    return [int(number) for number in _array(kind, content, order)]


def _text(kind: int, content: memoryview, order: str, shape: list[int]) -> str:
    """Read text; rows of a text of several are separated by line ends."""
    if kind not in TEXTS:
        raise _DamagedError(f"text of type {kind}")
    if len(shape) > 2 and math.prod(shape[2:]) != 1:
        raise _UnreadableError(f"it is a text of {len(shape)} dimensions; texts of one or several lines are read")
    encoding = TEXTS[kind] + ({"<": "-le", ">": "-be"}[order] if TEXTS[kind] in ("utf-16", "utf-32") else "")
    text = bytes(content).decode(encoding, errors="replace")
    rows = shape[0]
    if rows > max(len(text), 1):
        raise _DamagedError(f"{len(text)} characters for a text of {rows} lines")
    return text if rows <= 1 else "\n".join(text[row::rows].rstrip() for row in range(rows))


def _name_of_part(content: memoryview, order: str, kind: int) -> str:
    """Find the name of a variable that may not be whole; `?` where even that is lost."""
    try:
        if kind == COMPRESSED:
            content = memoryview(zlib.decompressobj().decompress(content[:-4], 4096))[8:]  # without the check sum
        elements = _elements(_Bytes(content, order))
        flags = _integers(*next(elements), order)
        if flags[0] & 0xFF != OPAQUE:
            next(elements)
        return bytes(next(elements)[1]).decode("utf-8") or "?"
    except (_DamagedError, zlib.error, struct.error, UnicodeError, StopIteration, IndexError):
        return "?"
