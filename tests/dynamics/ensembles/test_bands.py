"""Bands of an ensemble, what its runs end in, and how its inputs count."""

import numpy as np
import pytest
from scipy import stats
from scipy.stats import spearmanr

from colonnade.dynamics.ensembles.bands import BINS, band, count, empty_counts
from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.outcome import correlation, ranks_of
from colonnade.dynamics.ensembles.uncertainty import INPUTS, Uncertainty
from colonnade.dynamics.motion import Motion
from every import every
from prism import PRISM

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


def histories(number=4000, samples=20, seed=1):
    """Deviations that are a thousand times larger at the last sample than at the first, and skewed."""
    normal = np.random.default_rng(seed).standard_normal((number, samples))
    return ((np.exp(0.7 * normal) - 1.5) * np.geomspace(1e-4, 0.1, samples)).astype(np.float32)


def counted(*groups):
    counts = empty_counts(groups[0].shape[1])
    for group in groups:
        count(counts, group)
    return counts


def test_quantiles_agree_with_numpys_over_three_decades():
    deviations = histories()
    exact = np.quantile(deviations, LEVELS, axis=0)
    found = band(counted(deviations), LEVELS)
    # An eighth of a doubling is at most an eighth of the deviation; interpolation leaves a tenth of that.
    np.testing.assert_allclose(found, exact, rtol=0.02, atol=1e-6)


def test_parts_add_up_to_the_whole_in_any_order():
    deviations = histories(500)
    whole = counted(deviations)
    parts = counted(deviations[300:]) + counted(deviations[:300])
    np.testing.assert_array_equal(whole, parts)
    assert whole.shape == (20, BINS)
    np.testing.assert_array_equal(whole.sum(axis=1), 500)


@every("value", [0.0, 1e-9, -1e-9, 1e-3, -1e-3, 0.7, 60.0, -60.0], ids=str)
def test_one_value_gives_a_band_within_an_eighth_of_it(value):
    found = band(counted(np.full((10, 1), value, dtype=np.float32)), LEVELS)
    assert np.abs(found - value).max() <= abs(value) / 8 + 1e-6


def test_what_lies_beyond_the_largest_bin_is_counted_in_it():
    counts = counted(np.array([[1e6], [-1e6]], dtype=np.float32))
    assert counts[0, 0] == 1
    assert counts[0, -1] == 1


@pytest.mark.parametrize(
    ("deviations", "found"),
    [(np.array([[np.nan]], dtype=np.float32), "NaN"), (np.zeros((3, 2), dtype=np.float32), r"\(3, 2\)")],
    ids=["a missing angle", "another clock"],
)
def test_what_cannot_be_counted_is_refused(deviations, found):
    with pytest.raises(ValueError, match=found):
        count(empty_counts(1), deviations)


@pytest.mark.parametrize("levels", [(0.5, 0.5), (0.9, 0.1), (-0.1, 0.5), (0.5, 1.2)], ids=str)
def test_levels_that_do_not_increase_from_0_to_1_are_refused(levels):
    with pytest.raises(ValueError, match="increase"):
        band(counted(histories(5)), levels)


def test_a_band_of_nothing_is_refused():
    with pytest.raises(ValueError, match="no history"):
        band(empty_counts(3), (0.5,))


PULSE = Motion(np.concatenate((2.0 * np.sin(2 * np.pi * np.arange(100) / 100), np.zeros(600))), 0.004)


def test_sensitivity_names_what_the_peak_follows_from():
    """One pulse, peak before the first impact: e has no part in it, a larger motion rises higher, a larger α less."""
    uncertainty = Uncertainty(restitution=0.01, critical_angle=0.003, gain=0.02)
    half = Motion(np.concatenate((1.9 * np.sin(np.pi * np.arange(50) / 50), np.zeros(60))), 0.004)
    result = ensemble(PRISM, half, restitution=0.95, uncertainty=uncertainty, count=800)
    found = result.sensitivity()
    assert set(found) == {"restitution", "critical_angle", "gain"}
    assert found["gain"] > 0.9
    assert -0.6 < found["critical_angle"] < -0.1
    assert abs(found["restitution"]) < 0.1
    for name in found:
        expected = spearmanr(result.peak_ratio, result.inputs[:, INPUTS.index(name)]).statistic
        assert found[name] == pytest.approx(expected, abs=1e-12)


def test_no_certainty_follows_from_few_members():
    result = ensemble(PRISM, PULSE, restitution=0.95, uncertainty=Uncertainty(gain=0.01), count=20)
    assert result.overturning_probability == 0.0
    assert result.overturning_interval() == pytest.approx((0.0, 0.16113), abs=1e-4)  # Wilson, 0 of 20


def test_ranks_of_equal_values_are_shared_and_nan_is_highest():
    assert ranks_of(np.array([3.0, 1.0, 1.0, np.nan, np.nan])).tolist() == [2.0, 0.5, 0.5, 3.5, 3.5]


def test_it_is_spearmans_correlation():
    rng = np.random.default_rng(1)
    first, second = rng.normal(size=50).round(1), rng.normal(size=50).round(1)
    expected = stats.spearmanr(first, second).statistic
    assert correlation(ranks_of(first), ranks_of(second)) == pytest.approx(expected)


def test_values_that_do_not_vary_have_none():
    assert np.isnan(correlation(ranks_of(np.ones(4)), ranks_of(np.arange(4.0))))
