"""LabVIEW TDMS: every channel with the unit and the clock that its own properties give; what a cut file lacks."""

from __future__ import annotations

import logging
import struct
from collections import Counter
from dataclasses import dataclass, replace
from io import BufferedReader, FileIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from colonnade.errors import ReadError, nearest
from colonnade.readers.binary.numbers import ClockOptions, as_values
from colonnade.readers.binary.tdms_clocks import NO_TIMING, Column, beginnings, on_clocks, waveform
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, by_mark, from_head
from colonnade.readers.recording import RecordedChannel, Recording, Window
from colonnade.readers.text.heading import take_apart

if TYPE_CHECKING:
    from nptdms import TdmsChannel, TdmsFile

LEAD_IN = 28
UNFINISHED = 0xFFFF_FFFF_FFFF_FFFF
"""Length of a segment that LabVIEW did not come to finish."""
BIG_ENDIAN = 1 << 6


@dataclass(frozen=True)
class Ending:
    """
    How a TDMS file ends.

    Attributes
    ----------
    size : int
        Bytes of the file.
    declared : int or None
        Bytes that its segments add up to; None if the last one does not say, because the recorder was stopped.
    undescribed : int
        Bytes at the end that begin a segment whose description is not complete.
    present, expected : int
        Bytes of samples of the last segment: found, and declared; 0 if it is whole.
    """

    size: int
    declared: int | None
    undescribed: int = 0
    present: int = 0
    expected: int = 0


def walk(path: Path) -> Ending:
    """
    Follow the segments of a TDMS file to its end.

    Raises
    ------
    ReadError
        If a segment does not start where the one before says it does: the file was damaged there.
    """
    size = path.stat().st_size
    position = 0
    with path.open("rb") as stream:
        while position < size:
            stream.seek(position)
            lead_in = stream.read(LEAD_IN)
            if not (lead_in.startswith(b"TDSm") or b"TDSm".startswith(lead_in)):
                raise ReadError(
                    f"{path.name}: at byte {position} of {size} a segment starting with TDSm was expected, "
                    f"{lead_in[:4]!r} was found: the file is damaged. Copy it again from the recorder."
                )
            if len(lead_in) < LEAD_IN:
                return Ending(size, None, undescribed=size - position)
            order = ">" if struct.unpack("<I", lead_in[4:8])[0] & BIG_ENDIAN else "<"
            length, description = struct.unpack(order + "QQ", lead_in[12:])
            samples = position + LEAD_IN + description
            if length == UNFINISHED:
                return Ending(size, None, undescribed=size - position if samples > size else 0)
            end = position + LEAD_IN + length
            if end > size:
                if samples > size:
                    return Ending(size, end, undescribed=size - position)
                return Ending(size, end, present=size - samples, expected=end - samples)
            position = end
    return Ending(size, position)


def missing_samples(ending: Ending, file: TdmsFile) -> list[str]:
    """Tell what a file that was cut off lacks: by its bytes, and by the samples of its channels."""
    if ending.declared == ending.size:
        return []
    if ending.undescribed:
        return [
            f"it ends after {ending.size} bytes, within the description of its last segment: a recording or a copy was "
            f"interrupted; the data in its last {ending.undescribed} bytes are lost"
        ]
    if ending.declared is None:
        return ["the recorder did not finish the last segment, as happens if it is killed: read as far as it goes"]
    statuses = file.file_status.channel_statuses or {}
    channels = {channel.path: channel for group in file.groups() for channel in group.channels()}
    chunk = sum(status.expected_length * _sample_bytes(channels[path]) for path, status in statuses.items())
    lacking: dict[tuple[int, int], list[str]] = {}
    for path, status in statuses.items():
        found = len(channels[path])
        expected = found - status.read_length + status.expected_length
        if chunk and ending.expected % chunk == 0:
            later = ending.expected // chunk - -(-ending.present // chunk)
            expected += later * status.expected_length
        if found < expected:
            lacking.setdefault((found, expected), []).append(channels[path].name)
    counts = [
        f'{found} of {expected} samples of "{names[0]}"' + (f" and {len(names) - 1} others" if names[1:] else "")
        for (found, expected), names in lacking.items()
    ]
    cut = f"it ends after {ending.size} of {ending.declared} bytes: a recording or a copy was interrupted"
    return [f"{cut}; it has {', '.join(counts)}" if counts else cut]


