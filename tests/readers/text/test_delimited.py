"""Delimited text: every option, every trap, and what a recording says of its warnings."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.recording import Recording, Window
from colonnade.readers.registry import read
from colonnade.readers.text import delimited
from colonnade.readers.text.delimited_header import DelimitedOptions


def recorded(tmp_path: Path, text: str, **options: Any) -> Recording:
    path = tmp_path / "record.csv"
    path.write_bytes(text.encode())
    return read(path, "delimited", options)


def values(recording: Recording, column: str | int) -> list[float]:
    return recording.channel(column).values.tolist()


ROWS = "".join(f"{row};{row},5;-0,{row}\n" for row in range(1, 10))


# --- numbers -------------------------------------------------------------------------------------------------------


def test_one_number_with_thousands_does_not_turn_its_column_into_text(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "n;force\n" + "".join(f"{row};{row},5\n" for row in range(300)) + "300;1.234,5\n")
    assert values(recording, "force")[-2:] == [299.5, 1234.5]
    assert recording.warnings == ()


def test_a_point_among_decimal_commas_is_missing_rather_than_guessed(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "n;force\n1;0,5\n2;0,6\n3;1.234\n4;0,7\n5;0,8\n")
    assert np.isnan(values(recording, "force")[2])
    assert recording.warnings == ('"force": 1 cell holds no number (on line 4: "1.234"); missing',)


@pytest.mark.parametrize(("thousands", "text"), [(".", "1.234"), ("'", "1'234"), (" ", "1 234")])
def test_thousands_that_were_declared_are_read(tmp_path: Path, thousands: str, text: str) -> None:
    recording = recorded(tmp_path, f"n;force\n1;0,5\n2;{text}\n3;0,6\n4;0,7\n", thousands=thousands, decimal=",")
    assert values(recording, "force") == [0.5, 1234.0, 0.6, 0.7]


def test_a_comma_among_decimal_points_is_missing_with_its_line(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "a;b\n0.5;1.5\n0.6;1,6\n0.7;1.7\n0.8;1.8\n")
    assert np.isnan(values(recording, "b")[1])
    assert '(on line 3: "1,6")' in recording.warnings[0]


def test_quoted_cells_may_hold_decimal_commas_between_commas(tmp_path: Path) -> None:
    text = '"Time [s]","LVDT, top"\n' + "".join(f'"0,{row}","{row},25"\n' for row in range(6))
    recording = recorded(tmp_path, text)
    assert values(recording, "LVDT, top") == [0.25, 1.25, 2.25, 3.25, 4.25, 5.25]


def test_one_column_with_decimal_commas_needs_no_delimiter(tmp_path: Path) -> None:
    assert values(recorded(tmp_path, "0,05\n-0,10\n1,25\n"), 1) == [0.05, -0.1, 1.25]


def test_whole_numbers_beside_a_comma_are_two_columns_with_a_warning(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "1,5\n2,6\n3,7\n")
    assert values(recording, 2) == [5, 6, 7]
    assert 'then set decimal = ","' in recording.warnings[0]
    assert values(recorded(tmp_path, "1,5\n2,6\n3,7\n", decimal=","), 1) == [1.5, 2.6, 3.7]


def test_fortran_exponents_and_the_printed_minus_are_numbers(tmp_path: Path) -> None:
    assert values(recorded(tmp_path, "1.0D-03 \N{MINUS SIGN}2.5\n2.0D-03 3.5\n4.0D+00 4.5\n"), 1) == [0.001, 0.002, 4.0]
    assert values(recorded(tmp_path, "1.0D-03;\N{MINUS SIGN}2.5\n2.0D-03;3.5\n4.0D+00;4.5\n"), 2) == [-2.5, 3.5, 4.5]


@pytest.mark.parametrize("text", ["NaN", "OVERFLOW", "-", "--", "#DIV/0!", "1.#INF", "inf", "", " ", "sensor off"])
def test_what_recorders_write_for_no_number_is_missing_and_told(tmp_path: Path, text: str) -> None:
    recording = recorded(tmp_path, f"t;a;b\n0;1;2\n1;{text};2\n2;3;2\n3;{text};2\n")
    assert np.isnan(recording.channel("a").values).tolist() == [False, True, False, True]
    shown = f'"{text}"' if text.strip() else "nothing"
    assert recording.warnings == (f'"a": 2 cells hold no number (first on line 3: {shown}); missing',)


def test_a_number_that_stands_for_missing_can_be_told(tmp_path: Path) -> None:
    text = "t;a\n0;1\n1;-999.0\n2;3\n"
    assert np.isnan(values(recorded(tmp_path, text, missing=("-999",)), "a")[1])
    assert values(recorded(tmp_path, text), "a")[1] == -999.0


# --- rows ----------------------------------------------------------------------------------------------------------


def test_a_row_with_too_many_cells_is_missing_and_keeps_its_place(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;a;b\n0;1;2\n1;1;2\n2;9;9;9;9;9\n3;1;2\n")
    assert np.isnan(values(recording, "b")).tolist() == [False, False, True, False]
    assert recording.warnings == ('line 4: counted as missing: more than 3 cells ("2;9;9;9;9;9")',)


def test_a_last_line_that_was_cut_is_left_out(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;a;b\n0;1;2\n1;1;2\n2;1;2\n3;1")
    assert values(recording, "t") == [0, 1, 2]
    assert recording.warnings[0].startswith("line 5: left out: the file ends here, before all 3 cells")


def test_a_last_number_with_lost_decimals_is_missing(tmp_path: Path) -> None:
    rows = "".join(f"{row};{row / 1000:.4f}\n" for row in range(300))
    recording = recorded(tmp_path, "t;a\n" + rows + "300;0.1")
    assert np.isnan(values(recording, "a")[-1])
    assert "ends within a number" in recording.warnings[0]
    whole = recorded(tmp_path, "t;a\n" + rows + "300;0.1234")
    assert values(whole, "a")[-1] == 0.1234
    assert whole.warnings == ()


def test_columns_that_end_earlier_keep_their_values(tmp_path: Path) -> None:
    text = "Time 1;a;Time 2;b\n" + "".join(f"{row};{row};{2 * row};7\n" for row in range(20))
    recording = recorded(tmp_path, text + "".join(f"{row};{row}\n" for row in range(20, 30)))
    assert values(recording, "a") == list(range(30))
    assert np.isfinite(recording.channel("b").values).sum() == 20
    assert any("the last columns are shorter" in note for note in recording.notes)


def test_comments_and_repeated_headings_among_samples_are_left_out(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;a\n0;1\n1;2\n# event 1\n2;3\nt;a\n3;4\n4;5\n")
    assert values(recording, "a") == [1, 2, 3, 4, 5]
    assert recording.warnings == ('line 6: left out: text without a number ("t;a")',)
    assert any("line 4: left out as a comment" in note for note in recording.notes)


def test_a_sample_behind_a_comment_sign_is_missing_and_keeps_its_place(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;a\n0;1\n1;2\n#2;3\n3;4\n4;5\n")
    assert np.isnan(values(recording, "a")).tolist() == [False, False, True, False, False]
    assert recording.warnings == ('line 4: counted as missing: a comment sign in front ("#2;3")',)


def test_blank_lines_are_skipped_and_lines_still_counted_as_in_the_file(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "\n\nt;a\n0;1\n\n1;2\n   \n2;x\n3;4\n4;5\n5;6\n")
    assert values(recording, "t") == [0, 1, 2, 3, 4, 5]
    assert '(on line 8: "x")' in recording.warnings[0]


def test_a_tail_of_zero_bytes_is_left_out(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;a\n0;1\n1;2\n2;3\n" + "\0" * 500)
    assert values(recording, "a") == [1, 2, 3]
    assert recording.warnings[0].startswith("line 5")


def test_a_quotation_mark_that_is_never_closed_loses_no_rows_silently(tmp_path: Path) -> None:
    recording = recorded(tmp_path, 't;a\n0;1\n1;"2\n2;3\n3;4\n')
    assert values(recording, "a") == [1, 2, 3, 4]
    quoted = recorded(tmp_path, '"n";"a"\n' + '"0";"1"\n' * 5 + '"1;"2\n' + '"2";"3"\n' * 4)
    assert values(quoted, "a")[:5] + values(quoted, "a")[6:] == [1] * 5 + [3] * 4
    assert quoted.warnings[0].startswith("line 7: counted as missing")


# --- heading -------------------------------------------------------------------------------------------------------


def test_lines_for_names_and_units_can_be_given(tmp_path: Path) -> None:
    text = "mm;kN;V\nfirst;second;third\nraw;raw;raw\n" + ROWS
    recording = recorded(tmp_path, text, names_row=2, units_row=1)
    assert [(channel.name, channel.unit) for channel in recording.channels] == [
        ("first", "mm"),
        ("second", "kN"),
        ("third", "V"),
    ]


def test_names_that_are_numbers_have_to_be_given(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "11;12;13\n" + ROWS, names_row=1)
    assert [channel.name for channel in recording.channels] == ["11", "12", "13"]
    assert len(values(recording, "11")) == 9


def test_a_row_of_text_that_is_no_heading_can_be_declared_so(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "a;b;c\n" + ROWS, names_row=0, units_row=0)
    assert [channel.name for channel in recording.channels] == ["column 1", "column 2", "column 3"]


def test_lines_at_the_top_can_be_skipped(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "1;2;3\n4;5;6\n" + ROWS, skip_rows=2)
    assert values(recording, 1) == list(range(1, 10))


def test_a_damaged_first_row_is_told(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "0;1\n" + ROWS)
    assert recording.warnings[0].startswith("line 1 above the first sample: numbers, but not one for each column")


def test_equal_names_are_told_apart_by_number_only(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "ACC;ACC;t\n" + ROWS)
    assert "several columns are called" in recording.warnings[0]
    with pytest.raises(ReadError, match=r'2 columns are called "ACC": columns 1 and 2'):
        recording.channel("ACC")


def test_delimiters_at_line_ends_make_no_column(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "a;b;;\n" + "".join(f"{row};{row};;\n" for row in range(5)))
    assert [channel.name for channel in recording.channels] == ["a", "b"]
    assert recording.warnings == ()


def test_a_column_of_text_is_kept_without_numbers_so_that_columns_keep_their_count(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "t;state;a\n" + "".join(f"{row};on;{row}\n" for row in range(5)))
    assert np.isnan(recording.channel("state").values).all()
    assert values(recording, 3) == list(range(5))
    assert recording.warnings == ()
    assert any('text, not numbers, in "state"' in note for note in recording.notes)


# --- clock ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("heading", "factor"),
    [
        ("Time [s]", 1.0),
        ("t", 1.0),
        ("Zeit (ms)", 1e-3),
        ("timestamp", 1.0),
        ("Elapsed time / min", 60.0),
        ("Χρόνος", 1.0),
    ],
)
def test_a_clock_is_known_by_its_name_and_unit(tmp_path: Path, heading: str, factor: float) -> None:
    recording = recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n")
    np.testing.assert_allclose(recording.channel("a").time, np.array([0.0, 5.0, 10.0]) * factor)


@pytest.mark.parametrize("heading", ["T [°C]", "Temperature", "X", "Time constant", "T [V]"])
def test_a_rising_column_of_another_name_or_unit_is_no_clock(tmp_path: Path, heading: str) -> None:
    assert recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n").channel("a").time is None


def test_a_clock_that_does_not_rise_is_refused_with_a_warning(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "Time;a\n5;1\n1;2\n4;0\n2;1\n")
    assert recording.channel("a").time is None
    assert "only 33% of its steps go forward" in recording.warnings[0]


def test_the_clock_can_be_given(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "X;a\n0;1\n5;2\n10;0\n", time="x", time_unit="ms")
    np.testing.assert_allclose(recording.channel("a").time, [0.0, 0.005, 0.01])
    with pytest.raises(ReadError, match=r'no column is called "Tine".*Did you mean "Time"'):
        recorded(tmp_path, "Time;a\n0;1\n5;2\n10;0\n", time="Tine")


def test_each_column_goes_by_the_clock_on_its_left(tmp_path: Path) -> None:
    recording = recorded(tmp_path, "Time 1;a;Time 2;b\n0;1;0;1\n1;2;10;2\n2;3;20;3\n")
    assert recording.channel("a").time is not None
    assert recording.channel("a").time.tolist() == [0, 1, 2]
    assert recording.channel("b").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]


def test_a_clock_that_was_given_leaves_the_other_clocks_to_be_chosen(tmp_path: Path) -> None:
    text = "Time 1;a;X;Time 2\n0;1;5;0\n1;2;6;10\n2;3;7;20\n"
    recording = recorded(tmp_path, text, time="Time 1")
    assert recording.channel("X").time.tolist() == [0, 1, 2]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "X").time.tolist() == [5, 6, 7]


@pytest.mark.parametrize(
    ("stamps", "start"),
    [
        (
            ["2013-04-26T10:15:00.5", "2013-04-26T10:15:01", "2013-04-26T10:15:01.5"],
            datetime(2013, 4, 26, 10, 15, 0, 500000),
        ),
        (
            ["2013/04/26 23:59:59.5", "2013/04/27 00:00:00.0", "2013/04/27 00:00:00.5"],
            datetime(2013, 4, 26, 23, 59, 59, 500000),
        ),
        (
            ["26.04.2013 10:15:00,5", "26.04.2013 10:15:01,0", "26.04.2013 10:15:01,5"],
            datetime(2013, 4, 26, 10, 15, 0, 500000),
        ),
        (
            ["2013-04-26T10:15:00.5+03:00", "2013-04-26T10:15:01+03:00", "2013-04-26T10:15:01.5+03:00"],
            datetime(2013, 4, 26, 7, 15, 0, 500000, UTC),
        ),
        (["23:59:59.5", "00:00:00.0", "00:00:00.5"], None),
    ],
    ids=["ISO", "slashes", "dotted with comma", "zone", "time of day past midnight"],
)
def test_timestamps_are_seconds_from_the_first(tmp_path: Path, stamps: list[str], start: datetime | None) -> None:
    recording = recorded(tmp_path, "timestamp;a\n" + "".join(f"{stamp};{row}\n" for row, stamp in enumerate(stamps)))
    assert recording.channel("a").time is not None
    np.testing.assert_allclose(recording.channel("a").time, [0, 0.5, 1.0], atol=1e-9)
    assert recording.start == start


# --- refusals ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message"),
    [
        pytest.param("", "the file is empty", id="nothing in it"),
        pytest.param("\n\n  \n", "the file is empty", id="blank lines only"),
        pytest.param("a;b\nc;d\n", "no rows of numbers were found in the first 2 lines", id="no number"),
        pytest.param("\x01\x02\x03\x04" * 90, "not printable", id="binary"),
    ],
)
def test_a_file_without_samples_is_refused(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ReadError, match=message):
        recorded(tmp_path, text)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"delimeter": ";"}, r'no option "delimeter". Did you mean "delimiter"'),
        ({"decimal": "point"}, 'option "decimal" .* is "point"'),
        ({"encoding": "utf-9"}, r"unknown encoding"),
        ({"delimiter": "ab"}, r"one character was expected"),
        ({"time": 1, "time_unit": "mm"}, r"a unit of time was expected"),
        ({"decimal": ",", "thousands": ","}, r"decimal and thousands are both"),
        ({"time": 4}, r"column 4 is missing; it has columns 1 to 3"),
    ],
)
def test_an_option_that_cannot_be_is_told(tmp_path: Path, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ReadError, match=message):
        recorded(tmp_path, "a;b;c\n" + ROWS, **options)


@pytest.fixture
def long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file of several pieces, with a damaged line and a last one that is cut off."""
    monkeypatch.setattr("colonnade.readers.text.lines.pieces.PIECE", 20_000)
    path = tmp_path / "long.csv"
    rows = [f"{number / 200:.3f},{number % 97}.5,{-number}" for number in range(9000)]
    rows[4100] += ",7"
    rows[-1] = rows[-1][:-1]
    path.write_text("Time [s],LVDT 1 [mm],count\n" + "\n".join(rows))
    return path


