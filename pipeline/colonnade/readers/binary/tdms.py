"""LabVIEW TDMS: every channel with the unit and the clock that its own properties give; what a cut file lacks."""

from __future__ import annotations

import logging
import struct
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError, count, nearest
from colonnade.readers.binary.numbers import ClockOptions, Told, recorded
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
            file = TdmsFile.open(stream)
            if all(_is_timed(channel) for channel in _channels(path, file, options.group, Told())):
                return _recording(path, options, file, window)
            stream.seek(0)
        return _recording(path, options, TdmsFile.read(stream), None)


def _recording(path: Path, options: TdmsOptions, file: TdmsFile, window: tuple[float, float] | None) -> Recording:
    told = Told()
    channels = _channels(path, file, options.group, told)
    told.warnings += cut_off(path, channels)
    waveforms = [_waveform(channel) for channel in channels]
    zero = min((own.start for own in waveforms if own is not None and own.start is not None), default=None)
    columns = []
    shared: dict[object, Array] = {}  # channels with the same properties share their times
    yielding: set[int] = set()
    for number, (channel, own) in enumerate(zip(channels, waveforms, strict=True)):
        part = slice(None) if window is None or own is None else own.part(window, zero, len(channel))
        column = _column(channel, part)
        if own is not None and not column.is_clock:
            first, size = part.start or 0, column.values.size
            if (key := (own, first, size)) not in shared:
                shared[key] = own.offset + own.step * np.arange(first, first + size, dtype=np.float64)
            column = replace(column, start=own.start, time=shared[key])
            if own.step == NO_TIMING:
                yielding.add(number)
        columns.append(column)
    for step, number in Counter(own.step for own in waveforms if own is not None).items():
        why = "LabVIEW's default, which yields to a channel of times" if step == NO_TIMING else f"{1 / step:.9g} Hz"
        told.notes.append(f"clock of {count(number, 'channel')}: a step of {step:.9g} s ({why}), by wf_increment")
    # LabVIEW's default step yields to a channel of times, and is all that is known where there is none.
    return recorded(path, "tdms", columns, told, options, yielding=yielding)


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
    alike: dict[int, list[str]] = {}
    for channel in channels:
        alike.setdefault(len(channel), []).append(channel.name)
    others = {length: f" and {len(names) - 1} others" * (len(names) > 1) for length, names in alike.items()}
    found = ", ".join(f'{length} samples of "{names[0]}"{others[length]}' for length, names in alike.items())
    return [
        f"it ends after {size} of {place} bytes: a recording or a copy was interrupted; it has {found or 'no samples'}"
    ]


def _channels(path: Path, file: TdmsFile, only: str | None, told: Told) -> list[TdmsChannel]:
    """Find the channels of numbers; others are left out."""
    if only is not None and only not in file:
        raise ReadError(f'{path.name}: group "{only}" not found.{nearest(only, file)}')
    channels = []
    for channel in (each for group in file.groups() if only in (None, group.name) for each in group.channels()):
        kind = channel.dtype.kind
        if len(channel) and kind in "fiubM":
            channels.append(channel)
        else:
            reason = NOT_NUMBERS.get(kind, "its samples are not numbers") if len(channel) else "it holds no samples"
            told.left_out[f'"{channel.group_name}/{channel.name}"'] = reason
    return channels


@dataclass(frozen=True)
class _Waveform:
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


def _properties(channel: TdmsChannel) -> Mapping[str, Any]:
    """Properties of a channel by names in lower case."""
    return {key.lower(): value for key, value in channel.properties.items()}


def _waveform(channel: TdmsChannel) -> _Waveform | None:
    """Take the clock from a channel's properties; None if they give no step."""
    properties = _properties(channel)
    try:
        step = float(properties.get("wf_increment") or 0.0)
        offset = float(properties.get("wf_start_offset") or 0.0)
    except (TypeError, ValueError):
        return None
    if not (np.isfinite(step) and step > 0 and np.isfinite(offset)):
        return None
    start = properties.get("wf_start_time")
    if not isinstance(start, np.datetime64) or np.isnat(start) or start < EARLIEST_START:
        return _Waveform(offset, step, None)
    return _Waveform(offset, step, _moment(start))


def _is_timed(channel: TdmsChannel) -> bool:
    """Whether a part of a channel can be found by its own clock."""
    own = _waveform(channel)
    return own is not None and own.step != NO_TIMING


def _moment(stamp: np.datetime64) -> datetime | None:
    """Date and time in UTC, as TDMS keeps it; None beyond the calendar."""
    found = stamp.astype("datetime64[us]").item()
    return found.replace(tzinfo=UTC) if isinstance(found, datetime) else None


def _column(channel: TdmsChannel, part: slice) -> RecordedChannel:
    """Return a channel with its unit; one of timestamps is a clock."""
    written, scope = f"{channel.group_name}/{channel.name}", (channel.group_name,)
    name, unit_in_name = take_apart(channel.name)
    if channel.dtype.kind == "M":
        moments = channel[:]
        known = ~np.isnat(moments)
        first = moments[np.argmax(known)]
        values = np.where(known, (moments - first) / np.timedelta64(1, "us") / 1e6, np.nan)
        start = _moment(first) if known.any() else None
        return RecordedChannel(name, None, values, values, written, is_clock=True, scope=scope, start=start)
    properties = _properties(channel)
    unit = next((str(properties[key]).strip() for key in UNIT_PROPERTIES if properties.get(key)), "") or unit_in_name
    return RecordedChannel(name, unit, channel[part], None, written, scope=scope)


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
