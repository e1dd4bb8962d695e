"""What is said of a table goes before what is found in it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.text.heading import Heading, HeadingLines
from colonnade.readers.text.layout import HeaderClaims
from colonnade.readers.text.table import Table, TableOptions
from every import every

FOUND = HeadingLines(2, 3)


@every(
    ("options", "names", "units"),
    [
        ({}, 2, 3),
        ({"names_row": 1}, 0, 3),
        ({"names_row": 4}, 3, None),
        ({"units_row": 3}, None, 2),
        ({"names_row": 0, "units_row": 0}, None, None),
    ],
)
def test_lines_of_names_and_units_are_as_given_else_as_found(
    options: dict[str, int], names: int | None, units: int | None
) -> None:
    assert TableOptions(**options).heading_lines(FOUND) == HeadingLines(names, units)


def table(*columns: list[float], kinds: tuple[str, ...]) -> Table:
    names = tuple(f"column {number}" for number in range(1, len(columns) + 1))
    heading = Heading(0, names, names, (None,) * len(columns), (), ())
    return Table(Path("a.csv"), "delimited", heading, kinds, [np.array(column) for column in columns])


def test_a_single_column_has_the_unit_and_clock_that_the_lines_above_claim() -> None:
    recording = table([1.0, 2.0], kinds=("number",)).recording(TableOptions(), HeaderClaims(step=0.5, unit="g"))
    (channel,) = recording.channels
    assert channel.unit == "g"
    assert channel.time is not None
    assert channel.time.tolist() == [0, 0.5]


def test_the_column_that_is_given_is_the_clock_of_the_others() -> None:
    options = TableOptions(time=1, time_unit="ms")
    recording = table([0.0, 5.0], [1.0, 2.0], kinds=("number", "number")).recording(options, HeaderClaims())
    clock, channel = recording.channels
    assert clock.is_clock
    assert channel.time is not None
    assert channel.time.tolist() == [0, 0.005]
    with pytest.raises(ReadError, match="holds no number, so it cannot be the clock"):
        table([np.nan], [1.0], kinds=("number", "number")).recording(TableOptions(time=1), HeaderClaims())


@every(
    ("kinds", "options", "kind"),
    [
        (("number", "number"), TableOptions(layout="running"), "running"),
        (("time", "number"), TableOptions(), "columns"),
        (("number", "number"), TableOptions(time=1), "columns"),
        (("number", "number"), TableOptions(), None),
    ],
)
def test_the_layout_is_as_given_or_as_the_columns_kinds_leave_it(
    kinds: tuple[str, ...], options: TableOptions, kind: str | None
) -> None:
    layout = options.given_layout(kinds)
    assert (None if layout is None else layout.kind) == kind
