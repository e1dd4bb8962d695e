"""Counted quantiles are those of numpy to a fraction of a bin, and parts add up exactly."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.ensembles.bands import BINS, band, count, empty_counts
from every import every

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
