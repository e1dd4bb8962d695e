"""What becomes of damaged rows."""

import numpy as np

from colonnade.readers.text.damage import mend
from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Piece
from colonnade.readers.text.rows import RowForm, read_rows
from every import every

FORM = RowForm(Dialect(";", "."), ("number", "number", "number"))


def mended(*texts, form=FORM, is_cut=False):
    pieces = [Piece(1, "\n".join(texts) + ("" if is_cut else "\n"))] if texts else []
    return mend(read_rows(pieces, form), ["a", "b", "c"][: len(form.kinds)])


def test_lines_that_are_not_samples_are_left_out_and_listed():
    result = mended("1;2;3", "a;b;c", "4;5;6", "# event", "7;8;9")
    assert [column.tolist() for column in result.columns] == [[1, 4, 7], [2, 5, 8], [3, 6, 9]]
    assert result.warnings == ['line 2: left out: text without a number ("a;b;c")']
    assert result.notes == ['line 4: left out as a comment ("# event")']


def test_at_most_five_lines_are_listed():
    result = mended(*["1;2;3", "1;2;3;4"] * 7)
    assert result.warnings[0].startswith("lines 2, 4, 6, 8, 10 and 2 more: counted as missing: more than 3 cells")
    assert np.isnan(result.columns[0]).sum() == 7


def test_two_short_rows_at_the_end_are_damage_and_three_are_shorter_columns():
    two, three = (mended("1;2;3", "4;5;6", *["7;8"] * count) for count in (2, 3))
    assert "fewer than 3 cells" in two.warnings[0]
    assert "from line 3 on there are 2 cells" in three.notes[0]
    assert three.columns[0].tolist() == [1, 4, 7, 7, 7]


def test_columns_that_lack_numbers_in_the_same_rows_share_a_message():
    result = mended("1;2;3", "4;x;x", "5;x;x")
    assert result.warnings == ['"b", "c": 2 cells hold no number (first on line 2: "x"); missing']


def test_ragged_columns_end_where_their_last_number_is():
    form = RowForm(FORM.dialect, FORM.kinds, by_instrument=True, ragged=True)
    assert mended("1;2;3", "4;;6", "7;8;", form=form).warnings == [
        '"b": 1 cell holds no number (on line 2: nothing); missing'
    ]


INSTRUMENT = RowForm(Dialect("\t", "."), ("number", "number"), by_instrument=True)
REMARKS = RowForm(Dialect("\t", "."), ("number", "number"), trailing=1, by_instrument=True)


@every(
    ("odd", "told"),
    [
        ("7", 'line 2: counted as missing: fewer than 2 cells ("7")'),
        ("7\t8\t9\t10", 'line 2: counted as missing: more than 2 cells ("7 8 9 10")'),
        ("7\tOVL", '"b": 1 cell holds no number (on line 2: "OVL"); missing'),
        ("1.2.3\t8", '"a": 1 cell holds no number (on line 2: "1.2.3"); missing'),
        ("7\tinf", '"b": 1 cell holds no number (on line 2: "inf"); missing'),
        ("# 7\tabc", '"a", "b": 1 cell holds no number (on line 2: "# 7"); missing'),
    ],
)
def test_a_row_that_is_not_as_the_others_is_told_with_its_line(odd, told):
    result = mended("1\t2", odd, "3\t4", form=INSTRUMENT)
    assert result.warnings == [told]
    assert [column[[0, 2]].tolist() for column in result.columns] == [[1, 3], [2, 4]]
    assert np.isnan([column[1] for column in result.columns]).any()


def test_empty_cells_at_the_end_of_an_instruments_row_are_nothing():
    result = mended("1\t2", "3\t4\t\t\t", "5\t6", form=INSTRUMENT)
    assert [column.tolist() for column in result.columns] == [[1, 3, 5], [2, 4, 6]]
    assert result.warnings == []


def test_remarks_beyond_the_columns_are_not_looked_at():
    result = mended("1\t2\tOK", "3\t4", "5\t6\tlost", form=REMARKS)
    assert [column.tolist() for column in result.columns] == [[1, 3, 5], [2, 4, 6]]
    assert result.warnings == []


@every(
    ("last", "size", "told"),
    [
        ("3.25", 2, "line 3: left out: the file ends here"),
        ("3.25\t4.7", 3, "the file ends within line 3: its last number counts as missing"),
    ],
)
def test_the_end_of_a_file_that_was_cut_off_is_mended(last, size, told):
    result = mended("1.25\t2.50", "2.25\t3.50", last, form=INSTRUMENT, is_cut=True)
    assert result.columns[0].size == size
    assert told in result.warnings[0]
    assert np.isnan(result.columns[1][-1]) == (size == 3)


def test_a_last_number_without_a_line_end_is_noted():
    result = mended("1;2;3", "4;5;6", is_cut=True)
    assert result.columns[2].tolist() == [3, 6]
    assert result.notes == ["the last line, 2, has no line end; its last number is taken as complete"]


def test_no_rows_are_empty_columns():
    result = mended(form=INSTRUMENT, is_cut=True)
    assert [column.size for column in result.columns] == [0, 0]
    assert result.warnings == []
