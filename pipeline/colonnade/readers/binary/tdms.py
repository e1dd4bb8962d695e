"""LabVIEW TDMS: every channel with the unit and the clock that its own properties give; what a cut file lacks."""

from __future__ import annotations

import logging
import struct
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError, count, nearest
from colonnade.readers.binary.numbers import Told, recorded
from colonnade.readers.clock import ClockOptions
from colonnade.readers.format import Format
from colonnade.readers.head import by_mark
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.heading import take_apart

if TYPE_CHECKING:
    from nptdms import TdmsChannel

LEAD_IN = 28
"""Bytes in front of each segment: mark, flags, version, length of the segment and of its description."""
BIG_ENDIAN = 1 << 6
UNIT_PROPERTIES = ("unit_string", "ni_unitdescription", "unit", "units")
"""Names, in lower case, of the property that holds a channel's unit, the most usual first."""
NO_TIMING = 1.0
"""Step, s, that LabVIEW writes by default: it yields to a channel of times."""


class TdmsOptions(ClockOptions):
    """Options of a TDMS file; what is not given is detected."""

    group: str | None = Field(default=None, description="Read only this group; by default all of them.")


recognise = by_mark((b"TDSm",), "TDSm, the mark of LabVIEW's TDMS")


def read(path: Path, options: TdmsOptions) -> Recording:
    """Read a TDMS file; text and other samples that are not numbers are left out."""
    from nptdms import TdmsFile
    from nptdms.log import log_manager

    recognise.expected(path)
    log_manager.set_level(logging.CRITICAL)  # what it would print is said by `_cut_off`
    with path.open("rb") as stream:  # by its path, npTDMS would use a .tdms_index next to it, be it another file's
        file = TdmsFile.read(stream)
    if options.group not in (None, *file):
        raise ReadError(f'{path.name}: group "{options.group}" not found.{nearest(str(options.group), file)}')
    told = Told(warnings=_cut_off(path))
    columns: list[RecordedChannel] = []
    steps: dict[int, float] = {}
    shared: dict[tuple[float, float, int], Array] = {}  # channels with the same properties share their times
    for source in (
        channel for group in file.groups() if options.group in (None, group.name) for channel in group.channels()
    ):
        if not len(source) or source.dtype.kind not in "fiubM":
            what = "samples that are not numbers" if len(source) else "no samples"
            told.left_out[f'"{source.group_name}/{source.name}"'] = f"it holds {what}"
            continue
        properties = {key.lower(): value for key, value in source.properties.items()}
        column = _column(source, properties)
        offset, step = _clock(properties)
        if step and not column.is_clock:
            steps[len(columns)], key = step, (offset, step, column.values.size)
            if key not in shared:
                shared[key] = np.arange(column.values.size, dtype=np.float64)
                shared[key] *= step
                shared[key] += offset
            column = replace(column, time=shared[key], start=_moment(properties.get("wf_start_time")))
        columns.append(column)
    for step, number in Counter(steps.values()).items():
        told.notes.append(
            f"clock of {count(number, 'channel')}: a step of {step:.9g} s ({1 / step:.9g} Hz), by wf_increment"
        )
    yielding = {number for number, step in steps.items() if step == NO_TIMING}
    return recorded(path, "tdms", columns, told, options, yielding=yielding)


def _column(source: TdmsChannel, properties: Mapping[str, Any]) -> RecordedChannel:
    """Return a channel with its unit; one of timestamps is a clock."""
    written, scope = f"{source.group_name}/{source.name}", (source.group_name,)
    name, unit_in_name = take_apart(source.name)
    if source.dtype.kind == "M":
        first = np.fmin.reduce(source[:])
        values = (source[:] - first) / np.timedelta64(1, "s")
        return RecordedChannel(name, None, values, values, written, is_clock=True, scope=scope, start=_moment(first))
    unit = next((str(properties[key]).strip() for key in UNIT_PROPERTIES if properties.get(key)), "") or unit_in_name
    return RecordedChannel(name, unit, source[:], None, written, scope=scope)


def _clock(properties: Mapping[str, Any]) -> tuple[float, float]:
    """Offset and step, s, that a channel's properties give; a step of 0 if they give none."""
    try:
        offset, step = (float(properties.get(key) or 0.0) for key in ("wf_start_offset", "wf_increment"))
    except (TypeError, ValueError):
        return 0.0, 0.0
    return (offset, step) if np.isfinite([offset, step]).all() and step > 0 else (0.0, 0.0)


def _moment(stamp: object) -> datetime | None:
    """Date and time in UTC, as TDMS keeps it; None where none is known, for which LabVIEW writes 1904."""
    found = stamp.astype("datetime64[us]").item() if isinstance(stamp, np.datetime64) else None
    return found.replace(tzinfo=UTC) if isinstance(found, datetime) and found.year >= 1970 else None


def _cut_off(path: Path) -> list[str]:
    """Say that a file was cut off, by the lengths that its segments give."""
    size, place = path.stat().st_size, 0
    with path.open("rb") as stream:
        while place < size:
            stream.seek(place)
            lead_in = stream.read(LEAD_IN).ljust(LEAD_IN, b"\0")
            order = ">" if struct.unpack("<I", lead_in[4:8])[0] & BIG_ENDIAN else "<"
            place += LEAD_IN + struct.unpack(order + "Q", lead_in[12:20])[0]
    if place == size:
        return []
    return [
        f"it ends after {size} bytes, within its last segment: the recorder was stopped, or a copy was interrupted; "
        "what is there is read"
    ]


FORMAT = Format(
    name="tdms",
    summary="LabVIEW TDMS: channels in groups, each with its unit and its own clock.",
    suffixes=(".tdms",),
    options=TdmsOptions,
    recognise=recognise,
    read=read,
    modules=("nptdms",),
)
