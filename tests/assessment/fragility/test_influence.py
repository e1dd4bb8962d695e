"""The records that decide a curve are found."""

import numpy as np
import pytest

from colonnade.assessment.fragility.curves.hazard import hazard_curve, lognormal_rate
from colonnade.assessment.fragility.curves.lognormal import fit_lognormal
from colonnade.assessment.fragility.influence import influence
from virtual_capacities import MEDIAN, lognormal, outcomes_of


def test_a_record_unlike_the_others_comes_first():
    capacity = MEDIAN * np.exp(np.random.default_rng(1).normal(0, 0.1, (20, 4)))
    capacity[7] /= 2.5
    assert influence(outcomes_of(capacity)).records[0] == "record 7"


def test_it_is_the_curve_of_all_other_records():
    outcomes = lognormal(2)
    found = influence(outcomes, hazard_curve([0.1, 1.0], [1e-2, 1e-5]))
    place = found.records.index("record 3")
    without = fit_lognormal(outcomes.only(np.arange(30) != 3), resamples=2)
    assert (found.median[place], found.beta[place]) == pytest.approx((without.median.value, without.beta.value))
    expected = lognormal_rate(hazard_curve([0.1, 1.0], [1e-2, 1e-5]), without.median.value, without.beta.value)
    assert found.rate[place] == pytest.approx(expected[0])


def test_a_record_without_which_there_is_no_curve_comes_first():
    capacity = np.full((6, 2), MEDIAN)
    capacity[4] *= 3
    found = influence(outcomes_of(capacity))
    assert (found.records[0], np.isnan(found.median[0])) == ("record 4", True)
