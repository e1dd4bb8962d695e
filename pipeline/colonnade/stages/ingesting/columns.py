"""The columns of raw files that a channel takes, and when a test was recorded by what its files say."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date, datetime, timedelta

import numpy as np

from colonnade import units
from colonnade.arrays import Array
from colonnade.errors import StageError, count
from colonnade.findings import Finding, note, serious, warning
from colonnade.readers.clock import moment_after
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.heading import LETTERED
from colonnade.signals import timing
from colonnade.stages.ingesting.quality import ChannelInputs
from colonnade.store.description import variable_name

Window = tuple[float, float]


def find_column(recording: Recording, name: str, channel: ChannelInputs, rate: float | None) -> RecordedChannel:
    """
    Find the column of a channel, with its times.

    Parameters
    ----------
    recording : Recording
    name : str
        Of the channel.
    channel : ChannelInputs
    rate : float or None
        Sampling rate of the recorder, Hz, if its file has no time column.

    Raises
    ------
    StageError
        If it has no clock.
    ReadError
        If the column is not in the file.
    """
    if channel.time is not None:
        return recording.on_clock(channel.column, channel.time)
    column = recording.channel(channel.column)
    if column.time is not None and rate is None:
        return column
    if rate is None:
        raise StageError(
            f"channel {name}: {recording.path.name} has no recognised time column, and the set-up "
            'gives no sampling rate. Add `sampling_rate = "200 Hz"` to the recorder, or name the '
            "column (`time`) in its `file`."
        )
    return RecordedChannel(
        column.name, column.unit, column.values, np.arange(column.values.size) / rate, column.heading
    )


def unit_findings(recording: Recording, column: RecordedChannel, name: str, channel: ChannelInputs) -> list[Finding]:
    """
    Report a unit of the file that is not the one of the campaign file.

    A recorder's own unit, such as counts, only names what the campaign file explains by its unit and gain.
    """
    if column.unit is None or channel.unit is None or units.same_unit(column.unit, channel.unit):
        return []
    if LETTERED.fullmatch(column.heading) and column.unit in ("V", "A") and channel.gain is None:
        return []  # a label
    if channel.gain is not None and not units.is_physical(column.unit):
        return [
            note(
                "unit",
                f'channel {name}: {recording.path.name} says "{column.unit}" for column "{column.heading}", which '
                f"is not the unit of a physical quantity. The campaign file's unit ({channel.unit}) and gain "
                f"({channel.gain}) were used.",
            )
        ]
    return [
        serious(
            "unit",
            f'channel {name}: {recording.path.name} says "{column.unit}" for column "{column.heading}", the campaign '
            f'file says "{channel.unit}", which was used. One of them is wrong.',
        )
    ]


def within(column: RecordedChannel, window: Window | None) -> tuple[Array, Array]:
    """Times and values of a channel that belong to the test."""
    time = column.time if column.time is not None else np.empty(0)
    if window is None:
        return time, column.values
    inside = (time >= window[0]) & (time <= window[1])
    return time[inside], column.values[inside]


def too_short(name: str, size: int, window: Window | None) -> StageError:
    """Say that a channel has too few samples for a clock."""
    part = "" if window is None else f" between {window[0]:g} and {window[1]:g} s"
    return StageError(
        f"channel {name} has {count(size, 'sample')}{part}; at least two at increasing times were expected. "
        "Check the file's time column and the test's `window`."
    )


def rounding(recording: Recording, clock: timing.Clock, jitter: float) -> list[Finding]:
    """Note that the times of a file are rounded by more than `jitter`, in sampling intervals."""
    if not clock.resolution > jitter * clock.interval:
        return []
    return [
        note(
            "rounded times",
            f"{recording.path.name}: the times are rounded to {1e3 * clock.resolution:g} ms; an even clock of "
            f"{1 / clock.interval:.5g} Hz matches them all and is used.",
        )
    ]


def dimension_of(known: Mapping[str, Array], time: Array, name: str, channel: ChannelInputs) -> str:
    """Name of the channel's dimension: two channels share one only if their times are the same."""
    own = f"elapsed_{variable_name(name)}"
    wanted = "elapsed" if channel.recorder == "main" else f"elapsed_{variable_name(channel.recorder)}"
    for candidate in (own,) if channel.time is not None else (wanted, own):
        taken = known.get(candidate)
        if taken is None or (taken.size == time.size and np.array_equal(taken, time, equal_nan=True)):
            return candidate
    return f"{own}_{len(known)}"


KIND = "date"
"""Kind of the finding that two dates contradict each other."""

ZONES = (timedelta(hours=-12), timedelta(0), timedelta(hours=14))
"""From UTC to the clocks on the wall anywhere: a file in UTC does not say in which of them the laboratory is."""

NO_ZONE = "no time zone recorded"


def recorded_at(recordings: Mapping[str, Recording], begin: float = 0.0) -> str:
    """
    Write when a test was recorded, by the first recorder whose file says so; empty if none does.

    Parameters
    ----------
    recordings : mapping of str to Recording
    begin : float, optional
        Of the test in its files, s.

    Returns
    -------
    text : str
        ``2013-04-26 10:15:00+02:00``, in the zone of the file; without one, that is said.
    """
    starts = (moment_after(recording.start, begin) for recording in recordings.values())
    return next((_written(start) for start in starts if start is not None), "")


def contradictions(recordings: Mapping[str, Recording], day: date | None, begin: float = 0.0) -> list[Finding]:
    """
    Compare the day of each file with that of the campaign file.

    Parameters
    ----------
    recordings : mapping of str to Recording
    day : date or None
        As campaign.toml gives it; None if it does not.
    begin : float, optional
        Of the test in its files, s.

    Returns
    -------
    findings : list of Finding
        A warning for each file of another day.
    """
    if day is None:
        return []
    found = []
    for recording in recordings.values():
        start = moment_after(recording.start, begin)
        if start is not None and day not in _days(start):
            text = (
                f"{recording.path.name} was recorded on {start.date()} by its own clock ({_written(start)}), but the "
                f"campaign file gives the date {day}. Correct the date, or check that this is the file of the test and "
                "that the recorder's clock was right."
            )
            found.append(warning(KIND, text))
    return found


def _days(start: datetime) -> set[date]:
    """Days that it may have been on the wall."""
    if start.utcoffset() is None or start.utcoffset() != timedelta(0):
        return {start.date()}
    shifted = (moment_after(start, zone.total_seconds()) for zone in ZONES)
    return {moment.date() for moment in shifted if moment is not None}


def _written(start: datetime) -> str:
    text = start.isoformat(" ", "milliseconds" if start.microsecond else "seconds")
    return text if start.tzinfo is not None else f"{text}, {NO_ZONE}"
