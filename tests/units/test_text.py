"""Numbers and results for people: as many digits as the half-width allows, and nothing is markup."""

import re
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade import units
from colonnade.units import text
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
        (0.97608, nan, "", "0.9761"),
    ],
)
def test_half_width_sets_the_digits(value, half_width, unit, written):
    assert text.format_uncertain(value, half_width, unit) == written


@given(st.floats(-1e3, 1e3), st.floats(1e-6, 1e2))
def test_what_is_written_is_right_to_a_digit_of_the_half_width(value, half_width):
    shown, width = (float(part.replace("−", "-")) for part in text.format_uncertain(value, half_width).split(" ± "))
    assert abs(shown - value) <= 0.51 * half_width
    assert width == pytest.approx(half_width, rel=0.26)


def test_percentages_are_written_in_one_form_that_no_line_breaks():
    package = Path(units.__file__).parents[1]
    sources, templates = ([path.read_text("utf-8") for path in package.rglob(f"*.{kind}")] for kind in ("py", "jinja"))
    assert not [found for code in sources for found in re.findall(r".*(?::[-+.,\w]*%\}|\} %[\w ]).*", code)]
    assert not [found for page in templates for found in re.findall(r".*\d %(?!\}).*", page)]


@every(
    ("found", "said"),
    [
        (text.number(0.0), "0"),
        (text.number(123456.0), "123000"),
        (text.number(2e-6), "2·10⁻⁶"),
        (text.number(inf), "–"),
        (text.quantity(2.0, "mm"), "2000 mm"),
        (text.quantity(nan, "s"), "–"),
        (text.acceleration(9.80665), "9.81 m/s² (1 g)"),
        (text.acceleration(nan), "–"),
        (text.interval(0.9760003, 0.9759995, 0.9760011, 0.95), "0.9760 ± 0.0001"),  # never finer
        (text.interval(nan, nan, nan, 0.95), "–"),
        (text.ratio(9.99e-4), "< 0.001"),
        (text.ratio(1e-3), "0.001"),
    ],
)
def test_values_at_the_ends_of_what_is_written(found, said):
    assert found == said


class Told(text.Digested):
    _ESSENCE = "outcome, share, angle rad, mass kg"
    outcome, share, angle, mass = "rocking", None, np.array([0.1, np.nan, 0.25]), 2.5


def test_a_line_names_the_kind_and_the_values_with_their_units():
    assert repr(Told()) == "<Told: outcome rocking, share –, angle 0.1 to 0.25 rad, mass 2.5 kg>"
