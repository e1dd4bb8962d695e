"""Where the samples begin."""

from __future__ import annotations

from colonnade.readers.text.first_sample import column_kinds, find_first_sample
from colonnade.readers.text.lines.cells import Dialect, is_sample

SEMICOLON = Dialect("utf-8", ";", ".")
LINES = ["Test 7; 3", "Time;x;state", "10:15:00;1;on", "10:15:01;OVL;on", "10:15:02;3;off"]


def test_columns_are_named_by_what_most_of_their_cells_hold() -> None:
    assert column_kinds(LINES, SEMICOLON, 3) == ["time", "number", "text"]


def test_the_first_line_with_a_value_for_each_column_is_found() -> None:
    kinds = column_kinds(LINES, SEMICOLON, 3)
    assert find_first_sample(LINES, 0, SEMICOLON, kinds) == 2
    assert find_first_sample(LINES[:2], 0, SEMICOLON, kinds) is None
    assert is_sample(LINES[4], SEMICOLON, kinds)
    assert not is_sample("# " + LINES[4], SEMICOLON, kinds)
