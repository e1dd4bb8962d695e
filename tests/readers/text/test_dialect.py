"""How a text is written: cells are cut and read in one way only, and the first sample is found."""

import math

from colonnade.readers.text.dialect import (
    WHITESPACE,
    Dialect,
    find_first_sample,
    is_sample,
    kind_of,
    looks_like_numbers,
    sniff,
)
from every import every

POINT, COMMA = Dialect(";", "."), Dialect(";", ",")


@every(
    ("text", "dialect", "value"),
    [
        ("1.5", POINT, 1.5),
        ("-.5e3", POINT, -500.0),
        ("1,234.5", Dialect(";", ".", ","), 1234.5),
        ("1\N{NO-BREAK SPACE}234", Dialect(";", ".", " "), 1234.0),
        ("1.5D-2", POINT, 0.015),
        ("\N{MINUS SIGN}2", POINT, -2.0),
    ],
)
def test_a_number_is_read(text, dialect, value):
    assert dialect.number(text) == value
    assert kind_of(text, dialect) == "number"


@every(("text", "dialect"), [("1.234", COMMA), ("1.234,5", COMMA), ("1,5", POINT), ("1_000", POINT), ("0x1F", POINT)])
def test_what_is_not_a_number_or_could_be_read_in_two_ways_is_missing(text, dialect):
    assert math.isnan(dialect.number(text))


@every(("text", "kind"), [("OVL", "missing"), ("10:15:00.5", "time"), ("26.04.2013 10:15", "time"), ("on", "text")])
def test_a_cell_is_named_by_what_it_holds(text, kind):
    assert kind_of(text, POINT) == kind


def test_lines_are_cut_as_they_are_written():
    assert Dialect(WHITESPACE, ".").split(" 1  2\t3 ") == ["1", "2", "3"]
    assert Dialect(",", ",", quoted=True).split('"1,5", "a ""b"""') == ["1,5", 'a "b"']
    assert POINT.split("1; 2;") == ["1", "2", ""]


def test_a_damaged_line_of_numbers_still_looks_like_one():
    assert looks_like_numbers("1.5;;2.5E-3;")
    assert not looks_like_numbers("1.5;on")


GIVEN = Dialect(",", ".")


def sniffed(*lines, delimiter=None, decimal=None):
    return sniff(list(lines), GIVEN, delimiter=delimiter, decimal=decimal)


@every(
    ("lines", "delimiter", "decimal", "columns"),
    [
        (["1,5;2,5", "3,5;4,5"], ";", ",", 2),
        (["1.5,2.5", "3.5,4.5"], ",", ".", 2),
        (["1.5\t2.5\t0.5", "3.5\t4.5\t0.5"], "\t", ".", 3),
        (["1.5  2.5", " 3.5 -4.5"], " ", ".", 2),
        (["0,05", "-0,10"], ";", ",", 1),
        (['"1,5","2,5"', '"3,5","4,5"'], ",", ",", 2),
    ],
)
def test_delimiter_and_decimal_sign_are_found(lines, delimiter, decimal, columns):
    found = sniffed(*lines)
    assert (found.dialect.decimal, len(found.kinds)) == (decimal, columns)
    assert columns == 1 or found.dialect.delimiter == delimiter
    assert found.notes


def test_what_is_given_is_not_sniffed():
    found = sniffed("1,5", "2,6", "3,7", delimiter=";", decimal=",")
    assert (found.kinds, found.notes) == (("number",), ())


def test_text_has_no_columns_of_numbers():
    assert sniffed("one", "two").kinds == ()


LINES = ["Test 7; 3", "Time;x;state", "10:15:00;1;on", "10:15:01;OVL;on", "10:15:02;3;off"]


def test_columns_are_named_by_what_most_of_their_cells_hold():
    assert sniffed(*LINES).kinds == ("time", "number", "text")


def test_the_first_line_with_a_value_for_each_column_is_found():
    kinds = sniffed(*LINES).kinds
    assert find_first_sample(LINES, 0, POINT, kinds) == 2
    assert find_first_sample(LINES[:2], 0, POINT, kinds) is None
    assert is_sample(LINES[4], POINT, kinds)
    assert not is_sample("# " + LINES[4], POINT, kinds)
