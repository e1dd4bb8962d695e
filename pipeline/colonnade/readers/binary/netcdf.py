"""NetCDF of every version and plain HDF5, with units and times as the CF conventions write them."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.readers.binary.numbers import DAMAGE, Told, UnreadableError, columns_of, member, recorded
from colonnade.readers.clock import ClockOptions, moment_after
from colonnade.readers.format import Format
from colonnade.readers.head import HDF5, NETCDF, by_mark
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

if TYPE_CHECKING:
    import h5py

DIMENSION_ONLY = "This is a netCDF dimension but not a netCDF variable"
SECONDS = {**TIME_UNITS, "days": 86400.0, "nanoseconds": 1e-9}


class Variable(NamedTuple):
    """An array of numbers as stored, by its path (`run/top`), with the path of the variable that is its dimension."""

    path: str
    values: NDArray[Any]
    coordinate: str
    attributes: Mapping[str, Any]


recognise = by_mark((*NETCDF, HDF5), "the mark of NetCDF or HDF5")


def read(path: Path, options: ClockOptions) -> Recording:
    """Read a NetCDF or HDF5 file; ReadError if it holds no column of numbers."""
    told = Told()
    is_classic = recognise.expected(path).content.startswith(NETCDF)
    variables, attributes = (read_classic if is_classic else read_hdf5)(path, told)
    by_path = {each.path: each for each in variables}
    clocks: dict[str, _Clock | None] = {}
    columns: list[RecordedChannel] = []
    for each in variables:
        coordinate = each.coordinate
        if coordinate in by_path and coordinate not in clocks:
            clocks[coordinate] = _clock(by_path[coordinate], options, told)
        columns += told.guarded(each.path, _columns, each, clocks.get(coordinate)) or []
    numbers = {**{name.replace("/", "."): each.values for name, each in by_path.items()}, **attributes}
    scalars = {name: number for name, value in numbers.items() if (number := _number(value)) is not None}
    return recorded(path, "netcdf", columns, told, options, scalars)


def read_hdf5(path: Path, told: Told) -> tuple[list[Variable], Mapping[str, Any]]:
    """Read the variables and attributes of NetCDF-4, or any other HDF5 file, in their order."""
    import h5py

    with h5py.File(path, "r") as file:
        return _group(file, "", told, set()), _attributes(file)


def _group(group: h5py.Group, path: str, told: Told, known: set[Any]) -> list[Variable]:
    """The variables of a group and those in it."""
    known.add(group.id)
    found: list[Variable] = []
    for name in group:
        found += told.guarded(path + name, _member, group, name, path + name, told, known) or []
    return found


def _member(group: h5py.Group, name: str, path: str, told: Told, known: set[Any]) -> list[Variable]:
    """The variable of a dataset, or those of a group; one that is linked from within itself is read once."""
    import h5py

    item = member(group, name)
    if isinstance(item, h5py.Group):
        return [] if item.id in known else _group(item, f"{path}/", told, known)
    if item.dtype.kind not in "fiub":
        raise UnreadableError("it holds no numbers; of a table, save each column as a variable")
    attributes = _attributes(item)
    if DIMENSION_ONLY in str(attributes.get("NAME", "")):
        return []
    # HDF5's own functions for dimensions free memory twice where their attributes are damaged.
    scales = attributes.get("DIMENSION_LIST", ())
    coordinate = path if "DIMENSION_SCALE" in str(attributes.get("CLASS", "")) else ""
    if not coordinate and len(scales) and len(scales[0]):
        coordinate = str(item.file[scales[0][0]].name).strip("/")
    return [Variable(path, item[()], coordinate, attributes)]


def _attributes(item: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """Attributes of a part of an HDF5 file; one that cannot be read says nothing."""
    found = {}
    for name in item.attrs:
        with suppress(*DAMAGE):
            found[name] = item.attrs[name]
    return found


def read_classic(path: Path, told: Told) -> tuple[list[Variable], Mapping[str, Any]]:
    """Read the variables and attributes of NetCDF of the classic format."""
    from scipy.io import netcdf_file

    with path.open("rb") as stream:
        file = netcdf_file(stream, mmap=False)
        variables = []
        for name, variable in file.variables.items():
            if variable.data.dtype.kind in "fiu":
                values = np.array(variable.data, dtype=variable.data.dtype.newbyteorder("="))
                variables.append(Variable(name, values, next(iter(variable.dimensions), ""), variable._attributes))
            else:
                told.left_out[name] = "it holds text"
        return variables, file._attributes


def _number(value: object) -> float | None:
    """The number that an attribute or a variable is, if it is one."""
    array = np.asarray(value)
    return float(array.ravel()[0]) if array.size == 1 and array.dtype.kind in "fiub" else None


def _decoded(variable: Variable) -> Array:
    """Values with what the CF conventions say of them: missing ones, factor and offset of packed numbers."""
    known = {name: number for name, value in variable.attributes.items() if (number := _number(value)) is not None}
    decoded = np.array(variable.values, dtype=np.float64)
    for name in known.keys() & {"_FillValue", "missing_value"}:
        decoded[variable.values == known[name]] = np.nan
    if known.keys() & {"scale_factor", "add_offset"}:
        decoded = decoded * known.get("scale_factor", 1.0) + known.get("add_offset", 0.0)
    return decoded


def _units(variable: Variable) -> str:
    said = next(iter(np.ravel(variable.attributes.get("units", "")).tolist()), "")
    return (said.decode("utf-8", "replace") if isinstance(said, bytes) else str(said)).strip()


_Clock = tuple[Array, datetime | None]
"""Times of a coordinate, s, and when they are zero."""


def _clock(coordinate: Variable, options: ClockOptions, told: Told) -> _Clock | None:
    """Understand a coordinate as times: `seconds since …`, in UTC if no zone is given; None if it is none of time."""
    values = _decoded(coordinate).ravel()
    known = values[np.isfinite(values)]
    said = options.time_unit if options.time_unit and options.time is None else _units(coordinate)
    unit, _, moment = said.partition(" since ")
    factor = SECONDS.get(unit.casefold())
    if factor is None or not known.size:
        return None
    told.notes.append(f'"{coordinate.path}" is the coordinate of a dimension, in {said}')
    if not moment:
        return values * factor, None
    import pandas as pd

    origin = pd.to_datetime(moment, utc=True, errors="coerce")
    start = None if pd.isna(origin) else moment_after(origin.to_pydatetime(warn=False), known[0] * factor)
    return (values - known[0]) * factor, start


def _columns(variable: Variable, clock: _Clock | None) -> list[RecordedChannel]:
    """Take a variable apart into columns along its first dimension, each on its coordinate, if that is of times."""
    table, path = _decoded(variable), variable.path
    if table.size < 2:
        return []
    if table.ndim == 2 and table.shape[1] > table.shape[0] and not variable.coordinate:
        table = table.T
    time, start = clock if clock and clock[0].size == len(table) else (None, None)
    is_clock = time is not None and variable.coordinate == path
    unit, (*groups, name) = _units(variable) or None, path.split("/")
    return [
        RecordedChannel(name + number, unit, values, time, path + number, is_clock, tuple(groups), start)
        for number, values in columns_of(table).items()
    ]


FORMAT = Format(
    name="netcdf",
    summary="NetCDF (classic and NetCDF-4) and HDF5: variables of all groups, CF units and times.",
    suffixes=(".nc", ".cdf", ".h5", ".hdf5"),
    options=ClockOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
