"""LabVIEW TDMS: every channel with the unit and the clock that its own properties give; what a cut file lacks."""

from __future__ import annotations

import logging
import struct
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

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
    from nptdms import TdmsChannel, TdmsFile

LEAD_IN = 28
"""Bytes in front of each segment: mark, flags, version, length of the segment and of its description."""
UNFINISHED = 0xFFFF_FFFF_FFFF_FFFF
"""Length of a segment that LabVIEW did not come to finish."""
BIG_ENDIAN = 1 << 6
UNIT_PROPERTIES = ("unit_string", "ni_unitdescription", "unit", "units")
"""Names, in lower case, of the property that holds a channel's unit, the most usual first."""
EARLIEST_START = np.datetime64("1970-01-01", "us")
"""LabVIEW writes 1904-01-01 if no start is known."""
NO_TIMING = 1.0
"""Step, s, that LabVIEW writes by default."""
NOT_NUMBERS = {"O": "it holds text", "c": "it holds complex numbers"}


class TdmsOptions(ClockOptions):
    """What can be said about a TDMS file."""

    group: str | None = Field(default=None, description="Read only this group; by default all of them.")


recognise = by_mark((b"TDSm",), "TDSm, the mark of LabVIEW's TDMS")


def read(path: Path, options: TdmsOptions, window: tuple[float, float] | None = None) -> Recording:
    """Read a TDMS file, or of a long one what a window needs, where all channels have a clock of their own."""
    from nptdms import TdmsFile
    from nptdms.log import log_manager

    recognise.expected(path)
    log_manager.set_level(logging.CRITICAL)  # what it would print is said by `cut_off`
    with path.open("rb") as stream:  # by its path, npTDMS would use a .tdms_index next to it, be it another file's
        if window is not None and options.time is None:
            told = Told()
            channels = _channels(path, TdmsFile.open(stream), options.group, told)
            if all(channel.clock is not None and channel.clock.step != NO_TIMING for channel in channels):
                return _recording(path, options, channels, told, window)
            stream.seek(0)
        told = Told()
        return _recording(path, options, _channels(path, TdmsFile.read(stream), options.group, told), told, None)


@dataclass(frozen=True)
class _Clock:
    """The clock that a channel's properties give, in s; its start where it is known."""

    offset: float
    step: float
    start: datetime | None

    def part(self, window: tuple[float, float], zero: datetime | None, size: int) -> slice:
        """Samples that a window wants: at least one, so that a channel that is not there yet keeps its clock."""
        begin = self.offset
        if self.start is not None and zero is not None:
            begin += (self.start - zero).total_seconds()
        low, high = (int((end - begin) / self.step) for end in window)
        first = min(max(low - 1, 0), size - 1)
        return slice(first, min(max(high + 2, first + 1), size))


class _Channel(NamedTuple):
    """A channel of numbers or timestamps, its properties by names in lower case, and the clock that they give."""

    source: TdmsChannel
    properties: Mapping[str, Any]
    clock: _Clock | None


def _channels(path: Path, file: TdmsFile, only: str | None, told: Told) -> list[_Channel]:
    """Find the channels of numbers; others are left out."""
    if only is not None and only not in file:
        raise ReadError(f'{path.name}: group "{only}" not found.{nearest(only, file)}')
    channels = []
    for source in (each for group in file.groups() if only in (None, group.name) for each in group.channels()):
        kind = source.dtype.kind
        if len(source) and kind in "fiubM":
            properties = {key.lower(): value for key, value in source.properties.items()}
            channels.append(_Channel(source, properties, None if kind == "M" else _clock(properties)))
        else:
            reason = NOT_NUMBERS.get(kind, "its samples are not numbers") if len(source) else "it holds no samples"
            told.left_out[f'"{source.group_name}/{source.name}"'] = reason
    return channels


def _clock(properties: Mapping[str, Any]) -> _Clock | None:
    """Take the clock from a channel's properties; None if they give no step."""
    try:
        step, offset = (float(properties.get(key) or 0.0) for key in ("wf_increment", "wf_start_offset"))
    except (TypeError, ValueError):
        return None
    if not (np.isfinite(step) and step > 0 and np.isfinite(offset)):
        return None
    start = properties.get("wf_start_time")
    if not isinstance(start, np.datetime64) or not start >= EARLIEST_START:
        return _Clock(offset, step, None)
    return _Clock(offset, step, _moment(start))


