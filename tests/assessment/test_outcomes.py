"""Outcomes on their axes, in stripes, and surviving more."""

import numpy as np
import pytest

from colonnade.assessment.outcomes import MOST_STRIPES, Cells, gather, resurrected, striped
from virtual_capacities import lognormal

PEAK = np.array([[0.0, 0.4, 2.0], [0.2, np.nan, 0.9]])
INTENSITY = np.array([[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]])


def test_two_axes_are_records_and_levels_with_one_draw_and_one_direction():
    found = gather(["a", "b"], INTENSITY, PEAK)
    assert (found.peak.shape, found.intensity.shape) == ((2, 3, 1, 1), (2, 3, 1))
    assert found.overturned[:, :, 0, 0].tolist() == [[False, False, True], [False, False, False]]


def test_histories_of_one_intensity_are_counted_together_and_missing_ones_are_not():
    cells = gather(["a", "b"], INTENSITY, PEAK).cells()
    assert cells.histories.tolist() == [[1, 1, 1], [1, 0, 1]]
    assert cells.events.tolist() == [[0, 0, 1], [0, 0, 0]]
    np.testing.assert_allclose(np.exp(cells.log_intensity[0]), [1, 2, 3])


def test_directions_with_intensities_of_their_own_are_cells_of_their_own():
    peak = np.array([[[[0.5, 2.0]]], [[[2.0, 2.0]]]])
    apart = gather(["a", "b"], [[[1.0, 2.0]], [[1.0, 3.0]]], peak).cells()
    together = gather(["a", "b"], [[1.0], [1.0]], peak).cells()
    assert (apart.events.tolist(), together.events.tolist()) == ([[0, 1], [1, 1]], [[1], [2]])


def test_a_peak_that_is_not_known_because_it_overturned_may_be_infinite():
    found = gather(["a", "b"], INTENSITY, np.where(PEAK > 1, np.inf, PEAK))
    assert found.overturned.sum() == 1
    assert found.was_run.sum() == 5


def test_what_counts_as_overturned_may_be_given():
    given = gather(["a", "b"], INTENSITY, PEAK, PEAK > 0.3)
    assert given.overturned.sum() == 3


def test_one_record_is_not_enough():
    with pytest.raises(ValueError, match="1 name; at least 2"):
        gather(["a"], INTENSITY[:1], PEAK[:1])


def test_an_intensity_may_be_missing_where_nothing_was_run():
    assert gather(["a", "b"], np.where(np.isnan(PEAK), np.nan, INTENSITY), PEAK).cells().histories.sum() == 5


def test_levels_are_stripes_and_every_history_is_in_one():
    cells = lognormal(1).cells()
    found = striped(cells)
    np.testing.assert_allclose(found.log_intensity, cells.log_intensity[0])
    np.testing.assert_array_equal(found.events, cells.events)


def test_bins_between_which_there_is_nothing_are_left_out():
    y = np.concatenate((np.zeros(30), np.linspace(5, 5.1, 30), np.linspace(9, 9.1, 4)))[None].repeat(2, axis=0)
    found = striped(Cells(y, np.zeros_like(y), np.ones_like(y)))
    assert found.log_intensity.size <= MOST_STRIPES
    assert (np.diff(found.log_intensity) > 0).all()
    assert (found.histories.sum(axis=0) > 0).all()
    assert found.histories.sum() == y.size


def test_cells_that_were_not_run_make_no_stripe():
    y = np.log([[1.0, 2.0, 50.0], [1.0, 2.0, 50.0]])
    found = striped(Cells(y, np.zeros((2, 3)), np.array([[1.0, 1.0, 0.0]] * 2)))
    np.testing.assert_allclose(np.exp(found.log_intensity), [1.0, 2.0])


def test_histories_that_survive_more_than_overturned_their_record_and_draw_are_counted():
    peak = [[[0.5, 0.5], [2, 0.5], [0.5, 0.5], [0.5, 2]], [[0.5, 0.5], [2, 2], [2, 2], [2, 2]]]
    assert resurrected(gather(["one", "two"], [[1, 2, 3, 4.0]] * 2, peak)) == pytest.approx(2 / 16)
