"""C3D, as optical systems write it: three columns for each marker, and the analog channels recorded beside them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording

MARK = 0x50
"""Second byte of every C3D file; the first is the block of 512 bytes in which its parameters begin."""

PROCESSORS = {b"\x54": "<", b"\x55": "<", b"\x56": ">"}
"""Kinds of processor by which numbers are written, and their order of bytes."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file has C3D's mark, there and where its parameters begin."""
    first = head.content[:2]
    is_c3d = len(first) == 2 and first[1] == MARK and first[0] > 1
    place = 512 * (first[0] - 1) + 3 if is_c3d else 0
    if is_c3d and head.content[place : place + 1] in PROCESSORS:
        return Recognition(True, "it has the marks of C3D")
    return Recognition(False, "it does not have the marks of C3D")


def read(path: Path, options: Options) -> Recording:
    """Read markers and analog channels; a marker that was not seen is NaN."""
    from ezc3d import c3d

    head = recognise.expected(path).content
    place = 512 * (head[0] - 1) + 3
    # The library takes what is there for all there was, and may not come to an end where parameters are missing.
    header = np.frombuffer(head[:18], PROCESSORS[head[place : place + 1]] + "u2").tolist()
    announced, begin, size = header[4] - header[3] + 1, 512 * (header[8] - 1), path.stat().st_size
    if size < begin:
        raise ReadError(
            f"{path.name}: it ends after {size} bytes, before its data begin at byte {begin}: a recording or copy was "
            "interrupted. Export it again."
        )
    file = c3d(str(path))
    points, analogs = (np.asarray(file["data"][kind], dtype=np.float64) for kind in ("points", "analogs"))
    channels: list[RecordedChannel] = []
    notes = []
    for group, what, axes, values in (
        ("POINT", "marker", (" X", " Y", " Z"), points),
        ("ANALOG", "analog", ("",), analogs),
    ):
        given = file["parameters"].get(group, {})
        rate = next((each for each in _values(given, "RATE") if isinstance(each, (int, float)) and each > 0.0), np.nan)
        if values.shape[1] and np.isfinite(rate):
            notes.append(f"clock of the {what} channels: {rate:.9g} Hz, by the rate in the file")
            times = even_times(values.shape[2], 1.0 / rate)
        else:
            times = None
        labels, units = ([str(each).strip() for each in _values(given, name)] for name in ("LABELS", "UNITS"))
        count = values.shape[1]
        labels += [""] * count
        units = units * count if len(units) == 1 else units + [""] * count  # one unit is that of all
        for number in range(count):
            label, unit = labels[number] or f"{what} {number + 1}", units[number] or None
            for row, axis in enumerate(axes):
                column = values[row, number]
                channels.append(
                    RecordedChannel(label + axis, unit, np.where(np.isfinite(column), column, np.nan), times)
                )
    warnings = []
    if announced > points.shape[2]:
        warnings.append(f"it ends after {points.shape[2]} of {announced} frames: a recording or a copy was interrupted")
    return Recording(path, "c3d", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _values(given: Mapping[str, Any], name: str) -> list[Any]:
    """Give the values of a parameter; none where it is missing."""
    return [*np.ravel(given.get(name, {}).get("value", ())).tolist()]


FORMAT = Format(
    name="c3d",
    summary="C3D of optical systems: three columns for each marker (X, Y, Z), and analog channels.",
    suffixes=(".c3d",),
    recognise=recognise,
    read=read,
    modules=("ezc3d",),
)
