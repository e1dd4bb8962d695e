"""Outcomes on their axes, in stripes, at rest or surviving more; and those that cannot be."""

import numpy as np
import pytest

from colonnade.assessment.outcomes import MOST_STRIPES, Cells, gather, resurrection, striped
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


@pytest.mark.parametrize(
    ("records", "intensity", "peak", "overturned", "said"),
    [
        pytest.param(["a", "a"], INTENSITY, PEAK, None, "each once", id="a name twice"),
        pytest.param(["a"], INTENSITY[:1], PEAK[:1], None, "at least 2", id="one record"),
        pytest.param(["a", "b"], INTENSITY[:, :2], PEAK, None, "one intensity", id="another number of levels"),
        pytest.param(["a", "b"], -INTENSITY, PEAK, None, "not positive", id="negative intensity"),
        pytest.param(["a", "b"], INTENSITY, PEAK * [[1], [np.nan]], None, "no history", id="a record that was not run"),
        pytest.param(["a", "b"], INTENSITY, -PEAK, None, "negative", id="negative peak"),
        pytest.param(["a", "b"], INTENSITY, PEAK, PEAK, "truth values", id="numbers for truth values"),
    ],
)
def test_outcomes_that_cannot_be_are_refused(records, intensity, peak, overturned, said):
    with pytest.raises(ValueError, match=said):
        gather(records, intensity, peak, overturned)


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


def test_a_pair_that_survives_more_than_overturned_it_is_counted_once_and_its_histories_each():
    peak = [[[0.5, 0.5], [2, 0.5], [0.5, 0.5], [0.5, 2]], [[0.5, 0.5], [2, 2], [2, 2], [2, 2]]]
    found = resurrection(gather(["one", "two"], [[1, 2, 3, 4.0]] * 2, peak))
    assert (found.pairs, found.records, found.lost) == (pytest.approx(1 / 4), ("one",), pytest.approx(2 / 16))


def test_levels_are_compared_by_intensity_and_not_by_their_order():
    assert resurrection(gather(["a", "b"], [[2.0, 1.0]] * 2, [[2.0, 0.5]] * 2)).pairs == 0.0
    assert resurrection(gather(["a", "b"], [[1.0, 2.0]] * 2, [[2.0, 0.5]] * 2)).pairs == 1.0
