"""Factors that a wrong unit or gain leaves, and their causes."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.plausibility.factors import UNKNOWN, as_expected, cause
from every import every


@pytest.mark.parametrize("scale", [1.0, -1.0, 1.4, 1 / 1.4, -0.7])
def test_a_scale_near_one_of_either_sign_is_as_expected(scale):
    assert as_expected(scale)


@pytest.mark.parametrize("scale", [1.6, 0.6, 10.0, 0.0, np.nan, np.inf])
def test_any_other_is_not(scale):
    assert not as_expected(scale)


@every(
    ("scale", "quantity", "said"),
    [
        (9.81, "acceleration", "g read as"),
        (1 / 9.81, "acceleration", "g read as"),
        (-25.4, "displacement", "inches read as mm"),
        (2.5, "displacement", "inches read as cm"),
        (57.3, "angle", "degrees read as radians"),
        (1000.0, "displacement", "mm read as m"),
        (0.01, "acceleration", "by a factor of 100"),
        (10.3, "angle", "by a factor of 10"),
    ],
)
def test_a_known_factor_and_its_inverse_have_a_cause(scale, quantity, said):
    assert said in cause(scale, quantity)


def test_an_odd_factor_has_none():
    assert cause(3.3, "displacement") == UNKNOWN
