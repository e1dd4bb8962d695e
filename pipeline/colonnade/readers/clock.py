"""Which columns of a text file are its clocks."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording
from colonnade.units import format_percent

TIME_NAME = re.compile(
    r"(?:t|time|zeit|messzeit|laufzeit|time\W?stamp|date\W?time|elapsed(?:\W?time)?|temps|tiempo|tempo|tid|χρόνοσ|χρονοσ"
    r"|seconds|sekunden|sec)(?:[\s_#-]*\d+)?(?:\s+-\s.*)?"
)
EQUAL = 1e-3
"""Largest difference of a step from the mean, as a share of it, in what rises in equal steps."""

FEWEST_STEPS = 4
LONGEST_STEP = 0.5
"""Longest step, s, of a column without a name that counts as times in seconds."""

RISING_SHARE = 0.9
"""Share of steps that are positive in what is still a clock; the rest is for quality control to flag."""


@dataclass(frozen=True)
class Clocks:
    """
    What goes by which clock.

    Attributes
    ----------
    columns : frozenset of int
        Indices of the columns that are clocks.
    times : tuple of (ndarray or None)
        Of each column, s; None without a clock.
    notes, warnings : tuple of str
    start : datetime or None
        Of the first sample, if the times are dates.
    """

    columns: frozenset[int]
    times: tuple[Array | None, ...]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    start: datetime | None = None

    def applied(self, recording: Recording) -> Recording:
        """Give each channel its times, and add how they were found."""
        channels = tuple(
            replace(channel, time=time, is_clock=number in self.columns)
            for number, (channel, time) in enumerate(zip(recording.channels, self.times, strict=True))
        )
        return replace(
            recording,
            channels=channels,
            start=self.start or recording.start,
            notes=(*recording.notes, *self.notes),
            warnings=(*recording.warnings, *self.warnings),
        )


def given_clock(recording: Recording, column: str | int, unit: str | None) -> Clocks:
    """
    Take the channel that an option names as the clock of those as long as it.

    Parameters
    ----------
    recording : Recording
    column, unit
        As for `Recording.clock`, which says what is refused.
    """
    clock, seconds, how = recording.clock(column, unit)
    number = next(index for index, channel in enumerate(recording.channels) if channel is clock)
    times = tuple(seconds if channel.values.size == seconds.size else None for channel in recording.channels)
    others = sum(time is None for time in times)
    what = "1 channel is" if others == 1 else f"{others} channels are"
    warnings = (f'{what} not as long as "{clock.heading}": no clock',) if others else ()
    return Clocks(frozenset((number,)), times, (f'clock: "{clock.heading}", as given ({how})',), warnings)


def find_clocks(channels: tuple[RecordedChannel, ...], kinds: tuple[str, ...]) -> Clocks:
    """
    Find columns of times by their name or unit and by rising values.

    With several clocks each column goes by the nearest one on its left, as recorders write them.

    Parameters
    ----------
    channels : tuple of RecordedChannel
    kinds : tuple of str
        What each holds; timestamps are in seconds from their first already.
    """
    notes, warnings = [], []
    clocks: dict[int, Array] = {}
    for index, (channel, kind) in enumerate(zip(channels, kinds, strict=True)):
        if not _looks_like_clock(channel, kind, is_first=index == 0):
            continue
        rising = rising_share(channel.values)
        if rising < RISING_SHARE:
            warnings.append(
                f'"{channel.heading}" looks like a clock, but only {format_percent(rising)} of its steps go forward: '
                "it is not used as one"
            )
            continue
        clocks[index], how = (channel.values, "timestamps") if kind == "time" else channel.in_seconds()
        notes.append(f'clock: column {index + 1}, "{channel.heading}" ({how}; rising)')
    if not clocks and kinds[0] == "number" and (step := _nameless_clock(channels[0])):
        clocks[0] = channels[0].values
        notes.append(f"clock: column 1, which has no name and rises in equal steps of {step:.6g}, taken as seconds")
    if not clocks:
        hint = may_be_clock(channels[0].heading, channels[0].values)
        notes.append("no clock: no rising column has a name or unit of time" + hint)
        return Clocks(frozenset(), (None,) * len(channels), tuple(notes), tuple(warnings))
    if len(clocks) > 1:
        notes.append("several clocks: each column uses the nearest one on its left")
    leftmost = min(clocks)
    times = tuple(clocks[max((c for c in clocks if c <= index), default=leftmost)] for index in range(len(channels)))
    return Clocks(frozenset(clocks), times, tuple(notes), tuple(warnings))


def _looks_like_clock(channel: RecordedChannel, kind: str, *, is_first: bool) -> bool:
    """Whether a column's name or unit, or what it holds, is that of times; a unit alone says it of the first column."""
    if kind != "number":
        return kind == "time"
    by_unit = channel.unit is not None and channel.unit.casefold() in TIME_UNITS
    named = TIME_NAME.fullmatch(channel.name.casefold()) is not None
    return (named and channel.unit is None) or (by_unit and (named or is_first))


def even_times(count: int, step: float, begin: float = 0.0) -> Array:
    """Give times in equal steps, s; NaN if a damaged header's step or begin leads beyond all numbers."""
    if not np.isfinite(begin) or not np.isfinite(step * count):
        return np.full(count, np.nan)
    times: Array = begin + step * np.arange(count, dtype=np.float64)
    return times


def moment_after(origin: datetime | None, seconds: float) -> datetime | None:
    """Give the date and time so many seconds after another; None if either is not known or cannot be."""
    try:
        return None if origin is None else origin + timedelta(seconds=seconds)
    except (ValueError, OverflowError):
        return None


def rising_share(values: Array) -> float:
    """Share of the steps between numbers that are positive; 0 if there are fewer than two numbers."""
    steps = np.diff(values[np.isfinite(values)])
    return float((steps > 0).mean()) if steps.size else 0.0


def equal_step(values: Array, tolerance: float) -> float | None:
    """Mean step of values that rise in equal steps, within a share of the mean; None if they do not."""
    steps = np.diff(values)
    if not steps.size or not (steps > 0).all() or not np.isfinite(steps).all():
        return None
    mean = float((values[-1] - values[0]) / steps.size)
    return mean if np.abs(steps - mean).max() <= tolerance * mean else None


def may_be_clock(heading: str, values: Array) -> str:
    """Hint at a column that is not taken for a clock and rises in equal steps; empty if it does not."""
    known = values[np.isfinite(values)]
    step = equal_step(known, EQUAL) if known.size > 2 else None
    return "" if step is None else f'; set time = "{heading}" if that is one: it rises in equal steps of {step:g}'


def _nameless_clock(first: RecordedChannel) -> float:
    """
    Step of a first column without name and unit that can only be times in seconds; 0 if it cannot.

    Whole steps may be numbers of samples, and steps of half a second or more times in another unit.
    """
    if first.name != "column 1" or first.unit is not None or not np.isfinite(first.values).all():
        return 0.0
    steps = np.diff(first.values)
    if steps.size < FEWEST_STEPS or not (steps > 0).all():
        return 0.0
    step = float(steps.mean())
    even = first.values[0] + step * np.arange(first.values.size)
    # Rounded times are off by less than a step.
    return step if step < LONGEST_STEP and float(np.abs(first.values - even).max()) < step else 0.0