def _sample_bytes(channel: TdmsChannel) -> int:
    """Bytes of a sample as stored; 0 where they differ from sample to sample."""
    if channel.scaler_data_types:
        return sum(each.size for each in channel.scaler_data_types.values())
    return getattr(channel.data_type, "size", None) or 0


UNIT_PROPERTIES = ("unit_string", "ni_unitdescription", "unit", "units")
"""Names, in lower case, of the property that holds a channel's unit, the most usual first."""

MUCH = 1 << 16
"""Bytes from which on a read is held against what the file has."""


class TdmsOptions(ClockOptions):
    """What can be said about a TDMS file."""

    group: str | None = Field(default=None, description="Read only this group; by default all of them.")


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is TDMS."""
    return by_mark(head, (b"TDSm",), "TDSm, the mark of LabVIEW's TDMS")


def read(path: Path, options: TdmsOptions) -> Recording:
    """
    Read a TDMS file.

    Raises
    ------
    ReadError
        If it is not TDMS, is damaged, or lacks the group or channel that the options name.
    """
    return _recording(path, options, None)


def read_window(path: Path, options: TdmsOptions, window: Window) -> Recording:
    """
    Read what a test needs of a long TDMS file, where the clocks of all channels are in their properties; else all.

    Raises
    ------
    ReadError
        As `read`.
    """
    return _recording(path, options, window if options.time is None else None)


def _recording(path: Path, options: TdmsOptions, window: Window | None) -> Recording:
    from nptdms import TdmsFile

    recognise.expected(path)
    ending = walk(path)
    with _BoundedStream(path) as stream:
        file = _open(path, stream)
        channels, notes = _channels(path, file, options.group)
        parts = _parts(channels, window)
        if parts is None:
            stream.seek(0)
            file = TdmsFile.read(stream)
            channels, notes = _channels(path, file, options.group)
            parts = [slice(None)] * len(channels)
        columns, warnings = _columns(channels, file, parts, options.group)
    warnings = missing_samples(ending, file) + warnings
    recording = on_clocks(path, columns, options.time, options.time_unit)
    return replace(recording, notes=(*recording.notes, *notes), warnings=(*warnings, *recording.warnings))


def _parts(channels: list[TdmsChannel], window: Window | None) -> list[slice] | None:
    """Samples of each channel that a window wants; None, which is all, where some channel's clock is elsewhere."""
    waveforms = [waveform(_properties(channel)) for channel in channels]
    if window is None or any(own is None or own.step == NO_TIMING for own in waveforms):
        return None
    if any(channel.scaler_data_types for channel in channels):
        return None
    parts = []
    for channel, begin in zip(channels, beginnings(waveforms), strict=True):
        step = float(_properties(channel)["wf_increment"])
        # One sample at least, so that a channel that is not there yet keeps its clock.
        first = min(max(int((window.low - begin) / step) - 1, 0), len(channel) - 1)
        parts.append(slice(first, min(max(int((window.high - begin) / step) + 2, first + 1), len(channel))))
    return parts


class _BoundedStream(BufferedReader):
    """A file that returns at most the bytes that it has, even if damaged content claims more."""

    def __init__(self, path: Path) -> None:
        super().__init__(FileIO(path))
        self._length = path.stat().st_size

    def read(self, size: int | None = -1, /) -> bytes:
        """Read up to so many bytes."""
        if size is not None and size > MUCH:
            size = max(min(size, self._length - self.tell()), 0)
        return super().read(size)


def _open(path: Path, stream: _BoundedStream) -> TdmsFile:
    """
    Open the file, once its description is found to fit into it.

    It is given as a stream, so that a .tdms_index next to it, which may be another file's, is not used.
    """
    from nptdms import TdmsFile
    from nptdms.log import log_manager

    log_manager.set_level(logging.CRITICAL)  # what it would print becomes warnings of the recording
    size = path.stat().st_size
    try:
        described = TdmsFile.open(stream)
    except MemoryError as error:
        raise ReadError(
            f"{path.name}: the header claims more data than the {size} bytes of the file: it is damaged. Copy it again "
            "from the recorder."
        ) from error
    for channel in (channel for group in described.groups() for channel in group.channels()):
        if len(channel) > size:
            raise ReadError(
                f"{path.name}: {channel.path} is said to have {len(channel)} samples, in a file of {size} bytes: "
                "the file is damaged. Copy it again from the recorder."
            )
    return described


