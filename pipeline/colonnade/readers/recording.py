"""The content of a raw file, as recorded: channels in the file's own units, with the evidence for every guess."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import AfterValidator

from colonnade.arrays import Array
from colonnade.errors import ReadError, nearest
from colonnade.units.text import joined

TIME_UNITS = {
    **dict.fromkeys(("s", "sec", "sec.", "secs", "second", "seconds", "sek", "sek.", "sekunde", "sekunden"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds", "millisekunden"), 1e-3),
    **dict.fromkeys(("us", "µs", "μs", "usec", "microsecond", "microseconds"), 1e-6),
    **dict.fromkeys(("min", "minute", "minutes", "minuten"), 60.0),
    **dict.fromkeys(("h", "hr", "hour", "hours", "stunden"), 3600.0),
}
"""Spellings of units of time, casefolded, in s."""
DATENUM = (693_962.0, 767_011.0)
"""Days of MATLAB's calendar from 1900 to 2100."""


def _time_unit(unit: str) -> str:
    if unit.casefold() not in TIME_UNITS:
        raise ValueError('a unit of time was expected: "s", "ms", "us", "min" or "h"')
    return unit


TimeUnit = Annotated[str, AfterValidator(_time_unit)]
"""An option that names a unit of time."""


@dataclass(frozen=True)
class RecordedChannel:
    """
    One column of a raw file.

    Attributes
    ----------
    name : str
        Its name, without the unit: `LVDT 1`.
    unit : str or None
        As written in the file, if it says so.
    values : ndarray, shape (n,)
        In that unit; NaN without a number in the file.
    time : ndarray, shape (n,), or None
        Seconds from the file's own zero; NaN without a time in the file; None if it has no clock.
    heading : str
        The head of the column as written, `LVDT 1 [mm]`; the name if nothing else is known.
    is_clock : bool
        Whether the column holds times; `time` is then its own values in seconds.
    scope : tuple of str
        Structs or groups of the file that contain it, outermost first.
    start : datetime or None
        When its time is zero, where the file says it of each channel.
    """

    name: str
    unit: str | None
    values: Array
    time: Array | None = None
    heading: str = ""
    is_clock: bool = False
    scope: tuple[str, ...] = ()
    start: datetime | None = None

    def __post_init__(self) -> None:
        if not self.heading:
            object.__setattr__(self, "heading", self.name)
        if self.time is not None and self.time.shape != self.values.shape:
            raise ValueError(
                f"{self.name} has {self.values.size} values at {self.time.size} times; "
                "one time for each value was expected"
            )

    def in_seconds(self, unit: str | None = None) -> tuple[Array, str]:
        """
        Give its values as times.

        In a unit that is given, else its own or the one that its heading ends with (`t_ms`), else in seconds, as in one
        that is none of time. Days of MATLAB's calendar are counted from the first; a clock has its times already.

        Returns
        -------
        times : ndarray, shape (n,)
            s.
        how : str
            How its values are understood.
        """
        if self.is_clock and self.time is not None:
            return self.time, "timestamps"
        known = self.values[np.isfinite(self.values)]
        unit = unit or self.unit
        if unit is None and known.size and DATENUM[0] < known[0] <= known[-1] < min(DATENUM[1], known[0] + 30):
            return (self.values - known[0]) * 86400.0, "days of MATLAB's calendar, from the first"
        _, line, ending = self.heading.rpartition("_")
        unit = ending if unit is None and line and ending.casefold() in TIME_UNITS else unit
        factor = TIME_UNITS.get((unit or "s").casefold(), 1.0)
        how = f"in {unit}" if unit else "without a unit, taken as seconds"
        return (self.values if factor == 1.0 else self.values * factor), how


@dataclass(frozen=True)
class Recording:
    """
    All that a raw file holds.

    Attributes
    ----------
    path : Path
        The file.
    format : str
        Name of the format it was read as.
    channels : tuple of RecordedChannel
        In the order of the file.
    start : datetime or None
        Date and time of the first sample, if the file gives it.
    notes : tuple of str
        What was sniffed, each with its evidence.
    warnings : tuple of str
        What was not as it should be: cells without a number, damaged lines; each with its line in the file.
    """

    path: Path
    format: str
    channels: tuple[RecordedChannel, ...]
    start: datetime | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()

    def channel(self, column: str | int) -> RecordedChannel:
        """
        Find a channel.

        Parameters
        ----------
        column : str or int
            Its name, with or without the unit as in the file, whatever its case and spaces; or its number, from 1.

        Raises
        ------
        ReadError
            If no channel, or more than one, has this name; the message gives the nearest.
        """
        there = len(self.channels)
        if isinstance(column, int):
            if 1 <= column <= there:
                return self.channels[column - 1]
            numbers = "1 column" if there == 1 else f"columns 1 to {there}"
            raise ReadError(
                f"{self.path.name}: column {column} is missing; it has {numbers}. Columns are counted from 1."
            )
        headings = [channel.heading for channel in self.channels]
        names = [channel.name for channel in self.channels]
        for spelled in (str, _plain):
            for candidates in (headings, names):
                found = [number for number, each in enumerate(candidates, 1) if spelled(each) == spelled(column)]
                if len(found) == 1:
                    return self.channels[found[0] - 1]
                if found:
                    listed = joined([str(number) for number in found])
                    raise ReadError(
                        f'{self.path.name}: {len(found)} columns are called "{column}": columns {listed}. Give the '
                        "number of the right one instead of its name."
                    )
        raise ReadError(
            f'{self.path.name}: no column is called "{column}"; it has {there} column{"s" * (there > 1)}.'
            f"{nearest(column, names)}"
        )

    def clock(self, column: str | int, unit: str | None = None) -> tuple[int, Array, str]:
        """
        Find the channel that is given as a clock.

        Parameters
        ----------
        column : str or int
            As for `channel`.
        unit : str, optional
            Of the times; by default as `RecordedChannel.in_seconds` says.

        Returns
        -------
        number : int
            Of the channel, from 0.
        times : ndarray, shape (n,)
            s.
        how : str
            How its values are understood.

        Raises
        ------
        ReadError
            If it is missing or holds no number.
        """
        clock = self.channel(column)
        times, how = clock.in_seconds(unit)
        if not np.isfinite(times).any():
            raise ReadError(
                f'{self.path.name}: column "{clock.heading}" holds no number, so it cannot be the clock. '
                "Name a column of times, or leave `time` out and give `sampling_rate`."
            )
        return next(number for number, each in enumerate(self.channels) if each is clock), times, how

    def on_clock(self, column: str | int, time_column: str | int) -> RecordedChannel:
        """
        Give a channel with the times of another column of the same file.

        Parameters
        ----------
        column, time_column : str or int
            As for `channel` and `clock`.

        Raises
        ------
        ReadError
            If either is missing, the time column holds no number, or they are not equally long.
        """
        channel = self.channel(column)
        number, times, _ = self.clock(time_column)
        if times.size != channel.values.size:
            raise ReadError(
                f'{self.path.name}: "{channel.heading}" has {channel.values.size} values, its clock '
                f'"{self.channels[number].heading}" has {times.size}: one time for each value was expected.'
            )
        return replace(channel, time=times)


def _plain(name: str) -> str:
    """Name without what people type differently: case and spaces."""
    return "".join(name.casefold().split())
