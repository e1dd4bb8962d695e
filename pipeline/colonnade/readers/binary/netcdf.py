"""NetCDF of every version and plain HDF5, with units and times as the CF conventions write them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.binary.hdf5 import Walk, open_hdf5
from colonnade.readers.binary.numbers import ClockOptions, UnreadableError, recorded
from colonnade.readers.clock import Clocks, find_vector_clocks, given_clock
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import HDF5, NETCDF, Head, by_mark, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording

if TYPE_CHECKING:
    import h5py

HIDDEN = frozenset(("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates"))
SCALE = "DIMENSION_SCALE"
DIMENSION_ONLY = "This is a netCDF dimension but not a netCDF variable"
MOST_COLUMNS = 1000
"""Of one variable; a wider one does not hold channels."""
SINCE = re.compile(r"(?P<unit>\w+)\s+since\s+(?P<moment>.+)", re.IGNORECASE)
DAYS = {"d": 86400.0, "day": 86400.0, "days": 86400.0, "ns": 1e-9, "nanosecond": 1e-9, "nanoseconds": 1e-9}


@dataclass(frozen=True)
class Variable:
    """
    An array of numbers.

    Attributes
    ----------
    path : str
        With its groups: `run/top`.
    values : ndarray
        As stored.
    dimensions : tuple of (str or None)
        Name of each, if it has one.
    attributes : dict
    """

    path: str
    values: NDArray[Any]
    dimensions: tuple[str | None, ...]
    attributes: dict[str, Any]

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups that contain it, outermost first."""
        return tuple(self.path.split("/")[:-1])


class Content(Walk):
    """
    What a file holds.

    Attributes
    ----------
    variables : list of Variable
    attributes : dict
        Of the file.
    """

    def __init__(self) -> None:
        super().__init__()
        self.variables: list[Variable] = []
        self.attributes: dict[str, Any] = {}

    def dataset(self, dataset: h5py.Dataset, path: str, around: tuple[int, ...]) -> None:
        """Add a dataset; a table gives each of its columns of numbers."""
        kinds = dataset.dtype
        if kinds.kind not in "fiub" and not (kinds.names and dataset.ndim == 1):
            raise UnreadableError("it holds no numbers")
        # Each attribute is read once: a text whose length is damaged costs up to 4 GB before it is refused.
        kept = dict(_items(dataset.attrs))
        if DIMENSION_ONLY in str(kept.get("NAME", b"")):
            return
        if not kinds.names:
            self.variables.append(Variable(path, dataset[()], _dimensions(dataset, kept), _attributes(kept.items())))
            return
        table = dataset[()]
        for name in kinds.names:
            if kinds[name].kind in "fiub" and kinds[name].shape == ():
                self.variables.append(Variable(f"{path}/{name}", np.array(table[name]), (path,), {}))
            else:
                self.left_out[f"{path}/{name}"] = "it holds no numbers"


def read_hdf5(path: Path) -> Content:
    """
    Read NetCDF-4, or any other HDF5 file.

    Raises
    ------
    ReadError
        As `open_hdf5`.
    """
    content = Content()
    with open_hdf5(path) as file:
        content.attributes = _attributes(_items(file.attrs))
        content.read(file)
    return content


def read_classic(path: Path) -> Content:
    """
    Read NetCDF of the classic format.

    Raises
    ------
    ReadError
        If it is of the variant for very large variables (CDF-5).
    """
    from scipy.io import netcdf_file

    with path.open("rb") as stream:
        if stream.read(4) == b"CDF\x05":
            raise ReadError(
                f"{path.name}: it is NetCDF of the variant CDF-5, which is not read. Convert it: nccopy -k nc4 "
                f"{path.name} converted.nc"
            )
        stream.seek(0)
        file = netcdf_file(stream, mmap=False)
        content = Content()
        content.attributes = _attributes(file._attributes.items())
        for name, variable in file.variables.items():
            if variable.data.dtype.kind not in "fiu":
                content.left_out[name] = "it holds text"
                continue
            values = np.array(variable.data, dtype=variable.data.dtype.newbyteorder("="))
            content.variables.append(
                Variable(name, values, tuple(variable.dimensions), _attributes(variable._attributes.items()))
            )
    return content


