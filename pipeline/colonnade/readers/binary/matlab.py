"""MATLAB files of versions 5 to 7 and 7.3: vectors, matrices, structs and cells of numbers as channels."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.errors import ReadError, nearest
from colonnade.readers.binary.numbers import Told, UnreadableError, columns_of, member, recorded
from colonnade.readers.clock import RISING_SHARE, ClockOptions, rising_share
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import HDF5, Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.heading import take_apart

if TYPE_CHECKING:
    import h5py

MARK = b"MATLAB "
USER_BLOCK = 512
"""Bytes before HDF5's own start in a file of version 7.3."""
NUMERIC = frozenset(
    ("double", "single", "logical", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)))
)
"""Classes of version 7.3 that are numbers."""


Numbers = NDArray[Any]
Node = Any
"""Numbers, text, a cell array as a list or an array of nodes, a struct as a dictionary of nodes, an array of structs as
a list of dictionaries, or an object of SciPy's for what is no data."""


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
VALUE_FIELDS = frozenset(("values", "data", "value", "y", "signal"))
NAME_FIELDS = frozenset(("label", "name", "signalname", "blockname", "title"))
UNIT_FIELDS = frozenset(("unit", "units"))
LIST_FIELDS = frozenset(("colheaders", "names", "labels", "channels", "channelnames", "channel_names", "headers"))
BRISTOL = re.compile(r"(?:File|Channel_\d+)_Header")
"""Headers of the layout `File_Header`, `Channel_i_Header`, `Channel_i_Data`."""


class MatlabOptions(ClockOptions):
    """Options of a MATLAB file; what is not given is detected."""

    variables: tuple[str, ...] = Field(default=(), description="Variables to read; by default all of them.")


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is MATLAB's, by its first bytes."""
    first = head.content
    if first[USER_BLOCK:].startswith(HDF5) and first.startswith(MARK):
        return Recognition(True, "starts as a MATLAB file of version 7.3")
    if first.startswith(MARK) and first[126:128] in (b"IM", b"MI"):
        return Recognition(True, "starts as a MATLAB file of version 5 to 7")
    return Recognition(False, "it does not start with the whole header of a MATLAB file of version 5 to 7.3")


def read(path: Path, options: MatlabOptions) -> Recording:
    """Read a MATLAB file; ReadError if it holds no column of numbers, or lacks a variable that the options name."""
    told = Told()
    is_hdf5 = recognise.expected(path).content[USER_BLOCK:].startswith(HDF5)
    variables = (read_v73 if is_hdf5 else read_v5)(path, told)
    for name in options.variables:
        if name not in variables:
            reason = f"cannot be read: {told.left_out[name]}." if name in told.left_out else "is missing."
            raise ReadError(f'{path.name}: variable "{name}" {reason}{nearest(name, variables)}')
    columns, scalars = find_columns({name: variables[name] for name in options.variables or variables}, told)
    held = ", ".join(list(variables)[:8]) or "no variable"
    return recorded(path, "matlab", columns, told, options, scalars, where=f"in it; it holds {held}")


def read_v5(path: Path, told: Told) -> dict[str, Node]:
    """Read all variables of a MATLAB file of version 5 to 7, one by one, so that a damaged one does no harm."""
    from scipy.io import loadmat
    from scipy.io.matlab import MatlabOpaque, varmats_from_mat

    variables: dict[str, Node] = {}
    with path.open("rb") as stream, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, alone in varmats_from_mat(stream):
            loaded = told.guarded(name, partial(loadmat, simplify_cells=True), alone) or {}
            for given, value in loaded.items():
                own = value["s0"].item().decode("latin-1") if isinstance(value, MatlabOpaque) else given
                if not own.startswith("__"):  # MATLAB's own data about its objects
                    variables[own] = value
    return variables


def _numbers(value: Any) -> Numbers | None:
    """Numbers; None for text, UnreadableError for what is neither."""
    from scipy.io.matlab import MatlabFunction, MatlabObject, MatlabOpaque
    from scipy.sparse import issparse

    if issparse(value):
        raise UnreadableError("it is a sparse matrix")
    if isinstance(value, MatlabFunction):
        raise UnreadableError(FUNCTION)
    if isinstance(value, (MatlabOpaque, MatlabObject)):
        is_opaque = isinstance(value, MatlabOpaque)
        raise UnreadableError(object_reason(value["s2"].item().decode("latin-1") if is_opaque else value.classname))
    array = np.asarray(value)
    if array.dtype.kind not in "fiubU":
        raise UnreadableError("it holds complex numbers" if array.dtype.kind == "c" else "it holds no numbers")
    return None if array.dtype.kind == "U" else array


