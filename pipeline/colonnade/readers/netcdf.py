"""NetCDF of every version and plain HDF5, with units and times as the CF conventions write them."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from colonnade.errors import ReadError
from colonnade.readers.clock import in_seconds
from colonnade.readers.magic import HDF5, by_mark, head
from colonnade.readers.netcdf_content import Variable, read_classic, read_hdf5
from colonnade.readers.recording import TIME_UNITS, Array, RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.values import TimeUnit, as_values
from colonnade.readers.vector_clocks import Clocks, Column, find_clocks

CLASSIC = (b"CDF\x01", b"CDF\x02", b"CDF\x05")
MOST_COLUMNS = 1000
"""Of one variable; a wider one is no table of channels."""
SINCE = re.compile(r"(?P<unit>\w+)\s+since\s+(?P<moment>.+)", re.IGNORECASE)
DAYS = {"d": 86400.0, "day": 86400.0, "days": 86400.0, "ns": 1e-9, "nanosecond": 1e-9, "nanoseconds": 1e-9}


class NetcdfOptions(BaseModel):
    """What can be said about a NetCDF or HDF5 file."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    group: str | None = Field(default=None, description="The only group that is read, with those in it.")
    time: str | int | None = Field(
        default=None, description="Variable, by name or number from 1, that is the clock of those as long as it."
    )
    time_unit: TimeUnit | None = Field(default=None, description="Unit of the times.")


def recognise(path: Path) -> Recognition:
    """Say whether a file is NetCDF or HDF5, by its first bytes."""
    return by_mark(path, (*CLASSIC, HDF5), "the mark of NetCDF or HDF5")


def read(path: Path, options: NetcdfOptions) -> Recording:
    """
    Read a NetCDF or HDF5 file.

    Raises
    ------
    ReadError
        If it is neither, is damaged, holds no column of numbers, or lacks a group or variable that the options name.
    """
    recognition = recognise(path)
    if not recognition.yes:
        raise ReadError(f"{path.name}: {recognition.reason}.")
    content = read_classic(path) if head(path).startswith(CLASSIC) else read_hdf5(path)
    within = "" if options.group is None else options.group.strip("/") + "/"
    variables = [each for each in content.variables if each.path.startswith(within)]
    columns, channels, warnings, left_out = _columns(variables)
    left_out = [f"{place} is left out: {why}" for place, why in content.left_out.items()] + left_out
    if not channels:
        where = "in it" if options.group is None else f'in group "{options.group}"'
        raise ReadError("\n  ".join([f"{path.name}: no column of numbers {where}.", *content.warnings, *left_out]))
    recording = Recording(path, "netcdf", tuple(channels))
    scalars = _scalars(variables, content.attributes)
    clocks = _clocks(recording, columns, variables, scalars, options)
    return replace(
        recording,
        channels=tuple(
            replace(channel, time=time, is_clock=number in clocks.columns)
            for number, (channel, time) in enumerate(zip(channels, clocks.times, strict=True))
        ),
        start=clocks.start,
        notes=(*clocks.notes, *left_out),
        warnings=(*content.warnings, *warnings, *clocks.warnings),
    )


def _columns(
    variables: list[Variable],
) -> tuple[list[Column], list[RecordedChannel], list[str], list[str]]:
    """Take variables apart into columns along their first dimension, missing values as NaN, scaled as they say."""
    columns: list[Column] = []
    units: list[str | None] = []
    warnings: list[str] = []
    left_out: list[str] = []
    for variable in variables:
        if variable.values.size < 2:
            continue
        if variable.values.ndim > 2 or (variable.values.ndim == 2 and min(variable.values.shape) > MOST_COLUMNS):
            size = " × ".join(map(str, variable.values.shape))
            left_out.append(f"{variable.path} is left out: an array of {size} is no set of channels")
            continue
        values, infinite = as_values(_decoded(variable).ravel())
        warnings += [f"{variable.path}: {infinite}"] if infinite else []
        shape = variable.values.shape
        table = values.reshape(shape)
        if len(shape) == 2 and shape[1] > shape[0] and variable.dimensions[:1] == (None,):
            table = table.T
        unit = str(variable.attributes.get("units", variable.attributes.get("unit", ""))).strip() or None
        parts = [table] if table.ndim == 1 else list(table.T)
        for number, part in enumerate(parts, 1):
            place = variable.path if table.ndim == 1 else f"{variable.path}[{number}]"
            columns.append(Column(place, variable.groups, part, place.rpartition("/")[2], unit))
            units.append(unit)
    counts = Counter(column.name for column in columns)
    channels = [
        RecordedChannel(
            column.name if column.name and counts[column.name] == 1 else column.path,
            unit,
            np.ascontiguousarray(column.values),
            heading=column.path,
        )
        for column, unit in zip(columns, units, strict=True)
    ]
    return columns, channels, warnings, left_out


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


