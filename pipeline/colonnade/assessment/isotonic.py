"""Curve that only rises: the shares of the stripes by pooling adjacent violators, whatever their distribution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.intervals import Band, Interval, Resampling
from colonnade.assessment.outcomes import Outcomes, striped


@dataclass(frozen=True)
class IsotonicCurve:
    """
    Probabilities at stripes.

    Attributes
    ----------
    intensity : ndarray, shape (k,)
        Rising.
    probability : Band
        Shape (k,) each.
    level : float
        Of the intervals.
    """

    intensity: Array
    probability: Band
    level: float

    def reaches(self, probability: float) -> Interval:
        """
        Give the intensity at which the curve reaches a probability, ln x linear between stripes, and its interval.

        The limits are where those of the curve reach it. 0 if that is below the first stripe, inf if above the last.
        """
        value, low, high = self.probability
        return Interval(*(self._crossing(each, probability) for each in (value, high, low)))

    def _crossing(self, values: Array, probability: float) -> float:
        above = np.flatnonzero(values >= probability)
        if above.size == 0:
            return np.inf
        place = int(above[0])
        if place == 0:
            return 0.0 if values[0] > probability else float(self.intensity[0])
        y, (before, after) = np.log(self.intensity[place - 1 : place + 1]), values[place - 1 : place + 1]
        return float(np.exp(y[0] + (probability - before) / (after - before) * (y[1] - y[0])))


def fit_isotonic(outcomes: Outcomes, resampling: Resampling) -> IsotonicCurve:
    """
    Fit a curve that only rises.

    Parameters
    ----------
    outcomes : Outcomes
    resampling : Resampling

    Returns
    -------
    curve : IsotonicCurve

    Notes
    -----
    Barlow et al. (1972). Each interval is Clopper and Pearson's (1934), with the number of independent histories that
    gives the bootstrap's variance (Korn and Graubard 1998): near 0 and 1 resamples of few records hardly scatter, and
    their quantiles are too narrow. That number is at most what the variances of all stripes together give, and at least
    the number of records. If each record has intensities of its own, a stripe is a bin,
    and the curve is that of its bins.
    """
    stripes, weights = striped(outcomes.cells()), resampling.weights(len(outcomes.records))
    pooled = _pooled(weights @ stripes.events, weights @ stripes.histories)
    value, variance = pooled[0], pooled[1:].var(axis=0)
    of_records = (stripes.histories > 0).sum(axis=0)
    low, high = _limits(value, variance, of_records, resampling.level)
    # A curve that only rises has limits that only rise.
    band = Band(value, np.maximum.accumulate(low), np.minimum.accumulate(high[::-1])[::-1])
    return IsotonicCurve(np.exp(stripes.log_intensity), band, resampling.level)


def _pooled(events: Array, histories: Array) -> Array:
    """Isotonic shares of each row, shape (n, k); a stripe without a history takes its neighbour's."""
    found = np.empty_like(events)
    for row, (happened, of) in enumerate(zip(events, histories, strict=True)):
        counted = of > 0
        fit = scipy.optimize.isotonic_regression(happened[counted] / of[counted], weights=of[counted]).x
        found[row] = np.interp(np.arange(of.size), np.flatnonzero(counted), fit)
    return found


def _limits(value: Array, variance: Array, records: Array, level: float) -> tuple[Array, Array]:
    """Limits of shares whose bootstrap has such a variance, of so many records each."""
    spread = value * (1 - value)
    # Of n records the bootstrap's variance is (n − 1) / n of the unbiased one.
    unbiased = variance * records / np.maximum(records - 1, 1)
    scatters = unbiased > 0
    own = np.where(scatters, spread / np.where(scatters, unbiased, 1.0), records)
    # Independent histories that a record is worth, from all stripes: one with few events overstates it.
    worth = spread[scatters].sum() / (unbiased * records)[scatters].sum() if scatters.any() else 1.0
    effective = np.maximum(np.minimum(own, worth * records), records)
    events, outside = effective * value, (1 - level) / 2
    low = np.where(value > 0, scipy.special.betaincinv(events, effective - events + 1, outside), 0.0)
    high = np.where(value < 1, scipy.special.betaincinv(events + 1, effective - events, 1 - outside), 1.0)
    return low, high