def read_v73(path: Path, told: Told) -> dict[str, Node]:
    """Read all variables of a MATLAB file of version 7.3."""
    import h5py

    with h5py.File(path, "r") as file:
        return _members(file, "", told)


def _members(group: h5py.Group, path: str, told: Told) -> dict[str, Node]:
    """Variables or fields, in MATLAB's order if the file keeps it, without those of MATLAB's own."""
    ordered = [b"".join(np.asarray(each).tolist()).decode("latin-1") for each in group.attrs.get("MATLAB_fields", ())]
    names = [name for name in ordered if name in group] or [name for name in group if name[:1] != "#"]
    places = {name: (f"{path}.{name}" if path else name, name) for name in names}
    return told.parts(lambda name, place, _: _node_73(member(group, name), place, told), places)


def _node_73(item: h5py.Group | h5py.Dataset, path: str, told: Told) -> Node:
    """A struct, an array of structs, numbers, text or cells; UnreadableError if it is no data."""
    import h5py

    matlab_class = _class(item)
    if matlab_class == "function_handle":
        raise UnreadableError(FUNCTION)
    if "MATLAB_object_decode" in item.attrs or (
        matlab_class and matlab_class not in NUMERIC | {"char", "cell", "struct"}
    ):
        raise UnreadableError(object_reason(matlab_class or "?"))
    if isinstance(item, h5py.Group):
        if "MATLAB_sparse" in item.attrs:
            raise UnreadableError("it is a sparse matrix")
        fields = _members(item, path, told)
        # Of an array of structs each field is a list of references, one an element.
        lists = {name: value for name, value in fields.items() if isinstance(value, list) and not _class(item[name])}
        return [dict(zip(lists, each, strict=True)) for each in zip(*lists.values(), strict=False)] or fields
    if item.attrs.get("MATLAB_empty", 0):
        return "" if matlab_class == "char" else np.empty((0, 0))
    if h5py.check_ref_dtype(item.dtype) is h5py.Reference:
        cells = {k: (f"{path}{{{k}}}", each) for k, each in enumerate(item[()].ravel().tolist(), 1)}
        found = told.parts(lambda cell, place, _: _node_73(item.file[cell], place, told), cells)
        return list(found.values())
    if item.dtype.kind not in "fiub":
        is_complex = item.dtype.names == ("real", "imag")
        raise UnreadableError("it holds complex numbers" if is_complex else "it holds no numbers")
    numbers = np.atleast_2d(item[()].T)
    if matlab_class != "char":
        return numbers
    rows = numbers.reshape(len(numbers), -1).tolist()
    return "\n".join("".join(chr(code) for code in row if 0 < code < 0x110000).rstrip() for row in rows)


def _class(item: Any) -> str:
    told = item.attrs.get("MATLAB_class", b"")
    return told.decode("latin-1") if isinstance(told, bytes) else str(told)


def object_reason(class_name: str) -> str:
    """Say why an object is not read, and what to do in MATLAB about it."""
    advice = OPAQUE.get(class_name, "save its numbers as plain arrays")
    return f"it is an object of MATLAB's class {class_name}, which only MATLAB can open: {advice}"


Leaf = tuple[str, tuple[str, ...], dict[str, Node], Numbers]
"""An array with its path, the structs that contain it, and the fields next to it."""


