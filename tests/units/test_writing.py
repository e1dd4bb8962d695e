"""Numbers for people: as many digits as the half-width allows."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade import units
from every import every


@every(
    ("value", "half_width", "unit", "written"),
    [
        (0.97608, 0.0008, "", "0.9761 ± 0.0008"),
        (0.97608, 0.0012, "", "0.9761 ± 0.0012"),
        (0.97608, 0.00096, "", "0.9761 ± 0.0010"),
        (0.5, 0.0995, "", "0.50 ± 0.10"),
        (1234.0, 50.0, "", "1230 ± 50"),
        (0.23204, 0.0012, "mm", "232.0 ± 1.2 mm"),
        (0.9760003, 0.0000008, "", "0.9760003 ± 0.0000008"),
        (0.97608, 0.0, "", "0.9761"),
        (0.97608, math.nan, "", "0.9761"),
    ],
)
def test_half_width_sets_the_digits(value, half_width, unit, written):
    assert units.format_uncertain(value, half_width, unit) == written


@given(st.floats(-1e3, 1e3), st.floats(1e-6, 1e2))
def test_what_is_written_is_right_to_a_digit_of_the_half_width(value, half_width):
    shown, width = (float(part.replace("−", "-")) for part in units.format_uncertain(value, half_width).split(" ± "))
    assert abs(shown - value) <= 0.51 * half_width
    assert width == pytest.approx(half_width, rel=0.26)


def test_quantity_is_written_in_its_unit():
    assert units.format_quantity(0.086, "mm") == "86 mm"
    assert units.format_quantity(9.80665, "g", digits=4) == "1 g"


def test_percentages_are_written_in_one_form_that_no_line_breaks():
    package = Path(units.__file__).parents[1]
    sources, templates = ([path.read_text("utf-8") for path in package.rglob(f"*.{kind}")] for kind in ("py", "jinja"))
    assert not [found for text in sources for found in re.findall(r".*(?::[-+.,\w]*%\}|\} %[\w ]).*", text)]
    assert not [found for text in templates for found in re.findall(r".*\d %(?!\}).*", text)]
