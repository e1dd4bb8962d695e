"""The clocks of TDMS channels: their own properties, or a channel of times in their group."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.clock import Clocks, find_clocks, given_clock
from colonnade.readers.recording import RecordedChannel, Recording

EARLIEST_START = np.datetime64("1970-01-01", "us")
"""LabVIEW writes 1904-01-01 if no start is known."""
NO_TIMING = 1.0
"""Step, s, that LabVIEW writes by default."""


@dataclass(frozen=True)
class Waveform:
    """
    The clock that a channel's properties give.

    Attributes
    ----------
    offset, step : float
        s.
    start : datetime64 or None
        Where it is known.
    first : int
        Number, from 0, of the first sample that was read.
    """

    offset: float
    step: float
    start: np.datetime64 | None
    first: int = 0


@dataclass(frozen=True)
class Column:
    """
    A channel before it has its clock.

    Attributes
    ----------
    channel : RecordedChannel
        Within its group; one of timestamps is a clock.
    waveform : Waveform or None
        None if its properties give no step.
    first : datetime64 or None
        The first of its values, where these are timestamps.
    """

    channel: RecordedChannel
    waveform: Waveform | None = None
    first: np.datetime64 | None = None


def waveform(properties: Mapping[str, Any]) -> Waveform | None:
    """
    Take the clock from a channel's properties.

    Parameters
    ----------
    properties : mapping
        By names in lower case.

    Returns
    -------
    waveform : Waveform or None
        None if they give no step.
    """
    try:
        step = float(properties.get("wf_increment") or 0.0)
        offset = float(properties.get("wf_start_offset") or 0.0)
    except (TypeError, ValueError):
        return None
    if not (np.isfinite(step) and step > 0 and np.isfinite(offset)):
        return None
    start = properties.get("wf_start_time")
    known = isinstance(start, np.datetime64) and not np.isnat(start) and start >= EARLIEST_START
    return Waveform(offset, step, start if known else None)


def beginnings(waveforms: Sequence[Waveform | None]) -> list[float]:
    """Give the time of each channel's first sample from the earliest start in the file, s; NaN where none is known."""
    zero = min(_starts(waveforms), default=EARLIEST_START)
    return [
        np.nan if own is None else own.offset + (0.0 if own.start is None else _seconds(own.start, zero))
        for own in waveforms
    ]


def on_clocks(path: Path, columns: list[Column], time: str | int | None, time_unit: str | None) -> Recording:
    """
    Give each channel its clock.

    Channels with different starts keep different clocks, all counted from the earliest start in the file.

    Parameters
    ----------
    path : Path
    columns : list of Column
    time : str or int or None
        The channel of times for all that are as long as it.
    time_unit : str or None
        Its unit.

    Raises
    ------
    ReadError
        If the channel is missing, or it holds no number.
    """
    waveforms = [column.waveform for column in columns]
    tracks: dict[tuple[float, float, int, int], Array] = {}
    times: list[Array | None] = []
    for column, begin in zip(columns, beginnings(waveforms), strict=True):
        own, size = column.waveform, column.channel.values.size
        if own is None:
            times.append(None)
            continue
        key = (begin, own.step, own.first, size)
        if key not in tracks:  # channels with the same properties share their times
            tracks[key] = begin + own.step * np.arange(own.first, own.first + size, dtype=np.float64)
        times.append(tracks[key])
    first = _first_sample(columns, times)
    clocks = _channels_of_times(columns, times)
    recording = Recording(path, "tdms", tuple(column.channel for column in columns), first)
    if time is not None:
        given = given_clock(recording, time, time_unit)
        clocks = Clocks(
            clocks.columns | given.columns,
            tuple(own if new is None else new for own, new in zip(clocks.times, given.times, strict=True)),
            clocks.notes + given.notes,
            clocks.warnings,
        )
    recording = clocks.applied(recording)
    return replace(recording, notes=(*recording.notes, *_summary(columns, clocks.times)))


def _starts(waveforms: Sequence[Waveform | None]) -> list[np.datetime64]:
    return [own.start for own in waveforms if own is not None and own.start is not None]


def _seconds(later: np.datetime64, earlier: np.datetime64) -> float:
    return float((later - earlier) / np.timedelta64(1, "us")) / 1e6


def _first_sample(columns: list[Column], times: list[Array | None]) -> datetime | None:
    """Date and time of the first sample, in UTC as TDMS keeps it."""
    dated = [
        (column.waveform.start, float(time[0]))
        for column, time in zip(columns, times, strict=True)
        if column.waveform is not None and column.waveform.start is not None and time is not None
    ]
    stamps = [column.first for column in columns if column.first is not None]
    if dated:
        moment = min(start for start, _ in dated) + np.timedelta64(round(min(begin for _, begin in dated) * 1e6), "us")
    elif stamps:
        moment = min(stamps)
    else:
        return None
    found = moment.astype("datetime64[us]").item()
    return found.replace(tzinfo=UTC) if isinstance(found, datetime) else None


def _channels_of_times(columns: list[Column], times: list[Array | None]) -> Clocks:
    """Let channels without a clock of their own go by a channel of times in their group."""
    bundles: dict[tuple[object, ...], list[int]] = {}
    for number, column in enumerate(columns):
        bundles.setdefault((*column.channel.scope, column.channel.values.size), []).append(number)
    clocks: set[int] = set()
    chosen = list(times)
    notes: list[str] = []
    warnings: list[str] = []
    for (group, *_), members in bundles.items():
        found = find_clocks([columns[number].channel for number in members])
        if not found.columns and all(times[number] is not None for number in members):
            continue
        clocks |= {members[index] for index in found.columns}
        notes += [f'group "{group}": {note}' for note in found.notes]
        warnings += [f'group "{group}": {warning}' for warning in found.warnings]
        warnings += _put_on_clocks(columns, members, found, chosen)
    return Clocks(frozenset(clocks), tuple(chosen), tuple(notes), tuple(warnings))


def _put_on_clocks(columns: list[Column], members: list[int], found: Clocks, times: list[Array | None]) -> list[str]:
    """Give channels of a group the clocks found there, but for those with a step of their own; warn of what is lost."""
    warnings = []
    for index, (number, time) in enumerate(zip(members, found.times, strict=True)):
        column, own = columns[number], times[number]
        is_clock = index in found.columns
        has_step = column.waveform is not None and column.waveform.step != NO_TIMING
        if time is None or (has_step and not is_clock):
            continue
        times[number] = time
        if not is_clock and own is not None and not np.array_equal(np.diff(time), np.diff(own)):
            warnings.append(
                f'"{column.channel.heading}" uses the channel of times: the step of exactly 1 s in its '
                "properties is LabVIEW's default"
            )
    return warnings


def _summary(columns: list[Column], times: Sequence[Array | None]) -> list[str]:
    """Say which clocks there are by the channels' properties, and which channels have none."""
    steps = Counter(column.waveform.step for column in columns if column.waveform)
    notes = [
        f"clock of {count} {'channel' if count == 1 else 'channels'}: a step of {step:.9g} s ({1 / step:.9g} Hz), "
        "by wf_increment"
        for step, count in steps.items()
    ]
    starts = _starts([column.waveform for column in columns])
    if min(starts, default=None) != max(starts, default=None):
        notes.append(
            f"channels start up to {_seconds(max(starts), min(starts)):.6g} s apart, by wf_start_time: each keeps its "
            "own clock"
        )
    without = [column.channel.heading for column, time in zip(columns, times, strict=True) if time is None]
    if without:
        notes.append(f'{len(without)} channels have no clock ("{without[0]}", …): give `time` or `sampling_rate`')
    return notes
