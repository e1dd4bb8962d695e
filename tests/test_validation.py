"""What the checks of arguments accept and return; that every public call uses them is held by test_arguments."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.validation import number, samples


@given(st.floats(allow_nan=False), st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_a_number_is_taken_in_its_closed_or_open_range(value, one, other):
    low, high = sorted((one, other))
    for bounds, is_inside in (
        ({"low": low, "high": high}, low <= value <= high),
        ({"above": low, "below": high}, (low == -math.inf or value > low) and (high == math.inf or value < high)),
    ):
        if is_inside:
            assert number("x", value, "a number", finite=False, **bounds) == value
        else:
            with pytest.raises(ValueError, match=r"^x is "):
                number("x", value, "a number", finite=False, **bounds)


@pytest.mark.parametrize("value", [2, 2.0, np.float32(2), np.int8(2), np.array(2), True + np.uint8(1)])
def test_every_kind_of_number_is_one(value):
    found = number("x", value, "a number")
    assert (found, type(found)) == (2.0, float)


def test_an_array_comes_back_contiguous_and_in_double_precision():
    given_array = np.asfortranarray(np.arange(6, dtype=np.int16).reshape(2, 3))
    found = samples("x", given_array, dimensions=(1, 2))
    assert found.flags.c_contiguous
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, given_array)


@pytest.mark.parametrize(
    ("values", "options", "message"),
    [
        ([[1.0]], {}, r"shape \(1, 1\); a 1-dimensional array with at least one number"),
        ([1.0], {"fewest": 2, "each": "sample"}, "with at least 2 samples"),
        ([1.0, math.nan], {}, "not finite at number 1; fill or cut the gap first"),
        (np.ma.masked_array([1.0, 2.0], [0, 1]), {}, "a plain array was expected: fill or cut the gap first"),
        (["a", "b"], {}, "x holds values of type str"),
        ([[1.0], [1.0, 2.0]], {}, "is not an array of numbers"),
        ("text", {}, "x is the text 'text'; an array of real numbers"),
    ],
)
def test_what_is_no_such_array_is_told(values, options, message):
    with pytest.raises(ValueError, match=message):
        samples("x", values, **options)