@pytest.mark.parametrize("window", [(20.0, 20.7), (0.0, 1.0), (44.5, 90.0), (-5.0, 900.0)])
def test_a_window_of_a_long_file_is_what_the_whole_file_holds_there(long: Path, window: tuple[float, float]) -> None:
    whole = read(long)
    part = delimited.read(long, DelimitedOptions(), Window(*window))
    for every, some in zip(whole.channels, part.channels, strict=True):
        assert every.time is not None
        assert some.time is not None
        inside, there = ((time >= window[0]) & (time <= window[1]) for time in (every.time, some.time))
        np.testing.assert_array_equal(some.time[there], every.time[inside])
        np.testing.assert_array_equal(some.values[there], every.values[inside])


def test_lines_keep_their_numbers_in_a_window(long: Path) -> None:
    part = delimited.read(long, DelimitedOptions(), Window(20.0, 20.7))
    assert [warning for warning in part.warnings if "line 4102" in warning]
    assert not [warning for warning in part.warnings if "the file ends" in warning]
    assert part.channels[0].values.size < 3000


def test_a_window_of_a_file_without_a_clock_is_counted_in_samples(long: Path) -> None:
    text = long.read_text()
    long.write_text("\n".join(line.partition(",")[2] for line in text.splitlines()))
    part = delimited.read(long, DelimitedOptions(), Window(0.0, 2.0, sampling_rate_hz=200.0))
    assert 400 <= part.channels[0].values.size < 3000
    assert part.channels[1].values[400] == -400


def test_a_window_that_the_file_does_not_reach_is_told(long: Path) -> None:
    with pytest.raises(ReadError, match="none of its 9000 samples is within the test's window"):
        delimited.read(long, DelimitedOptions(), Window(50.0, 60.0))
