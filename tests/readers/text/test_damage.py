"""What becomes of damaged rows."""

from pathlib import Path

import numpy as np

from colonnade.readers.text.cells import Dialect
from colonnade.readers.text.damage import mend
from colonnade.readers.text.encoding import pieces_of_lines
from colonnade.readers.text.rows import RowForm, read_rows

FORM = RowForm(Dialect("utf-8", ";", "."), ("number", "number", "number"))


def mended(*texts, form=FORM, is_cut=False):
    rows = read_rows(Path("a.csv"), pieces_of_lines(enumerate(texts, 1)), form)
    return mend(rows, ["a", "b", "c"], is_cut=is_cut)


def test_lines_that_are_not_samples_are_left_out_and_listed():
    result = mended("1;2;3", "a;b;c", "4;5;6", "# event", "7;8;9")
    assert [column.tolist() for column in result.columns] == [[1, 4, 7], [2, 5, 8], [3, 6, 9]]
    assert result.warnings == ('line 2: left out: text without a number ("a;b;c")',)
    assert result.notes == ('line 4: left out as a comment ("# event")',)


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
    assert result.warnings == ('"b", "c": 2 cells hold no number (first on line 2: "x"); missing',)


def test_ragged_columns_end_where_their_last_number_is():
    form = RowForm(FORM.dialect, FORM.kinds, by_instrument=True, ragged=True)
    assert mended("1;2;3", "4;;6", "7;8;", form=form).warnings == (
        '"b": 1 cell holds no number (on line 2: nothing); missing',
    )


def test_a_cut_last_line_is_left_out_and_a_whole_one_kept():
    assert mended("1;2;3", "4;5", is_cut=True).columns[0].tolist() == [1]
    whole = mended("1;2;3", "4;5;6", is_cut=True)
    assert whole.columns[2].tolist() == [3, 6]
    assert whole.notes == ("the last line, 2, has no line end; its last number is taken as complete",)