def _dimensions(dataset: h5py.Dataset, kept: dict[str, Any]) -> tuple[str | None, ...]:
    """
    Paths of the variables that are the dataset's dimensions, by its attributes; of a coordinate it is its own.

    Taken from the attributes in which they are kept: HDF5's own functions for them end the process where those are
    damaged.
    """
    if SCALE in str(kept.get("CLASS", "")):
        return (str(dataset.name).strip("/"), *(None,) * (dataset.ndim - 1))
    scales = np.atleast_1d(kept.get("DIMENSION_LIST", np.empty(0, dtype=object)))
    if scales.shape != (dataset.ndim,):
        return tuple(None for _ in dataset.shape)
    return tuple(str(dataset.file[axis[0]].name).strip("/") if len(axis) else None for axis in scales)


def _items(attributes: Any) -> Iterator[tuple[str, Any]]:
    for name in attributes:
        try:
            yield name, attributes[name]
        except (OSError, RuntimeError, ValueError, TypeError, KeyError, UnicodeError):
            continue  # an attribute that cannot be read says nothing


def _attributes(items: Any) -> dict[str, Any]:
    """Attributes as text or numbers."""
    plain = {}
    for name, value in items:
        if name in HIDDEN:
            continue
        if isinstance(value, np.ndarray) and value.size == 1:
            value = value.ravel()[0]
        plain[name] = value.decode("utf-8", "replace") if isinstance(value, bytes) else value
    return plain