def _clocks(
    recording: Recording,
    columns: list[Column],
    variables: list[Variable],
    scalars: dict[str, float],
    options: NetcdfOptions,
) -> Clocks:
    """Times of the columns: as given; else by their dimension's coordinate; else as in any file of vectors."""
    if options.time is not None:
        clock = recording.channel(options.time)
        seconds, how = in_seconds(clock, options.time_unit or clock.unit)
        if not np.isfinite(seconds).any():
            raise ReadError(
                f"{recording.path.name}: {clock.heading} holds no number, so it cannot be the clock. "
                "Name a variable of times."
            )
        number = next(index for index, channel in enumerate(recording.channels) if channel is clock)
        times = [seconds if column.values.size == seconds.size else None for column in columns]
        return Clocks(frozenset((number,)), times, None, (f"clock: {clock.heading}, as given ({how})",), ())
    by_path = {column.path: number for number, column in enumerate(columns)}
    dimension = {each.path: each.dimensions[0] for each in variables if each.dimensions}
    coordinates: dict[int, tuple[Array, datetime | None, str]] = {}
    for number in {by_path[name] for name in dimension.values() if name in by_path}:
        if (understood := _as_times(columns[number], options.time_unit)) is not None:
            coordinates[number] = understood
    rest = find_clocks(columns, scalars, options.time_unit)
    times, notes, start = list(rest.times), [], rest.start
    for number, (seconds, moment, how) in coordinates.items():
        notes.append(f"clock: {columns[number].path}, the coordinate of a dimension ({how})")
        start = moment or start
        for index, column in enumerate(columns):
            own = dimension.get(column.path.partition("[")[0])
            if own is not None and by_path.get(own) == number and column.values.size == seconds.size:
                times[index] = seconds
    others = [note for note in rest.notes if not coordinates or not note.startswith(("no clock", "clock:"))]
    covered = all(time is not None for time in times)
    return Clocks(
        rest.columns | frozenset(coordinates),
        times,
        start,
        (*notes, *(others if covered else rest.notes)),
        rest.warnings,
    )


def _as_times(column: Column, unit: str | None) -> tuple[Array, datetime | None, str] | None:
    """Understand a coordinate as times: `seconds since …`, or a unit of time; None where it is neither."""
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
    how = f'"{told}", counted from the first' if moment else f'"{told}", of which the date is not understood'
    return (values - first) * factor, moment, how


def _moment(text: str, later: float) -> datetime | None:
    """Date and time, in UTC, `later` s after the one that is written."""
    import pandas as pd

    try:
        origin = pd.Timestamp(text.strip())
        moment = origin + pd.Timedelta(later, unit="s")
    except (ValueError, OverflowError):
        return None
    zoned = moment.tz_localize("UTC") if moment.tzinfo is None else moment.tz_convert("UTC")
    return zoned.to_pydatetime(warn=False).astimezone(UTC)


FORMAT = Format(
    name="netcdf",
    summary="NetCDF (classic and NetCDF-4) and HDF5: variables of all groups, CF units and times.",
    suffixes=(".nc", ".cdf", ".h5", ".hdf5"),
    options=NetcdfOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