def _recording(
    path: Path, options: TdmsOptions, channels: list[_Channel], told: Told, window: tuple[float, float] | None
) -> Recording:
    told.warnings += cut_off(path, [channel.source for channel in channels])
    clocks = [channel.clock for channel in channels if channel.clock is not None]
    zero = min((clock.start for clock in clocks if clock.start is not None), default=None)
    columns = []
    shared: dict[object, Array] = {}  # channels with the same properties share their times
    for source, properties, clock in channels:
        part = slice(None) if window is None or clock is None else clock.part(window, zero, len(source))
        column = _column(source, properties, part)
        if clock is not None:
            first, size = part.start or 0, column.values.size
            if (key := (clock, first, size)) not in shared:
                shared[key] = clock.offset + clock.step * np.arange(first, first + size, dtype=np.float64)
            column = replace(column, start=clock.start, time=shared[key])
        columns.append(column)
    for step, number in Counter(clock.step for clock in clocks).items():
        why = "LabVIEW's default, which yields to a channel of times" if step == NO_TIMING else f"{1 / step:.9g} Hz"
        told.notes.append(f"clock of {count(number, 'channel')}: a step of {step:.9g} s ({why}), by wf_increment")
    # A channel of times comes before LabVIEW's default step, which is used only if there is no such channel.
    yielding = {n for n, each in enumerate(channels) if each.clock is not None and each.clock.step == NO_TIMING}
    return recorded(path, "tdms", columns, told, options, yielding=yielding)


def _column(source: TdmsChannel, properties: Mapping[str, Any], part: slice) -> RecordedChannel:
    """Return a channel with its unit; one of timestamps is a clock."""
    written, scope = f"{source.group_name}/{source.name}", (source.group_name,)
    name, unit_in_name = take_apart(source.name)
    if source.dtype.kind == "M":
        moments = source[:]
        known = ~np.isnat(moments)
        first = moments[np.argmax(known)]
        values = np.where(known, (moments - first) / np.timedelta64(1, "us") / 1e6, np.nan)
        start = _moment(first) if known.any() else None
        return RecordedChannel(name, None, values, values, written, is_clock=True, scope=scope, start=start)
    unit = next((str(properties[key]).strip() for key in UNIT_PROPERTIES if properties.get(key)), "") or unit_in_name
    return RecordedChannel(name, unit, source[part], None, written, scope=scope)


def _moment(stamp: np.datetime64) -> datetime | None:
    """Date and time in UTC, as TDMS keeps it; None beyond the calendar."""
    found = stamp.astype("datetime64[us]").item()
    return found.replace(tzinfo=UTC) if isinstance(found, datetime) else None


def cut_off(path: Path, channels: list[TdmsChannel]) -> list[str]:
    """Say that a file was cut off, by the lengths that its segments give, and how many samples it has."""
    size, place = path.stat().st_size, 0
    with path.open("rb") as stream:
        while place < size:
            stream.seek(place)
            lead_in = stream.read(LEAD_IN).ljust(LEAD_IN, b"\0")
            order = ">" if struct.unpack("<I", lead_in[4:8])[0] & BIG_ENDIAN else "<"
            (length,) = struct.unpack(order + "Q", lead_in[12:20])
            if length == UNFINISHED:
                return ["the recorder did not finish the last segment, as happens if it is killed: read up to its end"]
            place += LEAD_IN + length
    if place == size:
        return []
    of_length = {len(channel): channel.name for channel in reversed(channels)}
    found = ", ".join(f'{length} samples of "{name}"' for length, name in reversed(of_length.items()))
    return [
        f"it ends after {size} of {place} bytes: a recording or a copy was interrupted; it has {found or 'no samples'}"
    ]


FORMAT = Format(
    name="tdms",
    summary="LabVIEW TDMS: channels in groups, each with its unit and its own clock.",
    suffixes=(".tdms",),
    options=TdmsOptions,
    recognise=recognise,
    read=read,
    modules=("nptdms",),
    read_window=read,
)
