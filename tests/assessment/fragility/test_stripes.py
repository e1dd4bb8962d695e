"""Histories sorted into stripes."""

import numpy as np

from colonnade.assessment.fragility.outcomes import Cells
from colonnade.assessment.fragility.stripes import MOST_STRIPES, striped
from virtual_capacities import lognormal


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
