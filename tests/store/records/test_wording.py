from __future__ import annotations

from math import inf, nan

import pytest

from colonnade.store.records import wording


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.41234, "0.412"), (0.0, "0"), (123456.0, "123000"), (2e-6, "2·10⁻⁶"), (nan, "–"), (inf, "–"), (None, "–")],
)
def test_numbers_are_rounded_and_never_nan(value, text):
    assert wording.number(value) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"), [(0.23202, "mm", "232 mm"), (2.0, "mm", "2000 mm"), (nan, "s", "–"), (None, "s", "–")]
)
def test_quantities_carry_their_unit(value, unit, text):
    assert wording.quantity(value, unit) == text


def test_an_acceleration_is_given_in_both_units():
    assert wording.acceleration(9.80665) == "9.81 m/s² (1 g)"
    assert wording.acceleration(nan) == "–"


def test_an_interval_has_as_many_digits_as_its_half_width_allows():
    assert wording.interval(0.97608, 0.97528, 0.97688, 0.95) == "0.9761 ± 0.0008 (95\u00a0% interval)"
    assert wording.interval(0.9, nan, nan, 0.95) == "0.9"
    assert wording.interval(nan, nan, nan, 0.95) == "–"


@pytest.mark.parametrize(
    ("measured", "predicted", "verdict"),
    [
        ("rocking", "rocking", True),
        ("rocking", "overturned", False),
        ("not-overturned", "rocking", True),
        ("not-overturned", "overturned", False),
        ("", "rocking", None),
        ("rocking", "", None),
    ],
)
def test_outcomes_are_compared_only_where_both_are_known(measured, predicted, verdict):
    assert wording.agree(measured, predicted) is verdict


def test_what_is_below_a_thousandth_of_the_critical_angle_is_written_as_that():
    assert [wording.ratio(value) for value in (9.99e-4, 1e-3, 0.0)] == ["< 0.001", "0.001", "0"]
    assert [wording.signed_ratio(value) for value in (-9.99e-4, -0.001, 0.25)] == ["< 0.001", "−0.001", "+0.25"]
    assert wording.signed_ratio(nan) == "–"
