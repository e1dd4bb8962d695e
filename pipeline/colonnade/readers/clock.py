"""The clock of each channel: its own, a column that is named, one that is found by name and rising values, a step."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import datetime, timedelta

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.readers.format import Options
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording, TimeUnit

TIME_NAME = re.compile(
    r"(?:t|(?:running\W?)?time|zeit|messzeit|laufzeit|time\W?stamp|date\W?time|elapsed(?:\W?time)?|temps|tiempo|tempo|tid|χρόνοσ|χρονοσ"
    r"|seconds|sekunden|sec)(?:[\s_#-]*\d+)?(?:\s+-\s.*)?"
)
LIKE_TIME = re.compile(
    r"t[A-Z]\w*|[tT]_?(?:out|meas|vec|vector|axis|rel|sim|exp|s|sec|ms)?_?\d*|.*_t|\w*time(?:[A-Z_]\w*|s|stamps?)?|.*Time\w*"
)
"""Names that count where no other channel of the same length has a plainer one."""
STEP_NAMES = frozenset(("dt", "ts", "deltat", "delta_t", "sampletime", "sample_time", "tsample", "samplinginterval"))
RATE_NAMES = frozenset(
    ("fs", "fsamp", *(f"{word}{what}" for word in ("sample", "sampling") for what in ("rate", "_rate", "frequency")))
)
EQUAL = 1e-3
"""Largest difference of a step from the mean, as a share of it, in what rises in equal steps."""
FEWEST_STEPS = 4
LONGEST_STEP = 0.5
"""Longest step, s, of a column without a name that counts as times in seconds."""


class ClockOptions(Options):
    """What can be said about the clock of a file of columns or vectors; it is found if it is not given."""

    time: str | int | None = Field(
        default=None, description="Name or number, from 1, of the column that is the clock of all that are as long."
    )
    time_unit: TimeUnit | None = Field(default=None, description="Unit of that column.")


RISING_SHARE = 0.9
"""Share of steps that are positive in what is still a clock; the rest is for quality control to flag."""


def with_clocks(
    recording: Recording,
    time: str | int | None = None,
    unit: str | None = None,
    scalars: Mapping[str, float] | None = None,
    yielding: Collection[int] = (),
) -> Recording:
    """
    Give each channel its times, and say how they were found.

    A channel keeps the times that its reader gave it, counted from the earliest start of all. Another one has those of
    the nearest column of times as long as it: to its left, in its own struct or group, else in those around it. If no
    column is one, a scalar gives a constant step.

    Parameters
    ----------
    recording : Recording
    time : str or int, optional
        The column of times of all that are as long as it, as for `Recording.channel`.
    unit : str, optional
        Unit of that column, or of those that are found.
    scalars : mapping of str to float, optional
        Single numbers of the file, by path.
    yielding : collection of int, optional
        Numbers, from 0, of the channels that keep their times only if no column gives them others.

    Raises
    ------
    ReadError
        If the column that is named is missing or holds no number.
    """
    timed, start = on_one_zero(recording.channels)
    channels = [replace(each, time=None) if number in yielding else each for number, each in enumerate(timed)]
    notes: list[str] = []
    warnings: list[str] = []
    clocks: dict[int, Array] = {}
    named = _by_name(channels, warnings)
    for number in named or _by_steps(channels):
        clocks[number], how = channels[number].in_seconds(unit if time is None else None)
        what = "rising" if named else "rising in equal steps, without a name"
        notes.append(f'clock: column {number + 1}, "{channels[number].heading}" ({how}; {what})')
    times = [clocks.get(number, _nearest(number, channels, clocks)) for number in range(len(channels))]
    times = [timed[number].time if each is None else each for number, each in enumerate(times)]
    if time is not None:
        given, seconds, how = recording.clock(time, unit)
        clocks[given] = seconds
        notes.append(f'clock: "{channels[given].heading}", as given ({how})')
        for number, channel in enumerate(channels):
            if channel.values.size == seconds.size and (number == given or number not in clocks):
                times[number] = seconds
    without = [number for number, each in enumerate(times) if each is None]
    if without:
        step, note = _constant_step(scalars or {})
        others = f" and {len(without) - 1} more" if len(without) > 1 else ""
        missing = f'no clock for "{channels[without[0]].heading}"{others}: no rising column has a name or unit of time'
        notes.append(note or missing)
        if step is not None:
            for number in without:
                times[number] = even_times(channels[number].values.size, step)
    return replace(
        recording,
        channels=tuple(
            replace(channel, time=each, is_clock=number in clocks)
            for number, (channel, each) in enumerate(zip(channels, times, strict=True))
        ),
        start=start or recording.start,
        notes=(*recording.notes, *notes),
        warnings=(*recording.warnings, *warnings),
    )


def _by_name(channels: Sequence[RecordedChannel], warnings: list[str]) -> list[int]:
    """Numbers of the channels that are clocks by name or unit and rise; that a plain one does not is warned of."""
    bundles: dict[tuple[tuple[str, ...], int], list[int]] = {}
    for number, channel in enumerate(channels):
        bundles.setdefault((channel.scope, channel.values.size), []).append(number)
    found: list[int] = []
    for members in bundles.values():
        plain = [number for number in members if _is_time(channels[number], is_first=number == members[0])]
        rising = [number for number in plain if _rises(channels[number])]
        for channel in [channels[number] for number in plain if number not in rising]:
            if np.isfinite(channel.values).any():
                looks = f'"{channel.heading}" looks like a clock'
                warnings.append(f"{looks}, but too few of its steps go forward: it is not used as one")
        unnamed = (number for number in members if channels[number].unit is None)
        alike = (number for number in unnamed if any(map(LIKE_TIME.fullmatch, _names(channels[number]))))
        found += rising or [number for number in alike if _rises(channels[number])][:1]
    return sorted(found)


def _rises(channel: RecordedChannel) -> bool:
    return rising_share(channel.values) >= RISING_SHARE


def _names(channel: RecordedChannel) -> set[str]:
    return {channel.name, re.split(r"[./]", channel.heading)[-1]} if channel.scope else {channel.name}


def _is_time(channel: RecordedChannel, *, is_first: bool) -> bool:
    """Whether name and unit are those of times; a unit alone says it of the first in a table or group."""
    by_unit = channel.unit is not None and channel.unit.casefold() in TIME_UNITS
    by_name = any(TIME_NAME.fullmatch(name.casefold()) for name in _names(channel))
    return channel.is_clock or (by_name and (by_unit or channel.unit is None)) or (by_unit and is_first)


def _by_steps(channels: Sequence[RecordedChannel]) -> list[int]:
    """
    The first column, if it has neither name nor unit, and can only be times in seconds.

    Whole steps may be numbers of samples, and steps of half a second or more times in another unit.
    """
    first = channels[0] if channels else None
    if first is None or first.name != "column 1" or first.unit is not None or first.values.size <= FEWEST_STEPS:
        return []
    count, begin = first.values.size, float(first.values[0])
    step = float(first.values[-1] - begin) / (count - 1)
    # Rounded times are off by less than a step.
    is_even = np.all(np.diff(first.values) > 0) and np.all(np.abs(first.values - even_times(count, step, begin)) < step)
    return [0] if is_even and step < LONGEST_STEP else []


def _nearest(number: int, channels: Sequence[RecordedChannel], clocks: Mapping[int, Array]) -> Array | None:
    """Its own times, else those of the nearest clock as long as it."""
    channel = channels[number]
    if channel.time is not None:
        return channel.time
    fitting = [clock for clock, times in clocks.items() if times.size == channel.values.size]
    for depth in range(len(channel.scope), -1, -1):
        near = [clock for clock in fitting if channels[clock].scope == channel.scope[:depth]]
        if near:
            return clocks[max((clock for clock in near if clock < number), default=near[0])]
    return None


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
    told = ", ".join(f"{path} says {each:g} s" for path, each in steps.items())
    if max(steps.values()) > (1 + 1e-6) * min(steps.values()):
        return None, f"no clock: the step is not clear ({told}); give sampling_rate"
    return next(iter(steps.values())), f"clock: a constant step; {told}; no vector of times"


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
    shifted: dict[tuple[int, float], Array] = {}  # channels that share their times go on sharing them
    for number, channel in enumerate(channels):
        if channel.start is None or channel.time is None or not channel.time.size:
            continue
        shift = (channel.start - zero).total_seconds()
        if shift and (key := (id(channel.time), shift)) not in shifted:
            shifted[key] = channel.time + shift
        moved[number] = replace(channel, time=shifted[key]) if shift else channel
        begins.append(float(channel.time[0]) + shift)
    return tuple(moved), moment_after(zero, min(begins, default=0.0))


def even_times(count: int, step: float, begin: float = 0.0) -> Array:
    """Give times in equal steps, s; NaN if a damaged header's step or begin leads beyond all numbers."""
    if not np.isfinite(begin) or not np.isfinite(step * count):
        return np.full(count, np.nan)
    times: Array = begin + step * np.arange(count, dtype=np.float64)
    return times


def moment_of(text: str) -> datetime | None:
    """
    Read a date with time, the year in front or, between points, behind; None if it is none.

    Examples
    --------
    >>> {moment_of(text) for text in ("26.04.2013 10:15:00,5", "2013/04/26 10:15:00.5", "2013-04-26T10:15:00.5")}
    {datetime.datetime(2013, 4, 26, 10, 15, 0, 500000)}
    """
    iso = re.sub(r"^(\d\d)\.(\d\d)\.(\d{4})", r"\3-\2-\1", text).replace("/", "-").replace(",", ".")
    with suppress(ValueError):
        return datetime.fromisoformat(re.sub(r"\s+(?=[-+]\d\d)", "", iso))
    return None


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
    known = values[np.isfinite(values)] if (np.diff(values[:100]) > 0).all() else values[:0]
    step = equal_step(known, EQUAL) if known.size > 2 else None
    return "" if step is None else f'; set time = "{heading}" if that is one: it rises in equal steps of {step:g}'
