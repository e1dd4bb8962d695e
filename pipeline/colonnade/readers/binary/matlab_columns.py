"""Columns of numbers among the variables of a MATLAB file: of structs, cells, matrices, and the layouts of Bristol."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.binary.numbers import Told, columns_of
from colonnade.readers.clock import RISING_SHARE, rising_share
from colonnade.readers.recording import RecordedChannel
from colonnade.readers.text.heading import take_apart

Numbers = NDArray[Any]
Node = Numbers | str | list[Any] | dict[str, Any]
"""Numbers (two-dimensional, as MATLAB shows them), text, a cell array as a list of nodes, a struct as a dictionary of
nodes; an array of structs is a list of dictionaries."""


FUNCTION = "it is a function; nothing in a recording is executed"
OPAQUE = {
    "timeseries": "in MATLAB: t = x.Time; values = x.Data; save them instead",
    "timetable": "in MATLAB: s = table2struct(timetable2table(x), 'ToScalar', true); save('file.mat', '-struct', 's')",
    "table": "in MATLAB: s = table2struct(x, 'ToScalar', true); save('file.mat', '-struct', 's')",
    "datetime": "in MATLAB: t = seconds(x - x(1)); save that instead",
    "duration": "in MATLAB: t = seconds(x); save that instead",
    "string": "it is text",
}
"""What to do about MATLAB classes that are kept in a form that MathWorks does not publish."""


def object_reason(class_name: str) -> str:
    """Say why an object is not read, and what to do in MATLAB about it."""
    advice = OPAQUE.get(class_name, "save its numbers as plain arrays")
    return f"it is an object of MATLAB's class {class_name}, which only MATLAB can open: {advice}"


VALUE_FIELDS = frozenset(("values", "data", "value", "y", "signal"))
NAME_FIELDS = frozenset(("label", "name", "signalname", "blockname", "title"))
UNIT_FIELDS = frozenset(("unit", "units"))
LIST_FIELDS = frozenset(("colheaders", "names", "labels", "channels", "channelnames", "channel_names", "headers"))


@dataclass
class Found:
    """Columns of a MATLAB file, its single numbers by path, and what is said of its layout."""

    columns: list[RecordedChannel] = field(default_factory=list)
    scalars: dict[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


Leaf = tuple[str, tuple[str, ...], dict[str, Node], Numbers]
"""An array with its path, the structs that contain it, and the fields next to it."""


def find_columns(variables: dict[str, Node], told: Told) -> Found:
    """
    Find the columns of numbers among a file's variables.

    A matrix gives a channel a column where a vector is as long as it has rows, a channel a row where one is as long as
    it has columns; else its longer side counts as that of the samples.
    """
    found, others = _numbered(variables)
    leaves = [leaf for name, node in others.items() for leaf in _leaves(node, name, (), {})]
    lengths = {numbers.size for *_, numbers in leaves if 1 < numbers.size == max(numbers.shape)}
    for path, scope, beside, numbers in leaves:
        if numbers.size == 1:
            found.scalars[path] = float(numbers.ravel()[0])
        elif numbers.size:
            fields = {name.casefold(): each for name, each in beside.items()}
            found.columns += told.guarded(path, _columns, path, scope, fields, numbers.squeeze(), lengths) or ()
    return found


def _leaves(node: Node, path: str, scope: tuple[str, ...], beside: dict[str, Node]) -> Iterator[Leaf]:
    if isinstance(node, np.ndarray):
        yield path, scope, beside, node
    elif isinstance(node, dict):
        for name, child in node.items():
            yield from _leaves(child, f"{path}.{name}", (*scope, path), node)
    elif isinstance(node, list):
        opening, closing = "()" if node and isinstance(node[0], dict) else "{}"
        for number, child in enumerate(node, 1):
            yield from _leaves(child, f"{path}{opening}{number}{closing}", scope, {})


def _columns(
    path: str, scope: tuple[str, ...], beside: dict[str, Node], numbers: Numbers, lengths: set[int]
) -> list[RecordedChannel]:
    """Split an array into columns; other fields of its struct may give names and units."""
    is_value = path.rpartition(".")[2].casefold() in VALUE_FIELDS
    name = _text(beside, NAME_FIELDS) if is_value else None
    unit = _text(beside, UNIT_FIELDS) if is_value else None
    if numbers.ndim == 1:
        return [RecordedChannel(name or "", unit, numbers, heading=path, scope=scope)]
    if numbers.ndim == 2:
        rows, columns = (size in lengths for size in numbers.shape)
        numbers = numbers.T if columns > rows or (columns == rows and numbers.shape[1] > numbers.shape[0]) else numbers
    parts = columns_of(numbers)
    names = _list_of_names(beside, len(parts))
    found = []
    for number, part in enumerate(parts, 1):
        own, own_unit = take_apart(names[number - 1]) if names else (f"{name}[{number}]" if name else "", unit)
        found.append(RecordedChannel(own, own_unit, part, heading=f"{path}[{number}]", scope=scope))
    return found


def _text(beside: dict[str, Node], keys: frozenset[str]) -> str | None:
    texts = (text.strip() for key, text in beside.items() if key in keys and isinstance(text, str))
    return next(filter(None, texts), None)


def _list_of_names(beside: dict[str, Node], count: int) -> list[str]:
    """Names of a matrix's columns, if a cell array or lines of text next to it give as many."""
    for key, node in beside.items():
        names = node.splitlines() if isinstance(node, str) else node
        if key in LIST_FIELDS and isinstance(names, list):
            texts = [name.strip() for name in names if isinstance(name, str) and name.strip()]
            if len(texts) == len(names) == count:
                return texts
    return []


BRISTOL = re.compile(r"(?:Channel_(\d+)|File)_(?:Header|(Data))")


def _numbered(variables: dict[str, Node]) -> tuple[Found, dict[str, Node]]:
    """Take the channels of the layout `File_Header`, `Channel_i_Header`, `Channel_i_Data`; what else there is, too."""
    parts = {name: match for name in variables if (match := BRISTOL.fullmatch(name))}
    columns = []
    for number in sorted(int(match[1]) for match in parts.values() if match[1] and match[2]):
        header, values = variables.get(f"Channel_{number}_Header"), variables[f"Channel_{number}_Data"]
        if isinstance(values, np.ndarray) and 1 < values.size == max(values.shape):
            told = header if isinstance(header, dict) else {}
            name, unit = (_text(told, frozenset((key,))) for key in ("SignalName", "Unit"))
            is_clock = number == 1 and rising_share(values.ravel().astype(np.float64)) >= RISING_SHARE
            name = "time" if is_clock else name or ""
            columns.append(RecordedChannel(name, unit, values.ravel(), heading=f"Channel_{number}_Data"))
    if not columns:
        return Found(), variables
    found = Found(columns, notes=("layout of Bristol: Channel_i_Data, with names and units in Channel_i_Header",))
    general = variables.get("File_Header")
    if columns[0].name == "time":
        found.notes += ("Channel_1_Data rises: it is the clock",)
    elif isinstance(general, dict):
        with suppress(ValueError, TypeError, IndexError):  # a number, or text that is one
            rate = np.asarray(general.get("SampleFrequency")).ravel()[0]
            found.scalars["File_Header.SampleFrequency"] = float(rate)
    return found, {name: node for name, node in variables.items() if name not in parts}