def _channels(path: Path, file: TdmsFile, only: str | None) -> tuple[list[TdmsChannel], list[str]]:
    """Find the channels of numbers, with notes on those that are none."""
    if only is not None and only not in file:
        raise ReadError(f'{path.name}: group "{only}" not found.{nearest(only, file)}')
    channels, notes = [], []
    for channel in (each for group in file.groups() if only in (None, group.name) for each in group.channels()):
        if refused := _refusal(channel):
            notes.append(f'"{channel.group_name}/{channel.name}" is left out: {refused}')
        else:
            channels.append(channel)
    return channels, notes


def _columns(
    channels: list[TdmsChannel], file: TdmsFile, parts: list[slice], only: str | None
) -> tuple[list[Column], list[str]]:
    """Take the wanted parts of channels, with warnings."""
    groups = [group for group in file.groups() if only in (None, group.name)]
    counted = Counter(channel.name for group in groups for channel in group.channels())
    columns, warnings = [], []
    for channel, part in zip(channels, parts, strict=True):
        column, warning = _column(channel, file, part, unique=counted[channel.name] == 1)
        columns.append(column)
        warnings += [f'"{channel.group_name}/{channel.name}": {warning}'] if warning else []
    return columns, warnings


def _refusal(channel: TdmsChannel) -> str:
    """Say why a channel is not a column of numbers; empty if it is."""
    if len(channel) == 0:
        return "it holds no samples"
    kind = channel.dtype.kind
    if kind in "fiubM":
        return ""
    return {"O": "it holds text", "c": "it holds complex numbers"}.get(kind, "its samples are not numbers")


def _properties(channel: TdmsChannel) -> dict[str, Any]:
    """Properties of a channel by names in lower case."""
    return {key.lower(): value for key, value in channel.properties.items()}


def _column(channel: TdmsChannel, file: TdmsFile, part: slice, *, unique: bool) -> tuple[Column, str]:
    """Return a channel with its unit and warnings; it has the short name if no other channel has it."""
    written, scope = f"{channel.group_name}/{channel.name}", (channel.group_name,)
    name, unit_in_name = take_apart(channel.name)
    name = name if unique else written
    properties = _properties(channel)
    if channel.dtype.kind == "M":
        moments = channel[:]
        known = ~np.isnat(moments)
        if not known.any():
            return Column(RecordedChannel(name, None, np.full(moments.shape, np.nan), None, written, scope=scope)), ""
        first = moments[np.argmax(known)]
        values = np.where(known, (moments - first) / np.timedelta64(1, "us") / 1e6, np.nan)
        stamps = RecordedChannel(name, None, values, values, written, is_clock=True, scope=scope)
        return Column(stamps, first=first), ""
    numbers, unscaled = _numbers(channel, file, part)
    values, infinite = as_values(numbers)
    unit = next((str(properties[key]).strip() for key in UNIT_PROPERTIES if properties.get(key)), "") or unit_in_name
    recorded = RecordedChannel(name, unit, values, None, written, scope=scope)
    warning = "; ".join(part for part in (unscaled, infinite) if part)
    clock = waveform(properties)
    if clock is not None and part.start:
        clock = replace(clock, first=part.start)
    return Column(recorded, clock), warning


def _numbers(channel: TdmsChannel, file: TdmsFile, part: slice) -> tuple[Any, str]:
    """Scale the samples; raw ones of a DAQmx channel without scaling are given as they are, with a warning."""
    everywhere = (channel.properties, file[channel.group_name].properties, file.properties)
    if channel.scaler_data_types and not any("NI_Number_Of_Scales" in properties for properties in everywhere):
        return next(iter(channel.raw_scaler_data.values())), (
            "raw counts, as the file does not say how they are scaled; give the gain in campaign.toml"
        )
    return channel[part], ""


FORMAT = Format(
    name="tdms",
    summary="LabVIEW TDMS: channels in groups, each with its unit and its own clock.",
    suffixes=(".tdms",),
    options=TdmsOptions,
    recognise=recognise,
    read=read,
    modules=("nptdms",),
    read_window=read_window,
)
