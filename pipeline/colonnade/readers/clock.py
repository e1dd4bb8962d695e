"""Which channels of a file are its clocks: columns of a table, and vectors in structs and groups."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
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
PLAIN_NAME = re.compile(r"t|time", re.IGNORECASE)
OTHER_NAME = re.compile(
    r"t[A-Z]\w*|[tT]_?(?:out|meas|vec|vector|axis|rel|sim|exp|s|sec|ms)?_?\d*|.*_t|\w*time(?:[A-Z_]\w*|s|stamps?)?|.*Time\w*"
)
STEP_NAMES = frozenset(("dt", "ts", "deltat", "delta_t", "sampletime", "sample_time", "tsample", "samplinginterval"))
RATE_NAMES = frozenset(
    ("fs", "fsamp", *(f"{word}{what}" for word in ("sample", "sampling") for what in ("rate", "_rate", "frequency")))
)
DATENUM = (693_962.0, 767_011.0)
"""Days of MATLAB's calendar from 1900 to 2100."""
DAY = 86400.0
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


def find_clocks(channels: Sequence[RecordedChannel]) -> Clocks:
    """
    Find columns of times by their name or unit and by rising values; timestamps are clocks already.

    With several clocks each column goes by the nearest one on its left, as recorders write them.
    """
    notes: list[str] = []
    warnings: list[str] = []
    clocks: dict[int, Array] = {}
    for index, channel in enumerate(channels):
        if _looks_like_clock(channel, is_first=index == 0) and _rises(channel, warnings):
            clocks[index], how = channel.in_seconds()
            notes.append(f'clock: column {index + 1}, "{channel.heading}" ({how}; rising)')
    if not clocks and (step := _nameless_clock(channels[0])):
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


def _looks_like_clock(channel: RecordedChannel, *, is_first: bool) -> bool:
    """Whether a column's name or unit, or what it holds, is that of times; a unit alone says it of the first column."""
    if channel.is_clock:
        return True
    by_unit = channel.unit is not None and channel.unit.casefold() in TIME_UNITS
    named = TIME_NAME.fullmatch(channel.name.casefold()) is not None
    looks = (named and channel.unit is None) or (by_unit and (named or is_first))
    return looks and bool(np.isfinite(channel.values).any())


def _rises(channel: RecordedChannel, warnings: list[str] | None) -> bool:
    """Whether values rise as times do; that one does not which looks like a clock is warned of."""
    rising = rising_share(channel.values)
    if rising < RISING_SHARE and warnings is not None:
        warnings.append(
            f'"{channel.heading}" looks like a clock, but only {format_percent(rising)} of its steps go forward: '
            "it is not used as one"
        )
    return rising >= RISING_SHARE


def find_vector_clocks(
    channels: Sequence[RecordedChannel], scalars: Mapping[str, float], unit: str | None = None
) -> Clocks:
    """
    Find vectors of times by their name and by rising values; else a constant step by a scalar's name.

    A vector goes by the clock of its own struct, else of the structs around it, else by the only one as long as it.

    Parameters
    ----------
    channels : sequence of RecordedChannel
        Their headings are their paths in the file: `run.top`.
    scalars : mapping of str to float
        Single numbers of the file, by path.
    unit : str, optional
        Of the times; in seconds otherwise, or in what the vector's name ends with (`t_ms`).
    """
    notes: list[str] = []
    warnings: list[str] = []
    found: dict[int, Array] = {}
    start = None
    for number in _by_name(channels, warnings):
        found[number], how, moment = _seconds(channels[number], unit)
        start = start or moment
        notes.append(f"clock: {channels[number].heading} (by its name; rising; {how})")
    times = [found.get(number, _nearest(channel, channels, found)) for number, channel in enumerate(channels)]
    without = [channel for channel, time in zip(channels, times, strict=True) if time is None]
    if without:
        step, note = _constant_step(scalars)
        hints = (may_be_clock(channel.heading, channel.values) for channel in without)
        no_hint = ": no rising vector of its length has a name of times; give `time` or `sampling_rate`"
        notes.append(note or f"no clock for {without[0].heading}{next(filter(None, hints), no_hint)}")
        if step is not None:
            for number, channel in enumerate(channels):
                times[number] = even_times(channel.values.size, step) if times[number] is None else times[number]
    return Clocks(frozenset(found), tuple(times), tuple(notes), tuple(warnings), start)


