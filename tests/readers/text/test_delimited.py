"""Delimited text: every option, every trap, and what a recording says of its warnings."""

from datetime import UTC, datetime

import numpy as np
import pytest

from colonnade.errors import ReadError
from delimited_text import recorded, values
from every import every

ROWS = "".join(f"{row};{row},5;-0,{row}\n" for row in range(1, 10))


@every("text", ["1.234", "1.234,5"])
def test_a_point_among_decimal_commas_is_missing_rather_than_guessed(tmp_path, text):
    recording = recorded(tmp_path, f"n;force\n1;0,5\n2;0,6\n3;{text}\n4;0,7\n5;0,8\n")
    assert np.isnan(values(recording, "force")[2])
    assert recording.warnings == (f'"force": 1 cell holds no number (on line 4: "{text}"); missing',)


def around_a_thousand(sign, time):
    """Rows of whole numbers from 980 to 1030 with a sign between thousands."""
    return "time;force\n" + "".join(f"{time(row)};{f'{980 + row:,}'.replace(',', sign)}\n" for row in range(51))


@every(
    ("sign", "decimal", "time"),
    [(".", ",", "0,{:02d}"), (",", ".", "0.{:02d}"), (".", ",", "{}"), (",", ".", "{}")],
)
def test_signs_that_may_be_marks_between_thousands_have_to_be_told(tmp_path, sign, decimal, time):
    text = around_a_thousand(sign, time.format)
    with pytest.raises(ReadError, match=r"may be the decimal sign or stand between thousands\. Say in `file` which"):
        recorded(tmp_path, text)
    recording = recorded(tmp_path, text, decimal=decimal, thousands=sign)
    assert values(recording, "force") == list(range(980, 1031))
    assert values(recorded(tmp_path, text, decimal=sign), "force")[19:21] == [999.0, 1.0]


@every(("thousands", "text"), [(".", "1.234"), ("'", "1'234"), (" ", "1 234")])
def test_thousands_that_were_declared_are_read(tmp_path, thousands, text):
    recording = recorded(tmp_path, f"n;force\n1;0,5\n2;{text}\n3;0,6\n4;0,7\n", thousands=thousands, decimal=",")
    assert values(recording, "force") == [0.5, 1234.0, 0.6, 0.7]


def test_a_comma_among_decimal_points_is_missing_with_its_line(tmp_path):
    recording = recorded(tmp_path, "a;b\n0.5;1.5\n0.6;1,6\n0.7;1.7\n0.8;1.8\n")
    assert np.isnan(values(recording, "b")[1])
    assert '(on line 3: "1,6")' in recording.warnings[0]


def test_quoted_cells_may_hold_decimal_commas_between_commas(tmp_path):
    text = '"Time [s]","LVDT, top"\n' + "".join(f'"0,{row}","{row},25"\n' for row in range(6))
    recording = recorded(tmp_path, text)
    assert values(recording, "LVDT, top") == [0.25, 1.25, 2.25, 3.25, 4.25, 5.25]


def test_one_column_with_decimal_commas_needs_no_delimiter(tmp_path):
    assert values(recorded(tmp_path, "0,05\n-0,10\n1,25\n"), 1) == [0.05, -0.1, 1.25]


def test_whole_numbers_beside_a_comma_are_two_columns_unless_it_is_the_decimal_sign(tmp_path):
    assert values(recorded(tmp_path, "1,5\n2,6\n3,7\n"), 2) == [5, 6, 7]
    assert values(recorded(tmp_path, "1,5\n2,6\n3,7\n", decimal=","), 1) == [1.5, 2.6, 3.7]


def test_fortran_exponents_and_the_printed_minus_are_numbers(tmp_path):
    blanks = recorded(tmp_path, "a  b\n1.0D-03 \N{MINUS SIGN}2.5\n2.0D-03 3.5\n4.0D+00 4.5\n")
    assert values(blanks, 1) == [0.001, 0.002, 4.0]
    assert values(recorded(tmp_path, "1.0D-03;\N{MINUS SIGN}2.5\n2.0D-03;3.5\n4.0D+00;4.5\n"), 2) == [-2.5, 3.5, 4.5]


@every("text", ["NaN", "OVERFLOW", "-", "--", "#DIV/0!", "1.#INF", "inf", "", " ", "sensor off"])
def test_what_recorders_write_for_no_number_is_missing_and_told(tmp_path, text):
    recording = recorded(tmp_path, f"t;a;b\n0;1;2\n1;{text};2\n2;3;2\n3;{text};2\n")
    assert np.isnan(recording.channel("a").values).tolist() == [False, True, False, True]
    shown = f'"{text}"' if text.strip() else "nothing"
    assert recording.warnings == (f'"a": 2 cells hold no number (first on line 3: {shown}); missing',)