class NetcdfOptions(ClockOptions):
    """What can be said about a NetCDF or HDF5 file."""

    group: str | None = Field(default=None, description="Read only this group and those in it.")


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is NetCDF or HDF5, by its first bytes."""
    return by_mark(head, (*NETCDF, HDF5), "the mark of NetCDF or HDF5")


def read(path: Path, options: NetcdfOptions) -> Recording:
    """
    Read a NetCDF or HDF5 file.

    Raises
    ------
    ReadError
        If it is neither, is damaged, holds no column of numbers, or lacks a group or variable that the options name.
    """
    is_classic = recognise.expected(path).content.startswith(NETCDF)
    content = read_classic(path) if is_classic else read_hdf5(path)
    within = "" if options.group is None else options.group.strip("/") + "/"
    variables = [each for each in content.variables if each.path.startswith(within)]
    columns, left_out = _columns(variables)
    left_out = [f"{place} is left out: {why}" for place, why in content.left_out.items()] + left_out
    if not columns:
        where = "in it" if options.group is None else f'in group "{options.group}"'
        raise ReadError("\n  ".join([f"{path.name}: no column of numbers {where}.", *content.warnings, *left_out]))
    recording = recorded(path, "netcdf", columns)
    if options.time is None:
        scalars = _scalars(variables, content.attributes)
        clocks = find_vector_clocks(recording.channels, scalars, options.time_unit)
        clocks = _by_coordinates(recording.channels, variables, clocks, options.time_unit)
    else:
        clocks = given_clock(recording, options.time, options.time_unit)
    recording = clocks.applied(replace(recording, warnings=(*content.warnings, *recording.warnings)))
    return replace(recording, notes=(*recording.notes, *left_out))


def _columns(variables: list[Variable]) -> tuple[list[RecordedChannel], list[str]]:
    """Take variables apart into columns along their first dimension, and say which are left out."""
    columns: list[RecordedChannel] = []
    left_out: list[str] = []
    for variable in variables:
        shape = variable.values.shape
        if variable.values.size < 2:
            continue
        if len(shape) > 2 or (len(shape) == 2 and min(shape) > MOST_COLUMNS):
            size = " × ".join(map(str, shape))
            left_out.append(f"{variable.path} is left out: an array of {size} is not a set of channels")
            continue
        table = _decoded(variable)
        if len(shape) == 2 and shape[1] > shape[0] and variable.dimensions[:1] == (None,):
            table = table.T
        unit = str(variable.attributes.get("units", variable.attributes.get("unit", ""))).strip() or None
        parts = {variable.path: table}
        if table.ndim == 2:
            parts = {f"{variable.path}[{number}]": part for number, part in enumerate(table.T, 1)}
        for place, part in parts.items():
            name = place.rpartition("/")[2]
            columns.append(RecordedChannel(name, unit, part, heading=place, scope=variable.groups))
    return columns, left_out


def _decoded(variable: Variable) -> Array:
    """Values with what the CF conventions say of them: missing ones, factor and offset of packed numbers."""
    values = variable.values
    missing = np.zeros(values.shape, dtype=bool)
    for name in ("_FillValue", "missing_value"):
        told = variable.attributes.get(name)
        if isinstance(told, (int, float, np.number)):
            missing |= values == told
    decoded = np.array(values, dtype=np.float64)
    decoded[missing] = np.nan
    factor, offset = (variable.attributes.get(name) for name in ("scale_factor", "add_offset"))
    if isinstance(factor, (int, float, np.number)):
        decoded *= float(factor)
    if isinstance(offset, (int, float, np.number)):
        decoded += float(offset)
    return decoded


def _scalars(variables: list[Variable], attributes: dict[str, Any]) -> dict[str, float]:
    """Single numbers of the file and of its attributes, by name."""
    found = {each.path.replace("/", "."): float(each.values.ravel()[0]) for each in variables if each.values.size == 1}
    for name, value in attributes.items():
        if isinstance(value, (int, float, np.number)):
            found[name] = float(value)
    return found


def _by_coordinates(
    columns: Sequence[RecordedChannel], variables: list[Variable], found: Clocks, unit: str | None
) -> Clocks:
    """Let columns go by the coordinate of their first dimension if that is of times; else by the clocks found."""
    coordinates = _coordinates(columns, variables)
    times, start, notes = list(found.times), found.start, []
    used = set()
    for coordinate in sorted(set(coordinates) - {-1}):
        understood = _as_times(columns[coordinate], unit)
        if understood is None:
            continue
        seconds, moment, how = understood
        start = moment or start
        used.add(coordinate)
        notes.append(f"clock: {columns[coordinate].heading}, the coordinate of a dimension ({how})")
        for number, column in enumerate(columns):
            if coordinates[number] == coordinate and column.values.size == seconds.size:
                times[number] = seconds
    others = found.notes
    if used and all(time is not None for time in times):  # then no column needs a clock that was found
        others = tuple(note for note in others if not note.startswith(("no clock", "clock:")))
    return replace(found, columns=found.columns | used, times=tuple(times), notes=(*notes, *others), start=start)


def _coordinates(columns: Sequence[RecordedChannel], variables: list[Variable]) -> list[int]:
    """Of each column the number of the one that is the coordinate of its first dimension; -1 where none is."""
    numbers = {column.heading: number for number, column in enumerate(columns)}
    dimensions = {each.path: each.dimensions[0] or "" for each in variables if each.dimensions}
    return [numbers.get(dimensions.get(column.heading.partition("[")[0], ""), -1) for column in columns]


def _as_times(column: RecordedChannel, unit: str | None) -> tuple[Array, datetime | None, str] | None:
    """Understand a coordinate as times: `seconds since …`, or a unit of time; None if it is neither."""
    values = np.asarray(column.values, dtype=np.float64)
    told = unit or column.unit or ""
    since = SINCE.fullmatch(told)
    factor = {**TIME_UNITS, **DAYS}.get((since["unit"] if since else told).casefold())
    if factor is None or not np.isfinite(values).any():
        return None
    if since is None:
        return values * factor, None, f"in {told}"
    first = float(values[np.isfinite(values)][0])
    moment = _moment(since["moment"], first * factor)
    how = f'"{told}", counted from the first' if moment else f'"{told}", whose date is not understood'
    return (values - first) * factor, moment, how


def _moment(text: str, later: float) -> datetime | None:
    """Date and time, `later` s after the one that is written, in its zone; without one it is in UTC, as CF says."""
    import pandas as pd

    try:
        origin = pd.Timestamp(text.strip())
        moment = origin + pd.Timedelta(later, unit="s")
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
