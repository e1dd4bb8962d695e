"""Names, units, skipped lines and columns of text in delimited files."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from delimited_text import recorded, values

ROWS = "".join(f"{row};{row},5;-0,{row}\n" for row in range(1, 10))


def test_lines_for_names_and_units_can_be_given(tmp_path):
    text = "mm;kN;V\nfirst;second;third\nraw;raw;raw\n" + ROWS
    recording = recorded(tmp_path, text, names_row=2, units_row=1)
    assert [(channel.name, channel.unit) for channel in recording.channels] == [
        ("first", "mm"),
        ("second", "kN"),
        ("third", "V"),
    ]


def test_names_that_are_numbers_have_to_be_given(tmp_path):
    recording = recorded(tmp_path, "11;12;13\n" + ROWS, names_row=1)
    assert [channel.name for channel in recording.channels] == ["11", "12", "13"]
    assert len(values(recording, "11")) == 9


def test_a_row_of_text_that_is_no_heading_can_be_declared_so(tmp_path):
    recording = recorded(tmp_path, "a;b;c\n" + ROWS, names_row=0, units_row=0)
    assert [channel.name for channel in recording.channels] == ["column 1", "column 2", "column 3"]


def test_lines_at_the_top_can_be_skipped(tmp_path):
    recording = recorded(tmp_path, "1;2;3\n4;5;6\n" + ROWS, skip_rows=2)
    assert values(recording, 1) == list(range(1, 10))


def test_a_damaged_first_row_is_told(tmp_path):
    recording = recorded(tmp_path, "0;1\n" + ROWS)
    assert recording.warnings[0].startswith("line 1 above the first sample: numbers, but not one for each column")


def test_equal_names_are_told_apart_by_number_only(tmp_path):
    recording = recorded(tmp_path, "ACC;ACC;t\n" + ROWS)
    assert "several columns are called" in recording.warnings[0]
    with pytest.raises(ReadError, match=r'2 columns are called "ACC": columns 1 and 2'):
        recording.channel("ACC")


def test_delimiters_at_line_ends_make_no_column(tmp_path):
    recording = recorded(tmp_path, "a;b;;\n" + "".join(f"{row};{row};;\n" for row in range(5)))
    assert [channel.name for channel in recording.channels] == ["a", "b"]
    assert recording.warnings == ()


def test_a_column_of_text_is_kept_without_numbers_so_that_columns_keep_their_count(tmp_path):
    recording = recorded(tmp_path, "t;state;a\n" + "".join(f"{row};on;{row}\n" for row in range(5)))
    assert np.isnan(recording.channel("state").values).all()
    assert values(recording, 3) == list(range(5))
    assert recording.warnings == ()
    assert any('text, not numbers, in "state"' in note for note in recording.notes)