def find_columns(variables: dict[str, Node], told: Told) -> tuple[list[RecordedChannel], dict[str, float]]:
    """
    Find the columns of numbers among a file's variables, and single numbers by their paths.

    A matrix gives a channel a column where a vector is as long as it has rows, a channel a row where one is as long as
    it has columns; else its longer side counts as that of the samples.
    """
    leaves: list[Leaf] = []
    for name, node in variables.items():
        if not BRISTOL.fullmatch(name):
            header = variables.get(name.removesuffix("_Data") + "_Header")
            leaves += _leaves(node, name, (), header if isinstance(header, dict) else {}, told)
    lengths = {numbers.size for *_, numbers in leaves if 1 < numbers.size == max(numbers.shape)}
    columns: list[RecordedChannel] = []
    scalars: dict[str, float] = {}
    for path, scope, beside, numbers in leaves:
        if numbers.size == 1:
            scalars[path] = float(numbers.ravel()[0])
        elif numbers.size:
            fields = {name.casefold(): each for name, each in beside.items()}
            columns += told.guarded(path, _columns, path, scope, fields, numbers.squeeze(), lengths) or ()
    if "Channel_1_Data" in variables:
        told.notes.append("layout of Bristol: Channel_i_Data, with names and units in Channel_i_Header")
        with suppress(ValueError, TypeError, KeyError, IndexError):  # a number, or text that is one
            rate = np.asarray(variables["File_Header"]["SampleFrequency"]).ravel()[0]
            scalars["File_Header.SampleFrequency"] = float(rate)
        columns = [_named_time(column) for column in columns]
    return columns, scalars


def _named_time(column: RecordedChannel) -> RecordedChannel:
    """Call the first channel of the layout of Bristol what it is if it rises: the clock."""
    is_clock = column.heading == "Channel_1_Data" and rising_share(column.values.astype(np.float64)) >= RISING_SHARE
    return replace(column, name="time") if is_clock else column


def _leaves(node: Node, path: str, scope: tuple[str, ...], beside: dict[str, Node], told: Told) -> Iterator[Leaf]:
    """Find the arrays of numbers in a node; what is no data is left out with its reason."""
    if isinstance(node, dict):
        for name, child in node.items():
            yield from _leaves(child, f"{path}.{name}", (*scope, path), node, told)
    elif isinstance(node, list) or (isinstance(node, np.ndarray) and node.dtype.kind == "O"):
        listed = node if isinstance(node, list) else node.ravel(order="F").tolist()
        opening, closing = "()" if any(isinstance(child, dict) for child in listed) else "{}"
        for number, child in enumerate(listed, 1):
            yield from _leaves(child, f"{path}{opening}{number}{closing}", scope, {}, told)
    elif (numbers := told.guarded(path, _numbers, node)) is not None:
        yield path, scope, beside, numbers


def _columns(
    path: str, scope: tuple[str, ...], beside: dict[str, Node], numbers: Numbers, lengths: set[int]
) -> list[RecordedChannel]:
    """Split an array into columns; other fields of its struct may give names and units."""
    is_value = not scope or path.rpartition(".")[2].casefold() in VALUE_FIELDS
    name = _text(beside, NAME_FIELDS) if is_value else None
    unit = _text(beside, UNIT_FIELDS) if is_value else None
    if numbers.ndim == 2:
        rows, columns = (size in lengths for size in numbers.shape)
        numbers = numbers.T if columns > rows or (columns == rows and numbers.shape[1] > numbers.shape[0]) else numbers
    parts = columns_of(numbers)
    names = _list_of_names(beside, len(parts)) if numbers.ndim == 2 else []
    found = []
    for (number, part), given in zip_longest(parts.items(), names):
        own, own_unit = take_apart(given) if given else (f"{name}{number}" if name else "", unit)
        found.append(RecordedChannel(own, own_unit, part, heading=path + number, scope=scope))
    return found


def _text(beside: dict[str, Node], keys: frozenset[str]) -> str | None:
    texts = (text.strip() for key, text in beside.items() if key in keys and isinstance(text, str))
    return next(filter(None, texts), None)


def _list_of_names(beside: dict[str, Node], count: int) -> list[str]:
    """Names of a matrix's columns, if a cell array or lines of text next to it give as many."""
    for key, node in beside.items():
        if key in LIST_FIELDS:
            names = node.splitlines() if isinstance(node, str) else np.ravel(np.asarray(node, dtype=object)).tolist()
            texts = [name.strip() for name in names if isinstance(name, str) and name.strip()]
            if len(texts) == len(names) == count:
                return texts
    return []


FORMAT = Format(
    name="matlab",
    summary="MATLAB .mat of versions 5 to 7.3: vectors, matrices, structs; Simulink's and Bristol's layouts.",
    suffixes=(".mat",),
    options=MatlabOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
