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


Leaf = tuple[str, tuple[str, ...], dict[str, Node], Numbers]
"""An array with its path, the structs that contain it, and the fields next to it."""


def find_columns(variables: dict[str, Node]) -> Found:
    """
    Find the columns of numbers among a file's variables.

    A matrix gives a channel a column where a vector is as long as it has rows, a channel a row where one is as long as
    it has columns; else its longer side counts as that of the samples.
    """
    found = Found()
    leaves = [leaf for name, node in variables.items() for leaf in _leaves(node, name, (), {})]
    lengths = {numbers.size for *_, numbers in leaves if 1 < numbers.size == max(numbers.shape)}
    for path, scope, beside, numbers in leaves:
        if numbers.size == 1:
            found.scalars[path] = float(numbers.ravel()[0])
        elif numbers.size:
            _take(
                found, path, scope, {name.casefold(): node for name, node in beside.items()}, numbers.squeeze(), lengths
            )
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


def _take(
    found: Found, path: str, scope: tuple[str, ...], beside: dict[str, Node], numbers: Numbers, lengths: set[int]
) -> None:
    """Split an array into columns; other fields of its struct may give names and units."""
    is_value = path.rpartition(".")[2].casefold() in VALUE_FIELDS
    name = _text(beside, NAME_FIELDS) if is_value else None
    unit = _text(beside, UNIT_FIELDS) if is_value else None
    if numbers.ndim == 1:
        found.columns.append(RecordedChannel(name or "", unit, numbers, heading=path, scope=scope))
        return
    rows, columns, *more = numbers.shape
    size = " × ".join(map(str, numbers.shape))
    if (columns in lengths) > (rows in lengths) or ((columns in lengths) == (rows in lengths) and columns > rows):
        numbers = numbers.T
    if more or numbers.shape[1] > MOST_COLUMNS:
        found.left_out[path] = f"an array of {size}; vectors, and matrices of up to {MOST_COLUMNS} channels, are read"
        return
    names = _list_of_names(beside, numbers.shape[1])
    for number, part in enumerate(numbers.T, 1):
        own, own_unit = take_apart(names[number - 1]) if names else (f"{name}[{number}]" if name else None, unit)
        found.columns.append(RecordedChannel(own or "", own_unit, part, heading=f"{path}[{number}]", scope=scope))


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
    parts = {name: match for name in variables if (match := BRISTOL.fullmatch(name))}
    columns: list[RecordedChannel] = []
    for number in sorted(int(match[1]) for match in parts.values() if match[1] and match[2]):
        place, header = f"Channel_{number}_Data", variables.get(f"Channel_{number}_Header")
        values = variables[place]
        if not isinstance(values, np.ndarray) or values.size < 2 or values.size != max(values.shape):
            continue
        told = header if isinstance(header, dict) else {}
        name, unit = (_text({"": told.get(key, "")}, frozenset(("",))) for key in ("SignalName", "Unit"))
        if number == 1 and rising_share(values.ravel().astype(np.float64)) >= RISING_SHARE:
            name = "time"
        columns.append(RecordedChannel(name or "", unit, values.ravel(), heading=place))
    if not columns:
        return variables, [], {}, []
    others = {name: node for name, node in variables.items() if name not in parts}
    notes = ["layout of Bristol: Channel_i_Data, with names and units in Channel_i_Header"]
    if columns[0].name == "time":
        return others, columns, {}, [*notes, "Channel_1_Data rises: it is the clock"]
    rate = _number(variables.get("File_Header"), "SampleFrequency")
    return others, columns, {"File_Header.SampleFrequency": rate} if rate else {}, notes


def _number(header: Node | None, field: str) -> float | None:
    value = header.get(field) if isinstance(header, dict) else None
    try:
        number = float(value.strip() if isinstance(value, str) else np.asarray(value, dtype=np.float64).ravel()[0])
    except (ValueError, TypeError, IndexError):
        return None
    return number if number > 0 else None


def lacking_channels(variables: dict[str, Node], columns: list[RecordedChannel]) -> list[str]:
    """Warn where the layout `t`, `chan1` … `chann`, `No_Channels` has fewer channels than it says."""
    said = variables.get("No_Channels")
    there = sum(re.fullmatch(r"chan\d+|output\[\d+\]", column.heading) is not None for column in columns)
    if not isinstance(said, np.ndarray) or said.size != 1 or there in (0, int(said.ravel()[0])):
        return []
    return [f"No_Channels says {int(said.ravel()[0])}, but {there} channels are in the file"]
