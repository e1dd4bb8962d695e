"""The curve that only rises: pooled shares, with intervals that do not vanish where nothing happened."""

import numpy as np
import pytest
from scipy import stats

from colonnade.assessment.intervals import Band, Resampling
from colonnade.assessment.isotonic import IsotonicCurve, fit_isotonic
from colonnade.assessment.outcomes import gather
from virtual_capacities import lognormal, names


def test_shares_that_rise_are_kept():
    outcomes = lognormal(1)
    curve = fit_isotonic(outcomes, Resampling(50))
    np.testing.assert_allclose(curve.probability.value, outcomes.overturned.mean(axis=(0, 2, 3)))
    np.testing.assert_allclose(curve.intensity, outcomes.intensity[0, :, 0])


def test_neighbours_that_fall_are_pooled():
    peak = np.array([[0.5, 2, 0.5, 2], [0.5, 2, 2, 2], [0.5, 0.5, 0.5, 2], [0.5, 0.5, 0.5, 2]])
    curve = fit_isotonic(gather(names(4), np.tile([1.0, 2, 3, 4], (4, 1)), peak), Resampling(50))
    np.testing.assert_allclose(curve.probability.value, [0, 0.375, 0.375, 1])


def test_of_n_records_the_limits_are_those_of_n_trials():
    peak = np.tile([0.5, 0.5, 2.0], (20, 1))
    curve = fit_isotonic(gather(names(20), np.tile([1.0, 2, 3], (20, 1)), peak), Resampling(50))
    assert curve.probability.low.tolist() == pytest.approx([0, 0, 0.025 ** (1 / 20)])  # Clopper and Pearson
    assert curve.probability.high.tolist() == pytest.approx([1 - 0.025 ** (1 / 20)] * 2 + [1])


def test_limits_rise_and_hold_the_curve():
    band = fit_isotonic(lognormal(2), Resampling(200)).probability
    assert (np.diff(band.low) >= 0).all()
    assert (np.diff(band.high) >= 0).all()
    assert ((band.low <= band.value) & (band.value <= band.high)).all()


def test_the_intensity_of_a_probability_is_between_its_stripes():
    band = Band(*(np.array(each) for each in ([0.0, 0.2, 0.6], [0.0, 0.1, 0.4], [0.1, 0.5, 0.9])))
    curve = IsotonicCurve(np.array([1.0, 2.0, 4.0]), band, 0.95)
    assert curve.reaches(0.4) == pytest.approx((2 * 2**0.5, 2**0.75, 4.0))
    assert curve.reaches(0.05) == pytest.approx((2**0.25, 0.0, 2**0.5))
    assert curve.reaches(0.95) == (np.inf, np.inf, np.inf)


def test_many_different_intensities_are_binned():
    outcomes = lognormal(3)
    own = outcomes.intensity[:, :, 0] * np.exp(np.random.default_rng(4).normal(0, 0.3, (30, 1)))
    curve = fit_isotonic(gather(outcomes.records, own, outcomes.peak), Resampling(50))
    assert (curve.intensity.size, (np.diff(curve.intensity) > 0).all()) == (20, True)
    assert own.min() < curve.intensity[0] < curve.intensity[-1] < own.max()


def test_at_the_outermost_levels_of_few_records_the_limits_hold_the_truth():
    """One event of ten, where 1.4 % overturn: the limits of Wilson (1927) missed that, in 16 % of the samples."""
    peak = np.tile([0.5, 2.0], (10, 1))
    peak[0, 0] = 2.0
    curve = fit_isotonic(gather(names(10), np.tile([1.0, 2.0], (10, 1)), peak), Resampling(500))
    exact = stats.binomtest(1, 10).proportion_ci(0.95, method="exact")
    assert (curve.probability.low[0], curve.probability.high[0]) == pytest.approx(tuple(exact), abs=1e-6)
