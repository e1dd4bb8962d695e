"""Rows of numbers in a sheet, and what their columns hold."""

from __future__ import annotations

from datetime import datetime, time

import numpy as np

from colonnade.readers.excel.cells import Block, column_kinds, find_block, take_column

ROWS = [["Test 7", 26.4, ""], ["t", "x", "note"], [0.0, 1.0, "a"], ["", "", ""], [1.0, "2,5", "b"], ["end", "", ""]]


def block() -> Block:
    found = find_block(ROWS)
    assert found is not None
    return found


def test_the_rows_of_numbers_are_found_and_others_among_them_reported() -> None:
    found = block()
    assert (found.first, found.numbers) == (2, [3, 5])
    assert found.warnings == (
        "rows among the samples without any number, left out: 1, the first is row 4",
        "text below the last sample in row 5 is not read",
    )
    assert find_block([["only", "words"]]) is None


def test_columns_hold_numbers_times_or_text() -> None:
    assert column_kinds(block()) == ("number", "number", "text")
    column = take_column(block(), 1, "number")
    assert column.values.tolist() == [1, 2.5]
    assert column.warnings == ("numbers that are written as text: 1, the first in row 5",)
    assert take_column(block(), 2, "text").warnings == ()


def test_moments_are_seconds_from_the_first() -> None:
    dated = Block(0, [[datetime(2013, 4, 26, 10, 15)], [datetime(2013, 4, 26, 10, 15, 1)]], [1, 2], ())
    column = take_column(dated, 0, "time")
    assert (column.values.tolist(), column.start) == ([0, 1], datetime(2013, 4, 26, 10, 15))
    of_day = Block(0, [[time(23, 59, 59)], [time(0, 0, 1)]], [1, 2], ())
    np.testing.assert_array_equal(take_column(of_day, 0, "time").values, [0, 2])
