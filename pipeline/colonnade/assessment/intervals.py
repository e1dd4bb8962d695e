"""Bootstrap over records: how often each is drawn, and studentised intervals of what is computed from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.ensemble import LARGEST_SEED
from colonnade.validation import number, whole

RESAMPLES, MOST_RESAMPLES = 1999, 100_000
FEWEST_RECORDS, MOST_WITHOUT = 10, 0.02
"""Of an interval: of fewer records, or if a larger share of the resamples gives no value, it would be too narrow."""

LEVEL = 0.95
"""Of intervals."""


class Interval(NamedTuple):
    """A value with its limits; infinite or NaN if the resamples give no limit."""

    value: float
    low: float
    high: float


class Band(NamedTuple):
    """Values with their limits, each of one shape."""

    value: Array
    low: Array
    high: Array


@dataclass(frozen=True)
class Resampling:
    """
    How intervals over records are made.

    Attributes
    ----------
    count : int
        How often the records are drawn again.
    seed : int
        The same seed gives the same intervals.
    level : float
        Of the intervals.

    Raises
    ------
    ValueError
        If one is out of its range.
    """

    count: int = RESAMPLES
    seed: int = 0
    level: float = LEVEL

    def __post_init__(self) -> None:
        whole("resamples", self.count, 1, MOST_RESAMPLES)
        whole("seed", self.seed, 0, LARGEST_SEED)
        number("level", self.level, "a probability between 0 and 1", above=0.0, below=1.0)

    def weights(self, records: int) -> Array:
        """
        Draw records with replacement, as many as there are.

        Returns
        -------
        weights : ndarray, shape (1 + count, records)
            How often each was drawn; in the first row each once.
        """
        drawn = np.random.default_rng(self.seed).multinomial(records, np.full(records, 1 / records), size=self.count)
        return np.vstack((np.ones(records), drawn))


def studentised(value: Array, error: Array, values: Array, errors: Array, level: float, records: int) -> Band:
    """
    Give studentised bootstrap intervals (bootstrap-t).

    Parameters
    ----------
    value, error : ndarray, shape (k,)
        Estimates, on a scale where they are about normal, and their standard errors.
    values, errors : ndarray, shape (n, k)
        The same of each resample.
    level : float
        Of the intervals.
    records : int

    Returns
    -------
    band : Band
        Shape (k,) each; limits are NaN without resamples.

    Notes
    -----
    Efron and Tibshirani (1993, ch. 12). Resamples of few records scatter too little: their quantiles are taken as far
    out as Student's t is for that number of records (Hesterberg 2015). `reports/fragility-study.md` shows the coverage.
    """
    t = (values - value) / np.where(errors > 0, errors, np.nan)
    reach = np.sqrt(records / (records - 1)) * scipy.special.stdtrit(records - 1, (1 + level) / 2)
    outside = scipy.special.ndtr(-reach)
    known = ~np.isnan(t).all(axis=0)
    low, high = np.full((2, *value.shape), np.nan)
    if known.any():
        low[known], high[known] = np.nanquantile(t[:, known], [outside, 1 - outside], axis=0)
    return Band(value, value - high * error, value - low * error)
