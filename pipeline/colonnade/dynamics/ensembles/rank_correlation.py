"""Rank correlation (Spearman 1904) between the inputs and the results of an ensemble."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt

import numpy as np

from colonnade.arrays import Array


def rank_correlations(values: Array, columns: Mapping[str, Array]) -> dict[str, float]:
    """Correlate the ranks of values, NaN being highest, with those of each column that varies; shapes (n,)."""
    ranks = ranks_of(values)
    return {name: correlation(ranks, ranks_of(column)) for name, column in columns.items() if np.ptp(column) > 0.0}


def ranks_of(values: Array) -> Array:
    """Rank from 0, NaN being highest; equal values share the mean of their ranks."""
    _, place, number = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(number)
    return np.asarray((last - 0.5 * (number + 1))[place])


def correlation(first: Array, second: Array) -> float:
    """Return the correlation (Pearson's) of two rows of ranks; NaN if one of them does not vary."""
    one, other = first - first.mean(), second - second.mean()
    scale = sqrt(float(one @ one) * float(other @ other))
    return float(one @ other) / scale if scale > 0.0 else float("nan")
