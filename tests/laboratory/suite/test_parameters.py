"""Parameters of synthetic ground motions against the distributions that they are drawn from."""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy

from colonnade.laboratory.suite.parameters import CORRELATION, FLATTEST, STEEPEST, drawn_shaking, shaking_of


def test_at_zero_every_parameter_is_its_median():
    found = shaking_of(np.zeros(6))
    # ∫ a² dt in g² s has the median exp(−4.8255); π/2 g turns it into an Arias intensity.
    assert found.arias == pytest.approx(math.pi / 2 * 9.81 * math.exp(-4.8255))
    assert found.duration == pytest.approx(5 + 40 * scipy.stats.beta.median(1.1314, 2.4474))
    assert found.frequency == pytest.approx(scipy.stats.gamma.median(4.0982, scale=1.4330))
    assert -0.1 < found.slope < -0.03


def test_extremes_stay_within_their_bounds():
    low, high = shaking_of(np.full(6, -6.0)), shaking_of(np.full(6, 6.0))
    assert low.slope == pytest.approx(STEEPEST, abs=0.3)
    assert high.slope <= FLATTEST
    assert 5.0 <= low.duration < high.duration <= 45.0
    assert 0.02 <= low.damping < high.damping <= 1.0
    assert all(each.middle < each.duration for each in (low, high))


def test_the_two_sided_exponential_distribution_is_that_of_its_density():
    shares = np.linspace(0.02, 0.98, 25)
    slopes = [shaking_of(np.array([0, 0, 0, 0, scipy.stats.norm.ppf(share), 0])).slope for share in shares]

    def density(slope):
        return 4.8512 * math.exp(6.7729 * slope if slope < 0 else -17.095 * slope)

    found = [scipy.integrate.quad(density, STEEPEST, slope, points=[0.0])[0] for slope in slopes]
    np.testing.assert_allclose(found, shares, atol=2e-4)


def test_a_stronger_and_a_nearer_earthquake_shakes_more():
    def median(magnitude, distance):
        random = np.random.default_rng(0)
        return np.median([drawn_shaking(magnitude, distance, random).arias for _ in range(51)])

    # ln I_A is 1.4318 times a normal variable that grows by 2.944 M/7 and falls by 1.3564 ln R.
    assert median(7.5, 20e3) / median(6.5, 20e3) == pytest.approx(math.exp(1.4318 * 2.944 / 7))
    assert median(7.0, 10e3) / median(7.0, 40e3) == pytest.approx(4 ** (1.4318 * 1.3564))


def test_the_correlations_are_those_of_a_covariance():
    np.testing.assert_array_equal(CORRELATION, CORRELATION.T)
    assert np.linalg.eigvalsh(CORRELATION).min() > 0