def test_a_number_that_stands_for_missing_can_be_told(tmp_path):
    text = "t;a\n0;1\n1;-999.0\n2;3\n"
    assert np.isnan(values(recorded(tmp_path, text, missing=("-999",)), "a")[1])
    assert values(recorded(tmp_path, text), "a")[1] == -999.0


def test_blank_lines_are_skipped_and_lines_still_counted_as_in_the_file(tmp_path):
    recording = recorded(tmp_path, "\n\nt;a\n0;1\n\n1;2\n   \n2;x\n3;4\n4;5\n5;6\n")
    assert values(recording, "t") == [0, 1, 2, 3, 4, 5]
    assert '(on line 8: "x")' in recording.warnings[0]


def test_a_tail_of_zero_bytes_is_left_out(tmp_path):
    recording = recorded(tmp_path, "t;a\n0;1\n1;2\n2;3\n" + "\0" * 500)
    assert values(recording, "a") == [1, 2, 3]
    assert recording.warnings[0].startswith("line 5")


def test_a_quotation_mark_that_is_never_closed_loses_no_rows_silently(tmp_path):
    recording = recorded(tmp_path, 't;a\n0;1\n1;"2\n2;3\n3;4\n')
    assert values(recording, "a") == [1, 2, 3, 4]
    quoted = recorded(tmp_path, '"n";"a"\n' + '"0";"1"\n' * 5 + '"1;"2\n' + '"2";"3"\n' * 4)
    assert values(quoted, "a")[:5] + values(quoted, "a")[6:] == [1] * 5 + [3] * 4
    assert quoted.warnings[0].startswith("line 7: counted as missing")


@every(
    ("options", "message"),
    [
        ({"delimeter": ";"}, "delimeter: Extra inputs are not permitted"),
        ({"decimal": "point"}, "decimal: Input should be"),
        ({"encoding": "utf-9"}, r"unknown encoding"),
        ({"delimiter": "ab"}, r"one character was expected"),
        ({"delimiter": "1"}, r"one character was expected"),
        ({"time": 1, "time_unit": "mm"}, r"a unit of time was expected"),
        ({"decimal": ",", "thousands": ","}, r"no rows of numbers were found"),
        ({"time": 4}, r"column 4 is missing; it has columns 1 to 3"),
    ],
)
def test_an_option_that_cannot_be_is_told(tmp_path, options, message):
    with pytest.raises(ReadError, match=message):
        recorded(tmp_path, "a;b;c\n" + ROWS, **options)


@every(
    ("above", "options", "heads"),
    [
        ("mm;kN;V\na;b;c\nraw;raw;raw\n", {"names_row": 2, "units_row": 1}, [("a", "mm"), ("b", "kN"), ("c", "V")]),
        ("11;12;13\n", {"names_row": 1}, [("11", None), ("12", None), ("13", None)]),
        ("a;b;c\n", {"names_row": 0, "units_row": 0}, [(f"column {number}", None) for number in (1, 2, 3)]),
        ("1;2;3\n4;5;6\n", {"skip_rows": 2}, [(f"column {number}", None) for number in (1, 2, 3)]),
    ],
)
def test_lines_of_names_and_units_and_those_to_skip_can_be_given(tmp_path, above, options, heads):
    recording = recorded(tmp_path, above + ROWS, **options)
    assert [(channel.name, channel.unit) for channel in recording.channels] == heads
    assert values(recording, 1) == list(range(1, 10))


def test_equal_names_are_told_apart_by_number_only(tmp_path):
    recording = recorded(tmp_path, "ACC;ACC;t\n" + ROWS)
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


def noisy_decay(peak):
    """Whole numbers of a decaying oscillation with noise, at rest for 300 samples."""
    time = 0.002 * np.arange(4000)
    motion = np.where(time < 0.6, 0.0, peak * np.exp(-0.2 * (time - 0.6)) * np.sin(9 * (time - 0.6)))
    return np.rint(motion + np.random.default_rng(3).normal(0, 3, time.size)).astype(int).tolist()


