"""Blocks of rows: fast where all rows are alike, and told where one is not."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.readers import table
from colonnade.readers.cells import Dialect

TAB = Dialect("utf-8", "\t", ".")


def rows(*texts: str) -> list[tuple[int, str]]:
    return list(enumerate(texts, 11))


@pytest.mark.parametrize("rows_at_once", [2, 20_000], ids=["in pieces", "at once"])
def test_columns_and_lines_come_out_whatever_the_size_of_the_pieces(
    monkeypatch: pytest.MonkeyPatch, rows_at_once: int
) -> None:
    monkeypatch.setattr(table, "ROWS_AT_ONCE", rows_at_once)
    found = table.read_table(rows(*(f"{row}.5\t{-row}" for row in range(5))), TAB, 2)
    assert [column.tolist() for column in found.columns] == [[0.5, 1.5, 2.5, 3.5, 4.5], [0, -1, -2, -3, -4]]
    assert found.lines.tolist() == [11, 12, 13, 14, 15]
    assert found.ending == ("3.5\t-3", "4.5\t-4")


@pytest.mark.parametrize(
    ("odd", "told"),
    [
        ("7", "1 row with too many or too few cells (on line 12): missing"),
        ("7\t8\t9\t10", "1 row with too many or too few cells (on line 12): missing"),
        ("7\tOVL", '"b": 1 cell holds no number (on line 12); missing'),
        ("1.2.3\t8", '"a": 1 cell holds no number (on line 12); missing'),
        ("7\tinf", '"b": 1 cell holds no number (on line 12); missing'),
    ],
)
def test_a_row_that_is_not_as_the_others_is_told_with_its_line(odd: str, told: str) -> None:
    found = table.read_table(rows("1\t2", odd, "3\t4"), TAB, 2)
    assert table.report_faults(found, ["a", "b"]) == [told]
    assert [column[[0, 2]].tolist() for column in found.columns] == [[1, 3], [2, 4]]
    assert np.isnan([column[1] for column in found.columns]).any()


def test_cells_beyond_the_columns_are_not_looked_at() -> None:
    found = table.read_table(rows("1\t2\tOK", "3\t4", "5\t6\tlost"), TAB, 2, beyond=1)
    assert [column.tolist() for column in found.columns] == [[1, 3, 5], [2, 4, 6]]
    assert table.report_faults(found, ["a", "b"]) == []


@pytest.mark.parametrize(
    ("last", "size", "told"),
    [
        ("3.25", 2, "line 13: left out: the file ends here"),
        ("3.25\t4.7", 3, 'ends within a number: "4.7" on line 13 has 1 decimals where the one above has 2'),
        ("3.25\t4.75", 3, ""),
    ],
)
def test_the_end_of_a_file_that_was_cut_off_is_mended(last: str, size: int, told: str) -> None:
    found, warnings = table.without_cut_end(table.read_table(rows("1.25\t2.50", "2.25\t3.50", last), TAB, 2), TAB)
    assert found.lines.size == size
    assert (told in warnings[0]) if told else (warnings == [])
    assert np.isnan(found.columns[1][-1]) == ("4.7 " in f"{last} ")


def test_no_rows_are_an_empty_table() -> None:
    found, warnings = table.without_cut_end(table.read_table([], TAB, 3), TAB)
    assert [column.size for column in found.columns] == [0, 0, 0]
    assert warnings == []
