"""The annual rate, where it comes from, and how much of it is extrapolated."""

import numpy as np
import pytest

from colonnade.assessment.fragility.curves.hazard import hazard_curve
from colonnade.assessment.fragility.curves.isotonic import fit_isotonic
from colonnade.assessment.fragility.curves.lognormal import fit_lognormal
from colonnade.assessment.fragility.curves.rate import annual_rate
from virtual_capacities import BETA, MEDIAN, lognormal, outcomes_of

X = np.geomspace(0.02, 5, 12)


def rate_of(outcomes, hazard):
    return annual_rate(hazard, fit_lognormal(outcomes, resamples=300), fit_isotonic(outcomes, resamples=50))


@pytest.fixture(scope="module")
def found():
    return rate_of(lognormal(4, records=100), hazard_curve(X, 1e-4 * X**-2))


def test_the_interval_holds_the_true_rate(found):
    truth = 1e-4 * MEDIAN**-2 * np.exp(2 * BETA**2)
    assert found.rate.low < truth < found.rate.high
    assert found.in_50_years.value == pytest.approx(1 - np.exp(-50 * found.rate.value))
    assert found.in_50_years.low == pytest.approx(1 - np.exp(-50 * found.rate.low))


def test_its_contributions_and_what_is_outside_add_up(found):
    inside = 1 - found.below_hazard - found.above_hazard
    assert found.contributions.sum() == pytest.approx(inside)
    assert (found.edges[0], found.edges[-1]) == pytest.approx((X[0], X[-1]))
    peak = found.edges[np.argmax(found.contributions)]
    assert MEDIAN * np.exp(-3 * BETA) < peak < MEDIAN


def test_without_a_distribution_it_is_about_the_same(found):
    assert found.isotonic == pytest.approx(found.rate.value, rel=0.1)


def test_a_hazard_curve_that_ends_too_early_is_seen():
    x = np.array([0.05, 0.3])
    found = rate_of(lognormal(4), hazard_curve(x, 1e-4 * x**-2))
    assert (found.above_hazard > 0.3, found.is_extrapolated) == (True, True)


def test_a_steep_hazard_far_below_the_levels_is_seen():
    found = rate_of(lognormal(4), hazard_curve(X, 1e-4 * X**-6))
    assert (found.below_levels > 0.5, found.below_hazard < 0.05, found.is_extrapolated) == (True, True, True)


def test_without_a_curve_there_is_no_rate():
    with pytest.raises(ValueError, match="no curve"):
        rate_of(outcomes_of(np.full((4, 2), MEDIAN)), hazard_curve(X, X**-2))
