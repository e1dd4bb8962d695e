"""MATLAB files of versions 5 to 7 and 7.3: vectors, matrices, structs and cells of numbers as channels."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.binary.numbers import Told, UnreadableError, columns_of, member, recorded
from colonnade.readers.clock import ClockOptions
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import HDF5, Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording

if TYPE_CHECKING:
    import h5py

MARK = b"MATLAB "
USER_BLOCK = 512
"""Bytes before HDF5's own start in a file of version 7.3."""

Numbers = NDArray[Any]
Node = Any
"""Numbers, text, a cell array as a list or an array of nodes, a struct as a dictionary of nodes, an array of structs as
a list of dictionaries, or an object of SciPy's for what is no data."""

NO_NUMBERS = (
    "it holds no real numbers in plain form (complex or sparse ones, a function or an object of one of "
    "MATLAB's classes; nothing in a recording is executed). Save its numbers in MATLAB as arrays or structs: full(x), "
    "x.Time and x.Data, table2struct(x, 'ToScalar', true)"
)
VALUE_FIELDS = ("values", "data", "value", "y", "signal")
NAME_FIELDS = ("label", "name", "signalname", "blockname", "title")
UNIT_FIELDS = ("unit", "units")
"""Fields of a struct, in lower case, that hold numbers, and what these are."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is MATLAB's, by its first bytes."""
    first = head.content
    if first.startswith(MARK) and (first[USER_BLOCK:].startswith(HDF5) or first[126:128] in (b"IM", b"MI")):
        return Recognition(True, "it starts as a MATLAB file")
    return Recognition(False, "it does not start with the whole header of a MATLAB file of version 5 to 7.3")


def read(path: Path, options: ClockOptions) -> Recording:
    """Read a MATLAB file; ReadError if it holds no column of numbers."""
    told = Told()
    is_hdf5 = recognise.expected(path).content[USER_BLOCK:].startswith(HDF5)
    columns, scalars = find_columns((read_v73 if is_hdf5 else read_v5)(path, told), told)
    return recorded(path, "matlab", columns, told, options, scalars)


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


def read_v73(path: Path, told: Told) -> dict[str, Node]:
    """Read all variables of a MATLAB file of version 7.3."""
    import h5py

    with h5py.File(path, "r") as file:
        return _members(file, "", told)


def _members(group: h5py.Group, path: str, told: Told) -> dict[str, Node]:
    """Variables or fields, without those of MATLAB's own."""
    places = {name: (f"{path}.{name}" if path else name, name) for name in group if name[:1] != "#"}
    return told.parts(lambda name, place, _: _node(member(group, name), place, told), places)


def _node(item: h5py.Group | h5py.Dataset, path: str, told: Told) -> Node:
    """A struct, an array of structs, numbers, text or cells; UnreadableError if it is no data."""
    import h5py

    if _class(item) == b"function_handle" or item.attrs.keys() & {"MATLAB_object_decode", "MATLAB_sparse"}:
        raise UnreadableError(NO_NUMBERS)
    if isinstance(item, h5py.Group):
        fields = _members(item, path, told)
        # Of an array of structs each field is a list of references, one an element.
        lists = {name: each for name, each in fields.items() if isinstance(each, list) and not _class(item[name])}
        return [dict(zip(lists, each, strict=True)) for each in zip(*lists.values(), strict=False)] or fields
    if item.attrs.get("MATLAB_empty", 0):
        return []
    if h5py.check_ref_dtype(item.dtype) is h5py.Reference:
        cells = {k: (f"{path}{{{k}}}", each) for k, each in enumerate(item[()].ravel().tolist(), 1)}
        return [*told.parts(lambda cell, place, _: _node(item.file[cell], place, told), cells).values()]
    if item.dtype.kind not in "fiub":
        raise UnreadableError(NO_NUMBERS)
    numbers = np.atleast_2d(item[()].T)
    return "".join(map(chr, numbers.ravel())).rstrip("\0 ") if _class(item) == b"char" else numbers


def _class(item: h5py.Group | h5py.Dataset) -> Any:
    return item.attrs.get("MATLAB_class", b"")


Leaf = tuple[str, tuple[str, ...], dict[str, Node], Numbers]
"""An array with its path, the structs that contain it, and the fields next to it."""


def find_columns(variables: dict[str, Node], told: Told) -> tuple[list[RecordedChannel], dict[str, float]]:
    """
    Find the columns of numbers among a file's variables, and single numbers by their paths.

    A matrix gives a channel a column where a vector is as long as it has rows, a channel a row where one is as long as
    it has columns; else its longer side counts as that of the samples. In the layout of Bristol, `Channel_1_Header`
    names `Channel_1_Data`.
    """
    leaves: list[Leaf] = []
    for name, node in variables.items():
        header = variables.get(name.removesuffix("_Data") + "_Header")
        leaves += _leaves(node, name, (), header if isinstance(header, dict) else {}, told)
    lengths = {numbers.size for *_, numbers in leaves if 1 < numbers.size == max(numbers.shape)}
    columns: list[RecordedChannel] = []
    scalars: dict[str, float] = {}
    for path, scope, beside, numbers in leaves:
        if numbers.size == 1:
            scalars[path] = float(numbers.ravel()[0])
        elif numbers.size:
            columns += told.guarded(path, _columns, path, scope, beside, numbers.squeeze(), lengths) or ()
    return columns, scalars


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


def _numbers(value: Any) -> Numbers | None:
    """Numbers, also of a text that is one; None for other text, UnreadableError for what is neither."""
    from scipy.io.matlab import MatlabFunction

    array = np.asarray(value)
    if isinstance(value, MatlabFunction) or array.dtype.kind not in "fiubU":
        raise UnreadableError(NO_NUMBERS)
    if array.dtype.kind != "U":
        return array
    with suppress(ValueError):
        return array.astype(np.float64)
    return None


def _columns(
    path: str, scope: tuple[str, ...], beside: dict[str, Node], numbers: Numbers, lengths: set[int]
) -> list[RecordedChannel]:
    """Split an array into columns; other fields of its struct may give name and unit."""
    fields = {key.casefold(): each.strip() for key, each in beside.items() if isinstance(each, str)}
    if scope and path.rpartition(".")[2].casefold() not in VALUE_FIELDS:
        fields = {}
    name, unit = (next(filter(None, map(fields.get, keys)), None) for keys in (NAME_FIELDS, UNIT_FIELDS))
    if numbers.ndim == 2:
        rows, columns = (size in lengths for size in numbers.shape)
        numbers = numbers.T if columns > rows or (columns == rows and numbers.shape[1] > numbers.shape[0]) else numbers
    return [
        RecordedChannel(f"{name}{number}" if name else "", unit, part, heading=path + number, scope=scope)
        for number, part in columns_of(numbers).items()
    ]


FORMAT = Format(
    name="matlab",
    summary="MATLAB .mat of versions 5 to 7.3: vectors, matrices, structs; Simulink's and Bristol's layouts.",
    suffixes=(".mat",),
    options=ClockOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
