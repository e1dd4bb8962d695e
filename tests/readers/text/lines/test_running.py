"""Numbers that run on: free or in fields, touching or not."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.readers.text.lines.running import read_running


@pytest.mark.parametrize(
    ("line", "width"),
    [
        (" 1.5 -0.25  3.0E+01", None),
        ("1.5-0.25+3.0E+01", None),
        ("1.5 -.25 3.0D+01", None),
        (" 1.50-0.25 30.0", 5),
        ("  1.5-0.25   30", 5),
    ],
    ids=["free", "touching", "Fortran exponent", "fields of five", "fields with blanks"],
)
def test_numbers_are_told_apart(line: str, width: int | None) -> None:
    values, warnings = read_running([(1, line)], width=width)
    assert values.tolist() == [1.5, -0.25, 30.0]
    assert warnings == []


@pytest.mark.parametrize("odd", ["####", "1.2.3", "nan", "1e999", "--", "0x1F"])
def test_what_is_no_number_is_missing_and_told(odd: str) -> None:
    values, warnings = read_running([(7, "1.0 2.0"), (8, f"3.0 {odd}"), (9, "")])
    np.testing.assert_array_equal(values, [1, 2, 3, np.nan])
    assert warnings == [f'1 line holds something that is not a number (on line 8: "3.0 {odd}"); missing']
