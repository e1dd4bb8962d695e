"""Stretches of samples, missing ones on straight lines, and work in threads."""

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.signals.samples import filled_in, side_by_side, stretches


@given(st.lists(st.booleans(), max_size=40))
def test_stretches_hold_all_chosen_samples_and_no_others(chosen):
    mask = np.array(chosen, dtype=bool)
    starts, stops = stretches(mask)
    found = np.zeros(mask.size, dtype=bool)
    for start, stop in zip(starts, stops, strict=True):
        assert start < stop
        found[start:stop] = True
    np.testing.assert_array_equal(found, mask)
    assert (starts[1:] > stops[:-1]).all()  # neighbours are never apart


def test_missing_values_lie_on_the_line_between_their_neighbours():
    values = np.array([np.nan, 1.0, np.nan, np.nan, 4.0, np.nan])
    np.testing.assert_allclose(filled_in(values), [1.0, 1.0, 2.0, 3.0, 4.0, 4.0])


def test_results_come_in_the_order_of_the_items_whoever_is_ready_first_and_an_error_of_one_is_raised():
    def slower_first(number):
        time.sleep(0.002 * (8 - number))
        return number

    assert side_by_side(slower_first, range(8)) == list(range(8))
    with pytest.raises(ZeroDivisionError):
        side_by_side(lambda number: 1 / number, [1, 0, 2])
