"""Lines with their numbers, and numbers that run on."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.text.numbered import LONGEST_LINE, NumberedLines, read_running
from every import every


def written(tmp_path, content):
    path = tmp_path / "a.txt"
    path.write_bytes(content)
    return path


def test_a_line_can_be_looked_at_before_it_is_taken(tmp_path):
    with NumberedLines(written(tmp_path, b"\xef\xbb\xbfone\r\ntwo\r\nthree")) as lines:
        assert (lines.peek(), lines.number) == ("one", 0)
        assert list(lines.until(lambda line: line == "three")) == [(1, "one"), (2, "two")]
        assert list(lines.rest()) == [(3, "three")]
        assert lines.take() is None


def test_a_line_longer_than_any_texts_is_refused(tmp_path):
    path = written(tmp_path, b"one\n" + b"x" * LONGEST_LINE)
    with NumberedLines(path) as lines, pytest.raises(ReadError, match=r"a\.txt: line 2 has more than 1048576"):
        list(lines.rest())


@every(
    ("line", "width"),
    [
        (" 1.5 -0.25  3.0E+01", None),
        ("1.5-0.25+3.0E+01", None),
        ("1.5 -.25 3.0D+01", None),
        (" 1.50-0.25 30.0", 5),
        ("  1.5-0.25   30", 5),
    ],
)
def test_numbers_are_told_apart(line, width):
    values, warnings = read_running([(1, line)], width=width)
    assert values.tolist() == [1.5, -0.25, 30.0]
    assert warnings == []


@every("odd", ["####", "1.2.3", "nan", "1e999", "--", "0x1F"])
def test_what_is_no_number_is_missing_and_told(odd):
    values, warnings = read_running([(7, "1.0 2.0"), (8, f"3.0 {odd}"), (9, "")])
    np.testing.assert_array_equal(values, [1, 2, 3, np.nan])
    assert warnings == [f'1 line holds something that is not a number (on line 8: "3.0 {odd}"); missing']
