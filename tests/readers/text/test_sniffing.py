"""How a text is written, and where its first sample is."""

from colonnade.readers.text.cells import Dialect, is_sample
from colonnade.readers.text.sniffing import column_kinds, find_first_sample, sniff
from every import every

GIVEN = Dialect("utf-8", ",", ".")


def sniffed(*lines, delimiter=None, decimal=None):
    return sniff(list(lines), GIVEN, delimiter=delimiter, decimal=decimal, thousands=None)


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
    assert (found.dialect.decimal, found.columns) == (decimal, columns)
    assert columns == 1 or found.dialect.delimiter == delimiter
    assert found.notes


def test_what_is_given_is_not_sniffed():
    found = sniffed("1,5", "2,6", "3,7", delimiter=";", decimal=",")
    assert (found.columns, found.notes, found.warnings) == (1, (), ())


def test_signs_between_thousands_are_found():
    found = sniffed("1;1.234,5", "2;2.345,5")
    assert found.dialect.thousands == "."
    assert 'between thousands (as in "1.234,5")' in found.notes[-1]


def test_text_has_no_columns_of_numbers():
    assert sniffed("one", "two").columns == 0


SEMICOLON = Dialect("utf-8", ";", ".")
LINES = ["Test 7; 3", "Time;x;state", "10:15:00;1;on", "10:15:01;OVL;on", "10:15:02;3;off"]


def test_columns_are_named_by_what_most_of_their_cells_hold():
    assert column_kinds(LINES, SEMICOLON, 3) == ["time", "number", "text"]


def test_the_first_line_with_a_value_for_each_column_is_found():
    kinds = column_kinds(LINES, SEMICOLON, 3)
    assert find_first_sample(LINES, 0, SEMICOLON, kinds) == 2
    assert find_first_sample(LINES[:2], 0, SEMICOLON, kinds) is None
    assert is_sample(LINES[4], SEMICOLON, kinds)
    assert not is_sample("# " + LINES[4], SEMICOLON, kinds)
