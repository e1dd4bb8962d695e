"""Channels and their clocks in files that hold vectors in structs and groups, not columns of one table."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from colonnade.arrays import Array
from colonnade.readers.clock import RISING_SHARE, TIME_NAME, Clocks, even_times, may_be_clock, rising_share
from colonnade.readers.format import Options
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording, TimeUnit
from colonnade.units import format_percent


class UnreadableError(Exception):
    """A part of a file that is whole, but not read; its text is the reason."""


@dataclass(frozen=True)
class Column:
    """
    One column of numbers.

    Attributes
    ----------
    path : str
        As it is reached in the file: `run.top`, `x[2]` (the second column of x).
    scope : tuple of str
        Structs or groups that contain it, outermost first.
    values : ndarray of numbers, shape (n,)
    name, unit : str or None
        If the file gives them with the numbers.
    """

    path: str
    scope: tuple[str, ...]
    values: NDArray[Any]
    name: str | None = None
    unit: str | None = None


def named(columns: list[Column]) -> list[Column]:
    """Name columns without a name by the last part of their path, or by all of it if another column has that part."""
    last = [column.name or column.path.rpartition(".")[2] for column in columns]
    counts = Counter(last)
    return [
        replace(column, name=short if counts[short] == 1 else column.path)
        for column, short in zip(columns, last, strict=True)
    ]


def recorded(path: Path, format: str, columns: list[Column]) -> tuple[Recording, list[str]]:
    """Make channels of columns that have names, in their order, with warnings of infinite values."""
    channels, warnings = [], []
    for column in columns:
        values, infinite = as_values(column.values)
        channels.append(RecordedChannel(column.name or column.path, column.unit, values, heading=column.path))
        warnings += [f"{column.path}: {infinite}"] if infinite else []
    return Recording(path, format, tuple(channels)), warnings


def as_values(numbers: NDArray[Any]) -> tuple[Array, str]:
    """
    Take numbers as a channel's values.

    Parameters
    ----------
    numbers : ndarray, shape (n,)
        Booleans, integers or floats.

    Returns
    -------
    values : ndarray of float64, shape (n,)
        The array itself where it is one already and needs no change; NaN in place of infinities.
    warning : str
        How many infinities there were, such as "2 values are infinite, …"; empty if there are none.
    """
    values = np.ascontiguousarray(numbers, dtype=np.float64)
    with np.errstate(all="ignore"):
        if np.isfinite(values.sum()):  # one pass without a copy: the usual case
            return values, ""
    infinite = np.isinf(values)
    if not infinite.any():
        return values, ""
    count = int(infinite.sum())
    first = int(np.argmax(infinite)) + 1
    what = "1 value is" if count == 1 else f"{count} values are"
    return np.where(infinite, np.nan, values), f"{what} infinite, the first at sample {first}: taken as missing"


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


class ClockOptions(Options):
    """What can be said about a file of vectors."""

    time: str | int | None = Field(
        default=None, description="Channel, by name or number from 1, that is the clock of all that are as long as it."
    )
    time_unit: TimeUnit | None = Field(default=None, description="Unit of the times.")


def find_clocks(columns: list[Column], scalars: dict[str, float], unit: str | None = None) -> Clocks:
    """
    Find vectors of times by their name and by rising values; else a constant step by a scalar's name.

    A column goes by the clock of its own struct, else of the structs around it, else by the only one as long as it.

    Parameters
    ----------
    columns : list of Column
    scalars : dict of str to float
        Single numbers of the file, by path.
    unit : str, optional
        Of the times; in seconds otherwise, or in what the vector's name ends with (`t_ms`).
    """
    times: list[Array | None] = [None] * len(columns)
    notes: list[str] = []
    warnings: list[str] = []
    found: dict[int, Array] = {}
    start = None
    for number in _by_name(columns, warnings):
        time, how, moment = _seconds(columns[number], unit)
        found[number], start = time, start or moment
        notes.append(f"clock: {columns[number].path} (by its name; rising; {how})")
    for number, column in enumerate(columns):
        chosen = number if number in found else _nearest(column, columns, found)
        times[number] = None if chosen is None else found[chosen]
    without = [number for number, time in enumerate(times) if time is None]
    if without:
        step, note = _constant_step(scalars)
        notes += [note] if note else [f"no clock for {columns[without[0]].path}{_hint(columns, without)}"]
        if step is not None:
            for number in without:
                times[number] = even_times(columns[number].values.size, step)
    return Clocks(frozenset(found), tuple(times), tuple(notes), tuple(warnings), start)


def _by_name(columns: list[Column], warnings: list[str]) -> list[int]:
    """Numbers of the columns that are clocks by name, one a struct and length, the plainest name first."""
    chosen: dict[tuple[tuple[str, ...], int], int] = {}
    for pattern in (PLAIN_NAME, TIME_NAME, OTHER_NAME):
        for number, column in enumerate(columns):
            key = (column.scope, column.values.size)
            names = {column.name or "", re.split(r"[./]", column.path)[-1]}
            if pattern is TIME_NAME:
                names = {name.casefold() for name in names}
            if key in chosen or not any(map(pattern.fullmatch, names)):
                continue
            rising = rising_share(np.asarray(column.values, dtype=np.float64))
            if rising >= RISING_SHARE:
                chosen[key] = number
            elif pattern is PLAIN_NAME:
                warnings.append(
                    f"{column.path} looks like a clock, but only {format_percent(rising)} of its steps go forward: "
                    "it is not used as one"
                )
    return sorted(chosen.values())


def _seconds(column: Column, unit: str | None) -> tuple[Array, str, datetime | None]:
    """Times in s, how they were understood, and their start if they are days of the calendar."""
    values = np.asarray(column.values, dtype=np.float64)
    known = values[np.isfinite(values)]
    if unit is None and DATENUM[0] < known[0] and known[-1] < DATENUM[1] and known[-1] - known[0] < 30:
        start = datetime(1, 1, 1) + timedelta(days=float(known[0]) - 367)
        return (values - known[0]) * DAY, "days of MATLAB's calendar, from the first", start
    ending = column.path.rpartition("_")[2]
    told = unit or column.unit or (ending if "_" in column.path and ending.casefold() in TIME_UNITS else None)
    factor = TIME_UNITS.get((told or "s").casefold(), 1.0)
    return values * factor, f"in {told}" if told else "taken as seconds", None


def _nearest(column: Column, columns: list[Column], found: dict[int, Array]) -> int | None:
    """Choose the clock of a column among those as long as it."""
    fitting = [number for number, time in found.items() if time.size == column.values.size]
    for depth in range(len(column.scope), -1, -1):
        near = [number for number in fitting if columns[number].scope == column.scope[:depth]]
        if near:
            return near[0]
    return fitting[0] if len(fitting) == 1 else None


def _constant_step(scalars: dict[str, float]) -> tuple[float | None, str]:
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


def _hint(columns: list[Column], without: list[int]) -> str:
    """Hint at a vector that may be a clock nevertheless."""
    hints = (may_be_clock(columns[number].path, columns[number].values.astype(np.float64)) for number in without)
    no_hint = ": no rising vector of its length has a name of times; give `time` or `sampling_rate`"
    return next(filter(None, hints), no_hint)