@every("removed", ["0,5000", ";", ";0,5000", "0,5000;"])
def test_a_lost_cell_or_delimiter_never_moves_values_to_another_column(tmp_path, removed):
    rows = [f"{row};0,5000;{row + 100}" for row in range(50)]
    rows[20] = rows[20].replace(removed, "", 1)
    recording = recorded(tmp_path, "n;a;b\n" + "\n".join(rows) + "\n")
    others = np.arange(50) != 20
    for name, expected in (("a", np.full(50, 0.5)), ("b", np.arange(50) + 100.0)):
        found = recording.channel(name).values
        np.testing.assert_array_equal(found[others], expected[others])
        assert np.isnan(found[20]) or found[20] == expected[20]
    assert "line 22" in " ".join(recording.warnings)


@every("written", ["{:.3f}", "{:.6g}"])
def test_decimals_are_not_taken_for_thousands(tmp_path, written):
    numbers = [float(written.format(550 + number / 3000)) for number in noisy_decay(1_000_000)]
    text = "".join(f"{row / 500};{written.format(number)}\n" for row, number in enumerate(numbers))
    assert values(recorded(tmp_path, "time;pressure\n" + text), "pressure") == numbers


def test_commas_before_three_digits_alone_are_decimal_signs(tmp_path):
    rows = "".join(f"0,{5 * row:03d}  {23 + row},866\n" for row in range(9))
    assert values(recorded(tmp_path, "Time  top\n" + rows), "top") == [23.866 + row for row in range(9)]


@every(
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
def test_a_clock_is_known_by_its_name_and_unit(tmp_path, heading, factor):
    recording = recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n")
    np.testing.assert_allclose(recording.channel("a").time, np.array([0.0, 5.0, 10.0]) * factor)


@every("heading", ["T [°C]", "Temperature", "X", "Time constant", "T [V]"])
def test_a_rising_column_of_another_name_or_unit_is_no_clock(tmp_path, heading):
    assert recorded(tmp_path, f"{heading};a\n0;1\n5;2\n10;0\n").channel("a").time is None


def test_the_clock_can_be_given(tmp_path):
    recording = recorded(tmp_path, "X;a\n0;1\n5;2\n10;0\n", time="x", time_unit="ms")
    np.testing.assert_allclose(recording.channel("a").time, [0.0, 0.005, 0.01])
    with pytest.raises(ReadError, match=r'no column is called "Tine".*Did you mean "Time"'):
        recorded(tmp_path, "Time;a\n0;1\n5;2\n10;0\n", time="Tine")


def test_each_column_goes_by_the_clock_on_its_left(tmp_path):
    recording = recorded(tmp_path, "Time 1;a;Time 2;b\n0;1;0;1\n1;2;10;2\n2;3;20;3\n")
    assert recording.channel("a").time.tolist() == [0, 1, 2]
    assert recording.channel("b").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]


def test_a_clock_that_was_given_leaves_the_other_clocks_to_be_chosen(tmp_path):
    text = "Time 1;a;X;Time 2\n0;1;5;0\n1;2;6;10\n2;3;7;20\n"
    recording = recorded(tmp_path, text, time="Time 1")
    assert recording.channel("X").time.tolist() == [0, 1, 2]
    assert recording.on_clock("a", "Time 2").time.tolist() == [0, 10, 20]
    assert recording.on_clock("a", "X").time.tolist() == [5, 6, 7]


MORNING, LATE = datetime(2013, 4, 26, 10, 15, 0, 500000), datetime(2013, 4, 26, 23, 59, 59, 500000)


@every(
    ("stamps", "start"),
    [
        (["2013-04-26T10:15:00.5", "2013-04-26T10:15:01", "2013-04-26T10:15:01.5"], MORNING),
        (["2013/04/26 23:59:59.5", "2013/04/27 00:00:00.0", "2013/04/27 00:00:00.5"], LATE),
        (["26.04.2013 10:15:00,5", "26.04.2013 10:15:01,0", "26.04.2013 10:15:01,5"], MORNING),
        ([f"2013-04-26T12:15:{second}+02:00" for second in ("00.5", "01", "01.5")], MORNING.replace(tzinfo=UTC)),
        (["10:15:59.5", "10:16:00.0", "10:16:00.5"], None),
    ],
)
def test_timestamps_are_seconds_from_the_first(tmp_path, stamps, start):
    recording = recorded(tmp_path, "timestamp;a\n" + "".join(f"{stamp};{row}\n" for row, stamp in enumerate(stamps)))
    np.testing.assert_allclose(recording.channel("a").time, [0, 0.5, 1.0], atol=1e-9)
    assert recording.start == start
