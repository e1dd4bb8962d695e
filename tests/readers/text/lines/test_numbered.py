"""Lines one by one, with their numbers, and a bound on their length."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.text.lines.numbered import LONGEST_LINE, NumberedLines, first_lines


def written(tmp_path: Path, content: bytes) -> Path:
    path = tmp_path / "a.txt"
    path.write_bytes(content)
    return path


def test_a_line_can_be_looked_at_before_it_is_taken(tmp_path: Path) -> None:
    with NumberedLines(written(tmp_path, b"\xef\xbb\xbfone\r\ntwo\r\nthree")) as lines:
        assert (lines.peek(), lines.number) == ("one", 0)
        assert list(lines.until(lambda line: line == "three")) == [(1, "one"), (2, "two")]
        assert list(lines.rest()) == [(3, "three")]
        assert lines.take() is None


def test_a_line_longer_than_any_texts_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, b"one\n" + b"x" * LONGEST_LINE)
    with NumberedLines(path) as lines, pytest.raises(ReadError, match=r"a\.txt: line 2 has more than 1048576"):
        list(lines.rest())
    assert first_lines(path, 5) == ["one"]
