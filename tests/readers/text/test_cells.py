"""Cells of a line: cut at the delimiter, and read in one way only."""

import math

from colonnade.readers.text.cells import WHITESPACE, Dialect, decimals_of, kind_of, looks_like_numbers
from every import every

POINT, COMMA = Dialect("utf-8", ";", "."), Dialect("utf-8", ";", ",")


@every(
    ("text", "dialect", "value"),
    [
        ("1.5", POINT, 1.5),
        ("-.5e3", POINT, -500.0),
        ("1,234.5", POINT, 1234.5),
        ("1.234,5", COMMA, 1234.5),
        ("1.5D-2", POINT, 0.015),
        ("\N{MINUS SIGN}2", POINT, -2.0),
    ],
)
def test_a_number_is_read(text, dialect, value):
    assert dialect.number(text) == value
    assert kind_of(text, dialect) == "number"


@every(("text", "dialect"), [("1.234", COMMA), ("1,5", POINT), ("1_000", POINT), ("0x1F", POINT)])
def test_what_is_not_a_number_or_could_be_read_in_two_ways_is_missing(text, dialect):
    assert math.isnan(dialect.number(text))


@every(("text", "kind"), [("OVL", "missing"), ("10:15:00.5", "time"), ("26.04.2013 10:15", "time"), ("on", "text")])
def test_a_cell_is_named_by_what_it_holds(text, kind):
    assert kind_of(text, POINT) == kind


def test_lines_are_cut_as_they_are_written():
    assert Dialect("utf-8", WHITESPACE, ".").split(" 1  2\t3 ") == ["1", "2", "3"]
    assert Dialect("utf-8", ",", ",", quoted=True).split('"1,5", "a ""b"""') == ["1,5", 'a "b"']
    assert POINT.split("1; 2;") == ["1", "2", ""]


def test_a_damaged_line_of_numbers_still_looks_like_one():
    assert looks_like_numbers("1.5;;2.5E-3;")
    assert not looks_like_numbers("1.5;on")
    assert decimals_of("1.250", ".") == 3


def test_only_texts_given_for_a_file_are_its_own():
    assert POINT.own_missing == frozenset()
    assert Dialect("utf-8", ";", ".", missing=POINT.missing | {"-999"}).own_missing == {"-999"}
