"""MATLAB files of versions 5 to 7 and 7.3: vectors, matrices, structs and cells of numbers as channels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pydantic import Field

from colonnade.errors import ReadError, nearest
from colonnade.readers.binary.matlab_5 import read_v5
from colonnade.readers.binary.matlab_73 import read_v73
from colonnade.readers.binary.matlab_columns import Node, Tree, find_columns, lacking_channels, numbered_channels
from colonnade.readers.binary.numbers import ClockOptions, recorded
from colonnade.readers.clock import find_vector_clocks, given_clock
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import HDF5, Head, from_head
from colonnade.readers.recording import Recording

MARK = b"MATLAB "
USER_BLOCK = 512
"""Bytes before HDF5's own start in a file of version 7.3."""


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
    if first.startswith(MARK):
        return Recognition(
            False, f"it starts like a MATLAB file, but its header is damaged or cut off ({len(first)} bytes)"
        )
    is_old = head.path.suffix.casefold() == ".mat" and not head.look()
    what = "; if it is one of version 4, open it in MATLAB and save it again" if is_old else ""
    return Recognition(False, f'it does not start with "MATLAB 5.0" or "MATLAB 7.3"{what}')


def read(path: Path, options: MatlabOptions) -> Recording:
    """
    Read a MATLAB file.

    Raises
    ------
    ReadError
        If it is not MATLAB's, is damaged, holds no column of numbers, or lacks a variable that the options name.
    """
    first = recognise.expected(path).content
    tree = read_v73(path) if first[USER_BLOCK:].startswith(HDF5) else read_v5(path)
    chosen = _chosen(path, tree, options.variables)
    others, columns, scalars, notes = numbered_channels(chosen)
    found = find_columns(others)
    columns = [*columns, *found.columns]
    left_out = [f"{place} is left out: {why}" for place, why in {**tree.left_out, **found.left_out}.items()]
    if not columns:
        raise ReadError(_nothing(path, tree, left_out))
    warnings = [*tree.warnings, *lacking_channels(chosen, columns)]
    recording = recorded(path, "matlab", columns)
    if options.time is None:
        clocks = find_vector_clocks(recording.channels, {**found.scalars, **scalars}, options.time_unit)
    else:
        clocks = given_clock(recording, options.time, options.time_unit)
    recording = clocks.applied(replace(recording, notes=tuple(notes), warnings=(*warnings, *recording.warnings)))
    return replace(recording, notes=(*recording.notes, *left_out))


def _chosen(path: Path, tree: Tree, wanted: tuple[str, ...]) -> dict[str, Node]:
    """Take the variables that were asked for."""
    for name in wanted:
        if name in tree.left_out and name not in tree.variables:
            raise ReadError(f"{path.name}: {name} cannot be read: {tree.left_out[name]}.")
        if name not in tree.variables:
            raise ReadError(f'{path.name}: variable "{name}" not found.{nearest(name, tree.variables)}')
    return {name: node for name, node in tree.variables.items() if not wanted or name in wanted}


def _nothing(path: Path, tree: Tree, left_out: list[str]) -> str:
    held = ", ".join(list(tree.variables)[:8]) or "no variable"
    reasons = "\n  ".join([*tree.warnings, *left_out])
    return f"{path.name}: no column of numbers in it; it holds {held}." + (f"\n  {reasons}" if reasons else "")


FORMAT = Format(
    name="matlab",
    summary="MATLAB .mat of versions 5 to 7.3: vectors, matrices, structs; Simulink's and Bristol's layouts.",
    suffixes=(".mat",),
    options=MatlabOptions,
    recognise=recognise,
    read=read,
    modules=("h5py", "scipy.io"),
)