def _by_name(channels: Sequence[RecordedChannel], warnings: list[str]) -> list[int]:
    """Numbers of the vectors that are clocks by name, one a struct and length, the plainest name first."""
    chosen: dict[tuple[tuple[str, ...], int], int] = {}
    for pattern in (PLAIN_NAME, TIME_NAME, OTHER_NAME):
        for number, channel in enumerate(channels):
            key = (channel.scope, channel.values.size)
            names = {channel.name, re.split(r"[./]", channel.heading)[-1]}
            names = {name.casefold() for name in names} if pattern is TIME_NAME else names
            is_named = key not in chosen and any(map(pattern.fullmatch, names))
            if is_named and _rises(channel, warnings if pattern is PLAIN_NAME else None):
                chosen[key] = number
    return sorted(chosen.values())


def _seconds(channel: RecordedChannel, unit: str | None) -> tuple[Array, str, datetime | None]:
    """Times in s, how they were understood, and their start if they are days of the calendar."""
    values = channel.values
    known = values[np.isfinite(values)]
    if unit is None and DATENUM[0] < known[0] and known[-1] < DATENUM[1] and known[-1] - known[0] < 30:
        start = datetime(1, 1, 1) + timedelta(days=float(known[0]) - 367)
        return (values - known[0]) * DAY, "days of MATLAB's calendar, from the first", start
    _, line, ending = channel.heading.rpartition("_")
    by_name = ending if line and channel.unit is None and ending.casefold() in TIME_UNITS else None
    return *channel.in_seconds(unit or by_name), None


def _nearest(channel: RecordedChannel, channels: Sequence[RecordedChannel], found: dict[int, Array]) -> Array | None:
    """Choose the clock of a vector among those as long as it."""
    fitting = [number for number, time in found.items() if time.size == channel.values.size]
    for depth in range(len(channel.scope), -1, -1):
        near = [number for number in fitting if channels[number].scope == channel.scope[:depth]]
        if near:
            return found[near[0]]
    return found[fitting[0]] if len(fitting) == 1 else None


def _constant_step(scalars: Mapping[str, float]) -> tuple[float | None, str]:
    """Find a step by the names of single numbers; where two contradict each other, say so."""
    steps = {}
    for path, value in scalars.items():
        last = path.rpartition(".")[2].casefold()
        if last in STEP_NAMES and 0 < value < 60:
            steps[path] = value
        elif last in RATE_NAMES and value > 0:
            steps[path] = 1 / value
    if not steps:
        return None, ""
    first, step = next(iter(steps.items()))
    if any(abs(other - step) > 1e-6 * step for other in steps.values()):
        told = ", ".join(f"{path} says {each:g} s" for path, each in steps.items())
        return None, f"no clock: the step is not clear ({told}); give sampling_rate"
    return step, f"clock: a constant step of {step:.9g} s, by the number {first}; no vector of times"


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


def on_one_zero(channels: Sequence[RecordedChannel]) -> tuple[tuple[RecordedChannel, ...], datetime | None]:
    """
    Count the times of channels that have starts of their own from the earliest of these.

    Returns
    -------
    channels : tuple of RecordedChannel
    start : datetime or None
        Of the first sample. None where no channel has a start, or only some of them have a zone: these cannot be
        compared, and times stay as they are.
    """
    starts = [channel.start for channel in channels if channel.start is not None]
    if len({moment.tzinfo for moment in starts}) != 1:
        return tuple(channels), None
    zero = min(starts)
    moved = list(channels)
    begins = []
    for number, channel in enumerate(channels):
        if channel.start is None or channel.time is None or not channel.time.size:
            continue
        shift = (channel.start - zero).total_seconds()
        moved[number] = replace(channel, time=channel.time + shift) if shift else channel
        begins.append(float(channel.time[0]) + shift)
    return tuple(moved), moment_after(zero, min(begins, default=0.0))


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
