"""NetCDF of every version and plain HDF5, with units and times as the CF conventions write them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.arrays import Array
from colonnade.readers.binary.numbers import DAMAGE, Told, UnreadableError, columns_of, member, recorded
from colonnade.readers.clock import ClockOptions
from colonnade.readers.format import Format
from colonnade.readers.head import HDF5, NETCDF, by_mark
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

if TYPE_CHECKING:
    import h5py

DIMENSION_ONLY = "This is a netCDF dimension but not a netCDF variable"
SINCE = re.compile(r"(?P<unit>\w+)\s+since\s+(?P<moment>.+)", re.IGNORECASE)
DAYS = {"d": 86400.0, "day": 86400.0, "days": 86400.0, "ns": 1e-9, "nanosecond": 1e-9, "nanoseconds": 1e-9}


class Variable(NamedTuple):
    """An array of numbers as stored, by its path (`run/top`), with the path of the variable that is its dimension."""

    path: str
    values: NDArray[Any]
    coordinate: str | None
    attributes: dict[str, Any]


class NetcdfOptions(ClockOptions):
    """What can be said about a NetCDF or HDF5 file."""

    group: str | None = Field(default=None, description="Read only this group and those in it.")


recognise = by_mark((*NETCDF, HDF5), "the mark of NetCDF or HDF5")


def read(path: Path, options: NetcdfOptions) -> Recording:
    """Read a NetCDF or HDF5 file; ReadError if no column of numbers is where the options say."""
    is_classic = recognise.expected(path).content.startswith(NETCDF)
    told = Told()
    variables, attributes = (read_classic if is_classic else read_hdf5)(path, told)
    within = "" if options.group is None else options.group.strip("/") + "/"
    variables = [each for each in variables if each.path.startswith(within)]
    columns = _columns(variables, told, options.time_unit if options.time is None else None)
    scalars = {
        each.path.replace("/", "."): float(each.values.ravel()[0]) for each in variables if each.values.size == 1
    }
    scalars |= {name: float(value) for name, value in attributes.items() if _is_number(value)}
    where = "in it" if options.group is None else f'in group "{options.group}"'
    return recorded(path, "netcdf", columns, told, options, scalars, where=where)


def read_hdf5(path: Path, told: Told) -> tuple[list[Variable], dict[str, Any]]:
    """Read the variables and attributes of NetCDF-4, or any other HDF5 file, in their order."""
    import h5py

    with h5py.File(path, "r") as file:
        return _group(file, "", told, set()), _plain(_attributes(file))


def _group(group: h5py.Group, path: str, told: Told, known: set[Any]) -> list[Variable]:
    """The variables of a group and those in it; one that is linked from within itself is read once."""
    import h5py

    known.add(group.id)

    def one(name: str, place: str, _: Told) -> list[Variable]:
        item = member(group, name)
        if not isinstance(item, h5py.Group):
            return _dataset(item, place, told)
        if item.id in known:
            raise UnreadableError("it is another name of a group that is read")
        return _group(item, f"{place}/", told, known)

    return list(chain.from_iterable(told.parts(one, {name: (f"{path}{name}", name) for name in group}).values()))


def _dataset(dataset: h5py.Dataset, path: str, told: Told) -> list[Variable]:
    """The variable of a dataset, or one of each column of a table."""
    kinds = dataset.dtype
    if kinds.kind not in "fiub" and not (kinds.names and dataset.ndim == 1):
        raise UnreadableError("it holds no numbers")
    attributes = _attributes(dataset)
    # HDF5's own functions for dimensions free memory twice where their attributes are damaged.
    scales = attributes.pop("DIMENSION_LIST", ())
    if DIMENSION_ONLY in str(attributes.get("NAME", "")):
        return []
    values = dataset[()]
    if not kinds.names:
        coordinate = path if "DIMENSION_SCALE" in str(attributes.get("CLASS", "")) else None
        if coordinate is None and len(scales) and len(scales[0]):
            coordinate = str(dataset.file[scales[0][0]].name).strip("/")
        return [Variable(path, values, coordinate, _plain(attributes))]
    numeric = [name for name in kinds.names if kinds[name].kind in "fiub" and kinds[name].shape == ()]
    told.left_out |= {f"{path}/{name}": "it holds no numbers" for name in kinds.names if name not in numeric}
    return [Variable(f"{path}/{name}", np.array(values[name]), path, {}) for name in numeric]


def read_classic(path: Path, told: Told) -> tuple[list[Variable], dict[str, Any]]:
    """Read the variables and attributes of NetCDF of the classic format."""
    from scipy.io import netcdf_file

    with path.open("rb") as stream:
        file = netcdf_file(stream, mmap=False)
        variables = []
        for name, variable in file.variables.items():
            if variable.data.dtype.kind not in "fiu":
                told.left_out[name] = "it holds text"
                continue
            values = np.array(variable.data, dtype=variable.data.dtype.newbyteorder("="))
            coordinate = next(iter(variable.dimensions), None)
            variables.append(Variable(name, values, coordinate, _plain(variable._attributes)))
        return variables, _plain(file._attributes)


def _attributes(item: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """Attributes of a part of an HDF5 file; one that cannot be read says nothing."""
    found = {}
    for name in item.attrs:
        with suppress(*DAMAGE):
            found[name] = item.attrs[name]
    return found


def _plain(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes as text or numbers."""
    plain = {}
    for name, value in attributes.items():
        one = value.ravel()[0] if isinstance(value, np.ndarray) and value.size == 1 else value
        plain[name] = one.decode("utf-8", "replace") if isinstance(one, bytes) else one
    return plain


