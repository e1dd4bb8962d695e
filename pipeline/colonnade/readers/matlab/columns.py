"""Columns of numbers in the variables of a MATLAB file: vectors, columns of matrices, fields of structs, cells."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from colonnade.readers.binary.vectors import Column
from colonnade.readers.matlab.tree import Node, Numbers
from colonnade.readers.text.heading import take_apart

MOST_COLUMNS = 1000
"""Of one matrix; a wider one does not hold channels."""
VALUE_FIELDS = frozenset(("values", "data", "value", "y", "signal"))
NAME_FIELDS = frozenset(("label", "name", "signalname", "blockname", "title"))
UNIT_FIELDS = frozenset(("unit", "units"))
LIST_FIELDS = frozenset(("colheaders", "names", "labels", "channels", "channelnames", "channel_names", "headers"))


@dataclass
class Found:
    """
    What is of use in a MATLAB file.

    Attributes
    ----------
    columns : list of Column
    scalars : dict of str to float
        Single numbers, by path.
    left_out : dict of str to str
        Path -> why it is not a column.
    """

    columns: list[Column] = field(default_factory=list)
    scalars: dict[str, float] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)


def find_columns(variables: dict[str, Node]) -> Found:
    """
    Find the columns of numbers among a file's variables.

    A matrix gives a channel a column where a vector is as long as it has rows, a channel a row where one is as long as
    it has columns; else its longer side counts as that of the samples.
    """
    found = Found()
    lengths = set(_vector_lengths(variables))
    for name, node in variables.items():
        _walk(node, name, (), lengths, found, None)
    return found


def _vector_lengths(node: Node) -> Iterator[int]:
    if isinstance(node, np.ndarray):
        if 1 < node.size == max(node.shape):
            yield node.size
    elif isinstance(node, dict):
        for child in node.values():
            yield from _vector_lengths(child)
    elif isinstance(node, list):
        for child in node:
            yield from _vector_lengths(child)


def _walk(
    node: Node, path: str, scope: tuple[str, ...], lengths: set[int], found: Found, beside: dict[str, Node] | None
) -> None:
    if isinstance(node, np.ndarray):
        _numbers(node, path, scope, lengths, found, beside or {})
    elif isinstance(node, dict):
        for name, child in node.items():
            _walk(child, f"{path}.{name}", (*scope, path), lengths, found, node)
    elif isinstance(node, list):
        brackets = "()" if node and isinstance(node[0], dict) else "{}"
        for number, child in enumerate(node, 1):
            if not isinstance(child, str):
                _walk(child, f"{path}{brackets[0]}{number}{brackets[1]}", scope, lengths, found, None)


def _numbers(
    numbers: Numbers, path: str, scope: tuple[str, ...], lengths: set[int], found: Found, beside: dict[str, Node]
) -> None:
    """Split an array into columns; other fields of its struct may give names and units."""
    if numbers.size == 0:
        return
    if numbers.size == 1:
        found.scalars[path] = float(numbers.ravel()[0])
        return
    numbers = numbers.squeeze()
    told = {name.casefold(): text for name, text in beside.items()}
    is_value = path.rpartition(".")[2].casefold() in VALUE_FIELDS
    name = _text(told, NAME_FIELDS) if is_value else None
    unit = _text(told, UNIT_FIELDS) if is_value else None
    if numbers.ndim == 1:
        found.columns.append(Column(path, scope, numbers, name, unit))
        return
    if numbers.ndim > 2:
        found.left_out[path] = f"it has {numbers.ndim} dimensions; vectors and matrices are read"
        return
    rows, columns = numbers.shape
    if (columns in lengths) > (rows in lengths) or ((columns in lengths) == (rows in lengths) and columns > rows):
        numbers = numbers.T
    if numbers.shape[1] > MOST_COLUMNS:
        found.left_out[path] = (
            f"it is a matrix of {rows} × {columns}, more than the {MOST_COLUMNS} channels that are read"
        )
        return
    names = _list_of_names(told, numbers.shape[1])
    for number in range(numbers.shape[1]):
        own, own_unit = take_apart(names[number]) if names else (f"{name}[{number + 1}]" if name else None, unit)
        found.columns.append(Column(f"{path}[{number + 1}]", scope, numbers[:, number], own, own_unit))


def _text(told: dict[str, Node], keys: frozenset[str]) -> str | None:
    found = (told[key] for key in told if key in keys)
    return next((text.strip() for text in found if isinstance(text, str) and text.strip()), None)


def _list_of_names(told: dict[str, Node], count: int) -> list[str]:
    """Names of a matrix's columns, if a cell array or lines of text next to it give as many."""
    for key, node in told.items():
        names = node.splitlines() if isinstance(node, str) else node
        if key in LIST_FIELDS and isinstance(names, list) and len(names) == count:
            texts = [name.strip() for name in names if isinstance(name, str) and name.strip()]
            if len(texts) == count:
                return texts
    return []
