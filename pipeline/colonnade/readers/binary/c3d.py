"""C3D, as optical systems write it: three columns for each marker, and the analog channels recorded beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.arrays import Array
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
    of_points, of_analogs = file["parameters"].get("POINT", {}), file["parameters"].get("ANALOG", {})
    markers = [
        (f"{name} {axis}", unit, points[row, place])
        for place, (name, unit) in enumerate(_labels(of_points, points.shape[1], "marker"))
        for row, axis in enumerate("XYZ")
    ]
    named = _labels(of_analogs, analogs.shape[1], "analog")
    recorded = [(name, unit, analogs[0, place]) for place, (name, unit) in enumerate(named)]
    channels, notes = [], []
    for columns, given, what in ((markers, of_points, "markers"), (recorded, of_analogs, "analog channels")):
        rate = _number(given, "RATE")
        if columns and rate > 0.0:
            notes.append(f"clock of the {what}: {rate:.9g} Hz, by the rate in the file")
        times = even_times(columns[0][2].size, 1.0 / rate) if columns and rate > 0.0 else None
        channels += [
            RecordedChannel(name, unit, np.where(np.isfinite(each), each, np.nan), times)
            for name, unit, each in columns
        ]
    warnings = []
    if announced > points.shape[2]:
        warnings.append(f"it ends after {points.shape[2]} of {announced} frames: a recording or a copy was interrupted")
    return Recording(path, "c3d", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _labels(given: Mapping[str, Any], count: int, otherwise: str) -> Iterator[tuple[str, str | None]]:
    """Give name and unit of each of `count` channels; labels beyond the 255th are in LABELS2, LABELS3 …."""
    more = (f"{number}" for number in range(2, 2 + count // 255))
    labels = [str(label).strip() for part in ("", *more) for label in given.get(f"LABELS{part}", {}).get("value", ())]
    units = [str(unit).strip() for unit in given.get("UNITS", {}).get("value", ())]
    for number in range(count):
        name = labels[number] if number < len(labels) else ""
        # One unit is that of all.
        unit = units[0] if len(units) == 1 else units[number] if number < len(units) else ""
        yield name or f"{otherwise} {number + 1}", unit or None


def _number(given: Mapping[str, Any], name: str) -> float:
    """Give a parameter that is one number; 0 where it is missing or damaged."""
    values: Array = np.asarray(given.get(name, {}).get("value", ()))
    found = float(values.flat[0]) if values.size and values.dtype.kind in "iuf" else 0.0
    return found if np.isfinite(found) else 0.0


FORMAT = Format(
    name="c3d",
    summary="C3D of optical systems: three columns for each marker (X, Y, Z), and analog channels.",
    suffixes=(".c3d",),
    recognise=recognise,
    read=read,
    modules=("ezc3d",),
)