def _columns(variables: list[Variable], told: Told, unit: str | None) -> list[RecordedChannel]:
    """Take variables apart into columns along their first dimension, each on its coordinate, if that is of times."""
    clocks = {each.path: each for each in variables}
    times: dict[str, tuple[Array, datetime | None, str] | None] = {}

    def one(variable: Variable, path: str, _: Told) -> list[RecordedChannel]:
        table, clock = _decoded(variable), variable.coordinate or ""
        if table.size < 2:
            return []
        if table.ndim == 2 and table.shape[1] > table.shape[0] and not clock:
            table = table.T
        if clock in clocks and clock not in times:
            times[clock] = _as_times(clocks[clock], unit)
        time, start, how = times.get(clock) or (None, None, "")
        if time is None or time.size != len(table):
            time, start = None, None
        is_clock = time is not None and clock == path
        if is_clock:
            told.notes.append(f'"{clock}" is the coordinate of a dimension ({how})')
        units = str(variable.attributes.get("units", variable.attributes.get("unit", ""))).strip() or None
        *groups, name = path.split("/")
        return [
            RecordedChannel(name + number, units, values, time, path + number, is_clock, tuple(groups), start)
            for number, values in columns_of(table).items()
        ]

    columns = told.parts(one, {each.path: (each.path, each) for each in variables})
    return list(chain.from_iterable(columns.values()))


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float, np.number))


def _decoded(variable: Variable) -> Array:
    """Values with what the CF conventions say of them: missing ones, factor and offset of packed numbers."""
    known = {name: value for name, value in variable.attributes.items() if _is_number(value)}
    decoded = np.array(variable.values, dtype=np.float64)
    for name in ("_FillValue", "missing_value"):
        if name in known:
            decoded[variable.values == known[name]] = np.nan
    decoded = decoded * float(known["scale_factor"]) if "scale_factor" in known else decoded
    return decoded + float(known["add_offset"]) if "add_offset" in known else decoded


def _as_times(coordinate: Variable, unit: str | None) -> tuple[Array, datetime | None, str] | None:
    """Understand a coordinate as times: `seconds since …`, or a unit of time; None if it is neither."""
    values = _decoded(coordinate).ravel()
    known = values[np.isfinite(values)]
    said = unit or str(coordinate.attributes.get("units", ""))
    since = SINCE.fullmatch(said)
    factor = {**TIME_UNITS, **DAYS}.get((since["unit"] if since else said).casefold())
    if factor is None or not known.size:
        return None
    if since is None:
        return values * factor, None, f"in {said}"
    start = _moment(since["moment"], known[0] * factor)
    how = f'"{said}", counted from the first' if start else f'"{said}", whose date is not understood'
    return (values - known[0]) * factor, start, how


def _moment(text: str, later: float) -> datetime | None:
    """Date and time, `later` s after the one that is written, in its zone; without one it is in UTC, as CF says."""
    import pandas as pd

    try:
        moment = pd.Timestamp(text.strip()) + pd.Timedelta(later, unit="s")
    except (ValueError, OverflowError):
        return None
    zoned = moment.tz_localize(UTC) if moment.tzinfo is None else moment
    return zoned.to_pydatetime(warn=False)


FORMAT = Format(
    name="netcdf",
    summary="NetCDF (classic and NetCDF-4) and HDF5: variables of all groups, CF units and times.",
    suffixes=(".nc", ".cdf", ".h5", ".hdf5"),
    options=NetcdfOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
