"""Outcomes on their axes, counted by record and level, and surviving more."""

import numpy as np
import pytest

from colonnade.assessment.outcomes import gather

PEAK = np.array([[0.0, 0.4, 2.0], [0.2, np.nan, 0.9]])
LEVELS = np.array([1.0, 2.0, 3.0])


def test_histories_of_one_level_are_counted_together_and_missing_ones_are_not():
    cells = gather(["a", "b"], LEVELS, PEAK).cells()
    assert cells.histories.tolist() == [[1, 1, 1], [1, 0, 1]]
    assert cells.events.tolist() == [[0, 0, 1], [0, 0, 0]]
    np.testing.assert_allclose(np.exp(cells.log_intensity[0]), LEVELS)


def test_directions_are_cells_of_their_own_over_a_measure_that_differs_between_them():
    outcomes = gather(["a", "b"], [1.0], np.array([[[[0.5, 2.0]]], [[[2.0, 2.0]]]]))
    apart = outcomes.cells(intensity=np.array([[[1.0, 2.0]], [[1.0, 3.0]]]))
    assert (apart.events.tolist(), outcomes.cells().events.tolist()) == ([[0, 1], [1, 1]], [[1], [2]])


def test_one_record_is_not_enough():
    with pytest.raises(ValueError, match="1 name; at least 2"):
        gather(["a"], LEVELS, PEAK[:1])


def test_a_level_at_which_nothing_was_run_makes_no_stripe():
    found = gather(["a", "b"], LEVELS, PEAK * [1.0, 1.0, np.nan]).stripes()
    np.testing.assert_allclose(np.exp(found.log_intensity), [[1.0, 2.0]] * 2)
    assert found.histories.tolist() == [[1, 1], [1, 0]]
