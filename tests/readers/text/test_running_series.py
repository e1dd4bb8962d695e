"""A block of numbers that run on from row to row."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.text.header_claims import HeaderClaims
from colonnade.readers.text.lines.cells import WHITESPACE, Dialect
from colonnade.readers.text.running_series import fixed_fields, read_block

BLANKS = Dialect("utf-8", WHITESPACE, ".")


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "a.txt"
    path.write_text(text)
    return path


def test_a_block_is_one_series_with_rows_of_touching_fields_above_its_first(tmp_path: Path) -> None:
    path = written(tmp_path, "title\n-1.0-2.0-3.0\n 1.0 2.0 3.0\n 4.0 5.0\n")
    assert read_block(path, BLANKS, 2, 4).tolist() == [-1, -2, -3, 1, 2, 3, 4, 5]
    assert read_block(path, BLANKS, 2, None).tolist() == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("text", ["1 2\n3 x\n5 6\n", "1 2\nend\n5 6\n"], ids=["within", "below"])
def test_a_line_that_does_not_continue_the_block_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(ReadError, match=r"a\.txt: line \d, .* does not continue the numbers above it"):
        read_block(written(tmp_path, text), BLANKS, 0, None)


def test_fields_of_the_claimed_width_are_a_table(tmp_path: Path) -> None:
    path = written(tmp_path, "-1.0-2.0\n 1.0 2.0\n")
    columns = fixed_fields(path, BLANKS, 0, HeaderClaims(fields=2, width=4))
    assert columns is not None
    assert [column.tolist() for column in columns] == [[-1, 1], [-2, 2]]
    assert fixed_fields(path, BLANKS, 0, HeaderClaims(fields=3, width=4)) is None
