"""The clock that an option names is that of all vectors as long as it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.binary.vector_clocks import given_clock
from colonnade.readers.binary.vectors import Column, named, recorded

COLUMNS = named(
    [
        Column("run.t", ("run",), np.arange(4) * 5),
        Column("run.top", ("run",), np.array([0.0, np.inf, 2.0, 3.0])),
        Column("other.top", ("other",), np.arange(3.0)),
    ]
)


def test_columns_are_called_by_the_last_part_of_their_path_where_that_is_clear() -> None:
    assert [column.name for column in COLUMNS] == ["t", "run.top", "other.top"]


def test_the_clock_that_was_named_is_that_of_all_as_long_as_it() -> None:
    recording, infinite = recorded(Path("a.mat"), "matlab", COLUMNS)
    assert infinite == ["run.top: 1 value is infinite, the first at sample 2: taken as missing"]
    clocks = given_clock(recording, "t", "ms")
    clock, top, other = clocks.applied(recording.channels)
    assert clock.is_clock
    assert not top.is_clock
    np.testing.assert_allclose(top.time, [0, 0.005, 0.01, 0.015])
    assert other.time is None
    assert clocks.warnings == ("1 channel is not as long as run.t: no clock",)


def test_a_clock_without_a_number_is_refused() -> None:
    recording, _ = recorded(Path("a.mat"), "matlab", [Column("t", (), np.full(3, np.nan), "t")])
    with pytest.raises(ReadError, match=r"a.mat: t holds no number, so it cannot be the clock. Name a channel"):
        given_clock(recording, "t", None)
