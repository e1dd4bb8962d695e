"""Rows become columns of numbers; rows unlike the others come with their lines and faults."""

from pathlib import Path

import numpy as np
import pytest

from colonnade.readers.text import encoding as pieces
from colonnade.readers.text.cells import Dialect
from colonnade.readers.text.damage import mend
from colonnade.readers.text.encoding import pieces_of_lines
from colonnade.readers.text.rows import Row, RowForm, fault_of, read_rows
from every import every

FORM = RowForm(Dialect("utf-8", ";", "."), ("number", "number"))


def judged(text, form=FORM):
    cells = form.dialect.split(text)
    return fault_of(Row(0, 1, text, cells), form, has_number=any(map(form.dialect.is_number, cells)))


@every(
    ("text", "fault"),
    [
        ("1;2", None),
        ("1;OVL", None),
        ("OVL;--", None),
        ("1;2;3", "long"),
        ("1;2;", "long"),
        ("1", "short"),
        ("# event", "comment"),
        ("# 1;2", "struck out"),
        ("Time;x", "text"),
    ],
)
def test_a_fault_has_a_name(text, fault):
    assert judged(text) == fault


def test_delimiters_at_each_lines_end_belong_to_the_form():
    form = RowForm(FORM.dialect, FORM.kinds, trailing=1)
    assert (form.cells, form.most_cells) == (3, 3)
    assert judged("1;2;", form) is None
    assert judged("1;2;3", form) == "long"
    assert judged("1;2", form) == "short"


def test_each_row_of_an_instrument_is_a_sample_in_its_place():
    form = RowForm(FORM.dialect, FORM.kinds, remark=True, by_instrument=True)
    assert judged("Time;x", form) is None
    assert judged("1;2;lost;;", form) is None
    assert judged("1;2;lost;4", form) == "long"


INSTRUMENT = RowForm(Dialect("utf-8", "\t", "."), ("number", "number"), by_instrument=True)
REMARKS = RowForm(Dialect("utf-8", "\t", "."), ("number", "number"), remark=True, by_instrument=True)


def found(*texts, form=INSTRUMENT):
    return read_rows(Path("a.txt"), pieces_of_lines(enumerate(texts, 11)), form)


def mended(*texts, form=INSTRUMENT, is_cut=False):
    return mend(found(*texts, form=form), ["a", "b"], is_cut=is_cut)


@pytest.mark.parametrize("rows_at_once", [2, 20_000], ids=["in pieces", "at once"])
def test_columns_and_lines_come_out_whatever_the_size_of_the_pieces(monkeypatch, rows_at_once):
    monkeypatch.setattr(pieces, "ROWS_AT_ONCE", rows_at_once)
    rows = found(*(f"{row}.5\t{-row}" for row in range(5)))
    assert [column.tolist() for column in rows.columns] == [[0.5, 1.5, 2.5, 3.5, 4.5], [0, -1, -2, -3, -4]]
    assert [(row.row, row.line, row.text) for row in rows.tail()[-2:]] == [
        (3, 14, "3.5\t-3"),
        (4, 15, "4.5\t-4"),
    ]


@every(
    ("odd", "told"),
    [
        ("7", 'line 12: counted as missing: fewer than 2 cells ("7")'),
        ("7\t8\t9\t10", 'line 12: counted as missing: more than 2 cells ("7 8 9 10")'),
        ("7\tOVL", '"b": 1 cell holds no number (on line 12: "OVL"); missing'),
        ("1.2.3\t8", '"a": 1 cell holds no number (on line 12: "1.2.3"); missing'),
        ("7\tinf", '"b": 1 cell holds no number (on line 12: "inf"); missing'),
        ("# 7\tabc", '"a", "b": 1 cell holds no number (on line 12: "# 7"); missing'),
    ],
)
def test_a_row_that_is_not_as_the_others_is_told_with_its_line(odd, told):
    result = mended("1\t2", odd, "3\t4")
    assert result.warnings == (told,)
    assert [column[[0, 2]].tolist() for column in result.columns] == [[1, 3], [2, 4]]
    assert np.isnan([column[1] for column in result.columns]).any()


def test_empty_cells_at_the_end_of_an_instruments_row_are_nothing():
    result = mended("1\t2", "3\t4\t\t\t", "5\t6")
    assert [column.tolist() for column in result.columns] == [[1, 3, 5], [2, 4, 6]]
    assert result.warnings == ()


def test_remarks_beyond_the_columns_are_not_looked_at():
    result = mended("1\t2\tOK", "3\t4", "5\t6\tlost", form=REMARKS)
    assert [column.tolist() for column in result.columns] == [[1, 3, 5], [2, 4, 6]]
    assert result.warnings == ()


@every(
    ("last", "size", "told"),
    [
        ("3.25", 2, "line 13: left out: the file ends here"),
        ("3.25\t4.7", 3, 'ends within a number: "4.7" on line 13 has 1 decimals where the one above has 2'),
        ("3.25\t4.75", 3, ""),
    ],
)
def test_the_end_of_a_file_that_was_cut_off_is_mended(last, size, told):
    result = mended("1.25\t2.50", "2.25\t3.50", last, is_cut=True)
    assert result.columns[0].size == size
    assert (told in result.warnings[0]) if told else (result.warnings == ())
    assert np.isnan(result.columns[1][-1]) == ("4.7 " in f"{last} ")


def test_no_rows_are_empty_columns():
    result = mended(is_cut=True)
    assert [column.size for column in result.columns] == [0, 0]
    assert result.warnings == ()


def test_lines_are_counted_on_where_they_were_not_taken_in_a_row():
    rows = read_rows(Path("a.txt"), pieces_of_lines([(5, "1\t2"), (9, "x\t4"), (10, "5\t6")]), INSTRUMENT)
    assert "on line 9" in mend(rows, ["a", "b"]).warnings[0]
