"""Rank correlation, held against SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from colonnade.dynamics.ensembles.rank_correlation import correlation, ranks_of


def test_ranks_of_equal_values_are_shared_and_nan_is_highest():
    assert ranks_of(np.array([3.0, 1.0, 1.0, np.nan, np.nan])).tolist() == [2.0, 0.5, 0.5, 3.5, 3.5]


def test_it_is_spearmans_correlation():
    rng = np.random.default_rng(1)
    first, second = rng.normal(size=50).round(1), rng.normal(size=50).round(1)
    expected = stats.spearmanr(first, second).statistic
    assert correlation(ranks_of(first), ranks_of(second)) == pytest.approx(expected)


def test_values_that_do_not_vary_have_none():
    assert np.isnan(correlation(ranks_of(np.ones(4)), ranks_of(np.arange(4.0))))
