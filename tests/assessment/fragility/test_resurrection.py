"""Histories that overturn at a level and survive at a higher one."""

import pytest

from colonnade.assessment.fragility.outcomes import gather
from colonnade.assessment.fragility.resurrection import resurrection


def test_a_pair_that_survives_more_than_overturned_it_is_counted_once_and_its_histories_each():
    peak = [[[0.5, 0.5], [2, 0.5], [0.5, 0.5], [0.5, 2]], [[0.5, 0.5], [2, 2], [2, 2], [2, 2]]]
    found = resurrection(gather(["one", "two"], [[1, 2, 3, 4.0]] * 2, peak))
    assert (found.pairs, found.records, found.lost) == (pytest.approx(1 / 4), ("one",), pytest.approx(2 / 16))


def test_levels_are_compared_by_intensity_and_not_by_their_order():
    assert resurrection(gather(["a", "b"], [[2.0, 1.0]] * 2, [[2.0, 0.5]] * 2)).pairs == 0.0
    assert resurrection(gather(["a", "b"], [[1.0, 2.0]] * 2, [[2.0, 0.5]] * 2)).pairs == 1.0
