"""Rates: the closed form of a power law, quadrature of any hazard curve, and how much is extrapolated."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.assessment.curves import fit_isotonic, fit_lognormal
from colonnade.assessment.hazard import annual_rate, hazard_curve, isotonic_rate, lognormal_rate
from colonnade.assessment.intervals import Resampling
from every import every
from virtual_capacities import BETA, MEDIAN, lognormal

X = np.geomspace(0.01, 10, 30)


@every("k", [0.5, 1.0, 3.0, 8.0, 20.0])
@every("beta", [0.1, 0.4, 1.0])
def test_a_power_law_gives_its_closed_form(k, beta):
    """k₀ m^−k exp(k² β² / 2), Cornell et al. 2002."""
    found = lognormal_rate(hazard_curve(X, 2e-4 * X**-k), 0.4, beta)
    assert found[0] == pytest.approx(2e-4 * 0.4**-k * np.exp(k**2 * beta**2 / 2), rel=1e-9)


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 10**6), points=st.integers(2, 8), median=st.floats(0.1, 3.0), beta=st.floats(0.1, 1.2))
def test_between_its_points_it_is_the_quadrature(seed, points, median, beta):
    random = np.random.default_rng(seed)
    x = np.cumsum(random.uniform(0.05, 0.5, points))
    hazard = hazard_curve(x, np.exp(-np.cumsum(random.uniform(0.1, 3.0, points))))
    expected = 0.0
    for low, high, rate, k in zip(x[:-1], x[1:], hazard.rate[:-1], hazard.slopes[1:-1], strict=True):

        def density(y, low=low, rate=rate, k=k):
            return scipy.special.ndtr((y - np.log(median)) / beta) * k * rate * np.exp(-k * (y - np.log(low)))

        expected += scipy.integrate.quad(density, np.log(low), np.log(high), epsabs=0, epsrel=1e-10)[0]
    assert lognormal_rate(hazard, median, beta, low=x[0], high=x[-1])[0] == pytest.approx(expected, rel=1e-8)


def test_a_curve_of_points_near_a_lognormal_one_gives_its_rate():
    hazard = hazard_curve([0.1, 0.3, 1.0, 2.0], [1e-1, 2e-2, 1e-3, 1e-4])
    x = 0.7 * np.exp(0.5 * np.linspace(-5, 5, 400))
    points = isotonic_rate(hazard, x, scipy.special.ndtr(np.log(x / 0.7) / 0.5))
    assert points == pytest.approx(lognormal_rate(hazard, 0.7, 0.5)[0], rel=1e-3)


@pytest.mark.parametrize(
    ("intensity", "rate", "said"),
    [
        pytest.param([1.0, 1.0], [2.0, 1.0], "rising intensities", id="an intensity twice"),
        pytest.param([1.0, 2.0, 3.0], [2.0, 1.0], "as many", id="fewer rates"),
        pytest.param([1.0, 2.0], [1.0, 2.0], "falls", id="a rate that rises"),
        pytest.param([1.0, 2.0], [1.0, 0.0], "not positive", id="a rate of zero"),
        pytest.param([1.0], [1.0], "at least 2", id="one point"),
    ],
)
def test_curves_that_are_no_hazard_are_refused(intensity, rate, said):
    with pytest.raises(ValueError, match=said):
        hazard_curve(intensity, rate)


LEVELS_OF_RATE = np.geomspace(0.02, 5, 12)


def rate_of(outcomes, hazard):
    return annual_rate(hazard, fit_lognormal(outcomes, Resampling(300)), fit_isotonic(outcomes, Resampling(50)))


@pytest.fixture(scope="module")
def found():
    return rate_of(lognormal(4, records=100), hazard_curve(LEVELS_OF_RATE, 1e-4 * LEVELS_OF_RATE**-2))


def test_the_interval_holds_the_true_rate(found):
    truth = 1e-4 * MEDIAN**-2 * np.exp(2 * BETA**2)
    assert found.rate.low < truth < found.rate.high
    assert found.in_50_years.value == pytest.approx(1 - np.exp(-50 * found.rate.value))
    assert found.in_50_years.low == pytest.approx(1 - np.exp(-50 * found.rate.low))


def test_a_hazard_curve_that_ends_too_early_is_seen():
    x = np.array([0.05, 0.3])
    found = rate_of(lognormal(4), hazard_curve(x, 1e-4 * x**-2))
    assert found.outside_hazard > 0.3
