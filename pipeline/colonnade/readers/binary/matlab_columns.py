"""Columns of numbers among the variables of a MATLAB file: of structs, cells, matrices, and the layouts of Bristol."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.clock import RISING_SHARE, rising_share
from colonnade.readers.recording import RecordedChannel
from colonnade.readers.text.heading import take_apart

Numbers = NDArray[Any]
Node = Numbers | str | list[Any] | dict[str, Any]
"""Numbers (two-dimensional, as MATLAB shows them), text, a cell array as a list of nodes, a struct as a dictionary of
nodes; an array of structs is a list of dictionaries."""


@dataclass
class Tree:
    """
    Variables of a MATLAB file, as far as they could be read.

    Attributes
    ----------
    variables : dict of str to Node
    left_out : dict of str to str
        Path of what was not read -> why: classes that are not data, or that would have to be executed.
    warnings : list of str
        Where the file is cut off or damaged.
    """

    variables: dict[str, Node] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


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
    columns : list of RecordedChannel
    scalars : dict of str to float
        Single numbers, by path.
    left_out : dict of str to str
        Path -> why it is not a column.
    """

    columns: list[RecordedChannel] = field(default_factory=list)
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
        found.columns.append(RecordedChannel(name or "", unit, numbers, heading=path, scope=scope))
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
        place, part = f"{path}[{number + 1}]", numbers[:, number]
        found.columns.append(RecordedChannel(own or "", own_unit, part, heading=place, scope=scope))


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


BRISTOL_DATA = re.compile(r"Channel_(\d+)_Data")


def numbered_channels(
    variables: dict[str, Node],
) -> tuple[dict[str, Node], list[RecordedChannel], dict[str, float], list[str]]:
    """
    Take the channels of the layout `File_Header`, `Channel_i_Header`, `Channel_i_Data`.

    Parameters
    ----------
    variables : dict of str to Node
        All variables of the file.

    Returns
    -------
    others : dict of str to Node
        Variables that are not part of the layout.
    columns : list of RecordedChannel
        With names and units by the headers; the first one is called `time` where it rises, as that is the clock.
    scalars : dict of str to float
        `File_Header.SampleFrequency`, Hz, if the first channel is not a clock.
    notes : list of str
        Empty if the file has another layout.
    """
    numbers = sorted(int(match[1]) for name in variables if (match := BRISTOL_DATA.fullmatch(name)))
    arrays = {number: variables[f"Channel_{number}_Data"] for number in numbers}
    columns: list[RecordedChannel] = []
    for number, values in arrays.items():
        if not isinstance(values, np.ndarray) or values.size < 2 or values.size != max(values.shape):
            continue
        header = variables.get(f"Channel_{number}_Header")
        name, unit = _told(header, "SignalName"), _told(header, "Unit")
        if number == 1 and rising_share(values.ravel().astype(np.float64)) >= RISING_SHARE:
            name = "time"
        columns.append(RecordedChannel(name or "", unit, values.ravel(), heading=f"Channel_{number}_Data"))
    if not columns:
        return variables, [], {}, []
    others = {
        name: node
        for name, node in variables.items()
        if not re.fullmatch(r"(?:Channel_\d+|File)_(?:Header|Data)", name)
    }
    notes = ["layout of Bristol: Channel_i_Data, with names and units in Channel_i_Header"]
    rate = _number(variables.get("File_Header"), "SampleFrequency")
    if columns[0].name == "time":
        return others, columns, {}, [*notes, "Channel_1_Data rises: it is the clock"]
    return others, columns, {"File_Header.SampleFrequency": rate} if rate else {}, notes


def lacking_channels(variables: dict[str, Node], columns: list[RecordedChannel]) -> list[str]:
    """Warn where the layout `t`, `chan1` … `chann`, `No_Channels` has fewer channels than it says."""
    said = variables.get("No_Channels")
    if not isinstance(said, np.ndarray) or said.size != 1:
        return []
    there = sum(re.fullmatch(r"chan\d+|output\[\d+\]", column.heading) is not None for column in columns)
    if there == 0 or there == int(said.ravel()[0]):
        return []
    return [f"No_Channels says {int(said.ravel()[0])}, but {there} channels are in the file"]


def _told(header: Node | None, field: str) -> str | None:
    text = header.get(field) if isinstance(header, dict) else None
    return text.strip() or None if isinstance(text, str) else None


def _number(header: Node | None, field: str) -> float | None:
    value = header.get(field) if isinstance(header, dict) else None
    try:
        number = float(value.strip() if isinstance(value, str) else np.asarray(value, dtype=np.float64).ravel()[0])
    except (ValueError, TypeError, IndexError):
        return None
    return number if number > 0 else None
