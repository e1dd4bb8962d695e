"""Rows become columns of numbers; rows unlike the others come with their lines and faults."""

import numpy as np

from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Piece
from colonnade.readers.text.rows import RowForm, read_rows
from every import every

FORM = RowForm(Dialect(";", "."), ("number", "number"))


TABS = RowForm(Dialect("\t", "."), ("number", "number"))


def test_timestamps_are_seconds_from_the_first_in_later_pieces_too():
    pieces = [
        Piece(1, "2013-04-26 10:15:00.5;1\nbroken;2\n2013-04-26 10:15:01;2\n"),
        Piece(4, "2013-04-26 10:16:00.5;3\n"),
    ]
    columns, _ = read_rows(pieces, RowForm(FORM.dialect, ("time", "number")), "ab")
    np.testing.assert_array_equal(columns[0], [0, np.nan, 0.5, 60])


THREE = RowForm(Dialect(";", "."), ("number", "number", "number"))


def mended(*texts, form=THREE):
    pieces = [Piece(1, "\n".join([*texts, ""]))] if texts else []
    columns, warnings = read_rows(pieces, form, "abc"[: len(form.kinds)])
    return [column.tolist() for column in columns], warnings


def test_lines_that_are_not_samples_are_left_out_and_listed():
    columns, warnings = mended("1;2;3", "a;b;c", "4;5;6", "# event", "7;8;9")
    assert columns == [[1, 4, 7], [2, 5, 8], [3, 6, 9]]
    assert warnings == ['line 2: left out: text without a number ("a;b;c")']


def test_at_most_five_lines_are_listed():
    columns, warnings = mended(*["1;2;3", "1;2;3;4"] * 7, "1;2;3")
    assert warnings[0].startswith("lines 2, 4, 6, 8, 10 and 2 more: counted as missing: more than 3 cells")
    assert np.isnan(columns[0]).sum() == 7


def test_a_last_line_with_too_few_cells_is_left_out():
    columns, warnings = mended("1;2;3", "4;5", "7;8")
    np.testing.assert_array_equal(columns[0], [1, np.nan])
    assert warnings[0] == 'line 2: counted as missing: fewer than 3 cells ("4;5")'
    assert warnings[1] == 'line 3: left out: the file ends here, before all 3 cells ("7;8")'


def test_columns_that_lack_numbers_share_a_message():
    _, warnings = mended("1;2;3", "4;x;x", "5;x;x")
    assert warnings == ['"b", "c": 4 cells hold no number (first on line 2: "x"); missing']


def test_rows_of_ragged_columns_may_end_early():
    columns, warnings = mended("1;2;3", "4;;6", "7;8", form=RowForm(THREE.dialect, THREE.kinds, is_ragged=True))
    assert warnings == []
    np.testing.assert_array_equal(columns[1:], [[2, np.nan, 8], [3, 6, np.nan]])


@every(
    ("odd", "told"),
    [
        ("7", 'line 2: counted as missing: fewer than 2 cells ("7")'),
        ("7\t8\t9\t10", 'line 2: counted as missing: more than 2 cells ("7 8 9 10")'),
        ("7\tOVL", '"b": 1 cell holds no number (on line 2: "OVL"); missing'),
        ("1.2.3\t8", '"a": 1 cell holds no number (on line 2: "1.2.3"); missing'),
        ("7\tinf", '"b": 1 cell holds no number (on line 2: "inf"); missing'),
    ],
)
def test_a_row_that_is_not_as_the_others_is_told_with_its_line(odd, told):
    columns, warnings = mended("1\t2", odd, "3\t4", form=TABS)
    assert warnings == [told]
    assert [[column[0], column[2]] for column in columns] == [[1, 3], [2, 4]]
    assert np.isnan([column[1] for column in columns]).any()


@every("remarks", [False, True])
def test_remarks_and_empty_cells_beyond_the_columns_are_not_looked_at(remarks):
    form = RowForm(TABS.dialect, TABS.kinds, has_remarks=remarks)
    assert mended("1\t2" + "\tOK" * remarks, "3\t4\t\t\t", "5\t6", form=form) == ([[1, 3, 5], [2, 4, 6]], [])


@every("row", ["4;7;5;", "4;;;5", "5;"])
def test_a_row_with_another_number_of_cells_moves_no_value_where_lines_end_with_a_delimiter(row):
    form = RowForm(THREE.dialect, THREE.kinds[:2], trailing=1)
    columns, warnings = mended("1;2;", row, "7;8;", form=form)
    np.testing.assert_array_equal(columns, [[1, np.nan, 7], [2, np.nan, 8]])
    assert "line 2: counted as missing" in warnings[0]


def test_no_rows_are_empty_columns():
    assert mended(form=TABS) == ([[], []], [])
