"""A table of columns, from a text or a sheet -> a recording; the options of such a table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator

from colonnade.arrays import Array
from colonnade.readers.clock import Clocks, find_clocks, given_clock
from colonnade.readers.format import Options
from colonnade.readers.recording import RecordedChannel, Recording, TimeUnit
from colonnade.readers.text.heading import Heading, HeadingLines
from colonnade.readers.text.layout import HeaderClaims, Layout


class TableOptions(Options):
    """What can be said about a table; all of it is found if it is not given."""

    names_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' names, from 1; 0 if they have no names."
    )
    units_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' units, from 1; 0 if there are none."
    )
    time: str | int | None = Field(default=None, description="Name or number, from 1, of the column that is the clock.")
    time_unit: TimeUnit | None = Field(default=None, description="Unit of that column.")
    layout: Literal["columns", "running"] | None = Field(
        default=None,
        description='"columns" if each column is a channel, "running" if numbers run on from row to row.',
    )

    @model_validator(mode="after")
    def _unit_has_column(self) -> Self:
        if self.time_unit is not None and self.time is None:
            raise ValueError("time_unit needs `time`: the column it belongs to")
        return self

    def given_layout(self, kinds: Sequence[str]) -> Layout | None:
        """What the rows are, as given or as columns that are not all numbers have to be; None if neither says it."""
        if self.layout is not None:
            return Layout(self.layout, "as given")
        return Layout("columns") if self.time is not None or set(kinds) != {"number"} else None

    def heading_lines(self, found: HeadingLines) -> HeadingLines:
        """Lines of names and units: as given, else as found; a line that is given as one is not found as the other."""
        names, units = found.names, found.units
        if self.names_row is not None:
            names = self.names_row - 1 if self.names_row else None
            units = None if units == self.names_row - 1 else units
        if self.units_row is not None:
            units = self.units_row - 1 if self.units_row else None
            names = None if self.names_row is None and names == self.units_row - 1 else names
        return HeadingLines(names, units)


@dataclass(frozen=True)
class Table:
    """
    Columns with their heading.

    Attributes
    ----------
    path : Path
    format : str
    heading : Heading
    kinds : tuple of str
        What each column holds: `number`, `time` (in seconds from the first), `text` or `empty`.
    columns : list of ndarray, shape (n,)
    start : datetime or None
        Of the first timestamp that has a date.
    """

    path: Path
    format: str
    heading: Heading
    kinds: tuple[str, ...]
    columns: Sequence[Array]
    start: datetime | None = None

    def recording(self, options: TableOptions, claims: HeaderClaims) -> Recording:
        """
        Give the columns as channels, each on its clock.

        A single column without a clock has the unit and the interval that the lines above it claim.

        Raises
        ------
        ReadError
            If the column of times that the options name is missing or holds no number.
        """
        heading = self.heading
        each = zip(heading.names, heading.units, self.columns, heading.headings, self.kinds, strict=True)
        channels = tuple(
            RecordedChannel(name, unit, values, values if kind == "time" else None, head, kind == "time")
            for name, unit, values, head, kind in each
        )
        recording = Recording(self.path, self.format, channels, self.start)
        clocks = self._clocks(recording, options)
        if len(channels) == 1 and not clocks.columns:
            recording = replace(recording, channels=(replace(channels[0], unit=channels[0].unit or claims.unit),))
            clocks = Clocks(frozenset(), (claims.times(channels[0].values.size),), (claims.clock_note,), ())
        return clocks.applied(recording)

    def _clocks(self, recording: Recording, options: TableOptions) -> Clocks:
        """Times of the channels: by the column that was given, else by those found."""
        found = find_clocks(recording.channels)
        if options.time is None:
            return found
        given = given_clock(recording, options.time, options.time_unit)
        others = found.columns - given.columns
        times = tuple((found if number in others else given).times[number] for number in range(len(given.times)))
        return replace(given, columns=found.columns | given.columns, times=times)
