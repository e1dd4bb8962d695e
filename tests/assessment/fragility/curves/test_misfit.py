"""Outcomes that are not lognormal are found; those that are pass."""

import numpy as np
import pytest

from colonnade.assessment.fragility.curves.misfit import lognormal_misfit
from virtual_capacities import lognormal, outcomes_of, two_kinds


@pytest.mark.parametrize("seed", range(5))
def test_two_kinds_of_records_are_not_lognormal(seed):
    assert lognormal_misfit(two_kinds(seed), resamples=300).p_value < 0.05


def test_lognormal_outcomes_pass_although_their_deviance_is_large():
    """χ² of 8 degrees of freedom would call many of them misfits: its 95 % limit is 15.5."""
    found = [lognormal_misfit(lognormal(seed), resamples=300) for seed in range(12)]
    assert sum(each.p_value < 0.05 for each in found) <= 2
    assert sum(each.deviance > 15.5 for each in found) >= 4


def test_the_departure_shows_where():
    found = lognormal_misfit(two_kinds(1), resamples=50)
    steep = np.argmax(np.abs(found.departure))
    assert 0 < steep < found.intensity.size - 1
    assert np.abs(found.departure).max() > 0.05


def test_without_a_curve_there_is_no_p():
    separated = outcomes_of(np.full((4, 2), 0.4))
    assert np.isnan(lognormal_misfit(separated, resamples=20).p_value)
