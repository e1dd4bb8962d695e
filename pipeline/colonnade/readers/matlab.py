"""MATLAB files of versions 5 to 7 and 7.3: vectors, matrices, structs and cells of numbers as channels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from colonnade.errors import ReadError, nearest
from colonnade.readers.clock import in_seconds
from colonnade.readers.magic import HDF5, head, look
from colonnade.readers.matlab_bristol import lacking_channels, numbered_channels
from colonnade.readers.matlab_columns import find_columns, named
from colonnade.readers.matlab_hdf5 import read_v73
from colonnade.readers.matlab_tree import Node, Tree
from colonnade.readers.matlab_v5 import read_v5
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.values import TimeUnit, as_values
from colonnade.readers.vector_clocks import Clocks, Column, find_clocks

MARK = b"MATLAB "
USER_BLOCK = 512
"""Bytes before HDF5's own start in a file of version 7.3."""


class MatlabOptions(BaseModel):
    """What can be said about a MATLAB file; all of it is found where it is not said."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    time: str | int | None = Field(
        default=None, description="Vector, by name or number from 1, that is the clock of those as long as it."
    )
    time_unit: TimeUnit | None = Field(default=None, description="Unit of the times.")
    variables: tuple[str, ...] = Field(default=(), description="Variables that are read; all of them otherwise.")


def recognise(path: Path) -> Recognition:
    """Say whether a file is MATLAB's, by its first bytes."""
    first = head(path)
    if first[USER_BLOCK:].startswith(HDF5) and first.startswith(MARK):
        return Recognition(True, "starts as a MATLAB file of version 7.3")
    if first.startswith(MARK) and first[126:128] in (b"IM", b"MI"):
        return Recognition(True, "starts as a MATLAB file of version 5 to 7")
    if first.startswith(MARK):
        return Recognition(
            False, f"it starts like a MATLAB file, but its header is damaged or cut off ({len(first)} bytes)"
        )
    what = look(first)
    if not what and path.suffix.casefold() == ".mat":
        what = "if it is one of version 4, open it in MATLAB and save it again"
    return Recognition(False, 'it does not start with "MATLAB 5.0" or "MATLAB 7.3"' + (f"; {what}" if what else ""))


def read(path: Path, options: MatlabOptions) -> Recording:
    """
    Read a MATLAB file.

    Raises
    ------
    ReadError
        If it is not MATLAB's, is damaged, holds no column of numbers, or lacks a variable that the options name.
    """
    recognition = recognise(path)
    if not recognition.yes:
        raise ReadError(f"{path.name}: {recognition.reason}.")
    tree = read_v73(path) if head(path)[USER_BLOCK:].startswith(HDF5) else read_v5(path)
    chosen = _chosen(path, tree, options.variables)
    others, columns, scalars, notes = numbered_channels(chosen)
    found = find_columns(others)
    columns = named([*columns, *found.columns])
    left_out = [f"{place} is left out: {why}" for place, why in {**tree.left_out, **found.left_out}.items()]
    if not columns:
        raise ReadError(_nothing(path, tree, left_out))
    warnings = [*tree.warnings, *lacking_channels(chosen, columns)]
    recording, infinite = _recorded(path, columns)
    if options.time is None:
        clocks = find_clocks(columns, {**found.scalars, **scalars}, options.time_unit)
    else:
        clocks = _given(recording, columns, options.time, options.time_unit)
    channels = tuple(
        replace(channel, time=time, is_clock=number in clocks.columns)
        for number, (channel, time) in enumerate(zip(recording.channels, clocks.times, strict=True))
    )
    return replace(
        recording,
        channels=channels,
        start=clocks.start,
        notes=(*notes, *clocks.notes, *left_out),
        warnings=(*warnings, *clocks.warnings, *infinite),
    )


def _chosen(path: Path, tree: Tree, wanted: tuple[str, ...]) -> dict[str, Node]:
    """Take the variables that were asked for."""
    for name in wanted:
        if name in tree.left_out and name not in tree.variables:
            raise ReadError(f"{path.name}: {name} cannot be read: {tree.left_out[name]}.")
        if name not in tree.variables:
            raise ReadError(f'{path.name}: there is no variable "{name}".{nearest(name, tree.variables)}')
    return {name: node for name, node in tree.variables.items() if not wanted or name in wanted}


def _nothing(path: Path, tree: Tree, left_out: list[str]) -> str:
    held = ", ".join(list(tree.variables)[:8]) or "no variable"
    reasons = "\n  ".join([*tree.warnings, *left_out])
    return f"{path.name}: no column of numbers in it; it holds {held}." + (f"\n  {reasons}" if reasons else "")


def _recorded(path: Path, columns: list[Column]) -> tuple[Recording, list[str]]:
    channels, warnings = [], []
    for column in columns:
        values, infinite = as_values(column.values)
        channels.append(RecordedChannel(column.name or column.path, column.unit, values, heading=column.path))
        warnings += [f"{column.path}: {infinite}"] if infinite else []
    return Recording(path, "matlab", tuple(channels)), warnings


def _given(recording: Recording, columns: list[Column], time: str | int, unit: str | None) -> Clocks:
    """Put the columns on the clock that the options name."""
    clock = recording.channel(time)
    if not np.isfinite(clock.values).any():
        raise ReadError(
            f"{recording.path.name}: {clock.heading} holds no number, so it cannot be the clock. Name a vector of "
            "times."
        )
    number = next(index for index, channel in enumerate(recording.channels) if channel is clock)
    seconds, how = in_seconds(clock, unit or clock.unit)
    times = [seconds if column.values.size == seconds.size else None for column in columns]
    others = sum(each is None for each in times)
    warnings = (f"{others} vectors are not as long as {clock.heading} and have no clock",) if others else ()
    return Clocks(frozenset((number,)), times, None, (f"clock: {clock.heading}, as given ({how})",), warnings)


FORMAT = Format(
    name="matlab",
    summary="MATLAB .mat of versions 5 to 7.3: vectors, matrices, structs; Simulink's and Bristol's layouts.",
    suffixes=(".mat",),
    options=MatlabOptions,
    recognise=recognise,
    read=read,
    modules=("h5py",),
)
