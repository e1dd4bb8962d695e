"""Curves of overturning: lognormal with its misfit, or why there is none, and one that only rises."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.assessment.intervals import FEWEST_RECORDS, MOST_WITHOUT, Band, Interval, Resampling, studentised
from colonnade.assessment.outcomes import Outcomes
from colonnade.assessment.probit import Parameters, fit_parameters
from colonnade.validation import samples

ENOUGH_RECORDS, LEAST_MIXED = 50, 0.8
"""Of an interval: of fewer records, shares of the rarer outcome add up to so much, as of levels that are β apart."""

STEP = 1e-5
"""Of numerical derivatives with respect to ln median and ln β."""


@dataclass(frozen=True)
class LognormalFit:
    """
    P = Φ(ln(x / median) / β), or why there is no curve.

    Attributes
    ----------
    reason : str
        Empty if there is a curve, else "separated" (outcomes do not overlap), "falling" (fewer events at higher
        intensity), "never", "always" or "one intensity".
    level : float
        Of the intervals.
    records : int
        Their number.
    fit, resampled : Parameters
        Of all records, shape (1,), and of each resample with a curve, shape (n,); none if there is no interval.
    """

    reason: str
    level: float
    records: int
    fit: Parameters
    resampled: Parameters

    @cached_property
    def median(self) -> Interval:
        """NaN if there is no curve; its limits also if `no_interval` says why."""
        return self.interval(lambda mean, log_beta: mean)

    @cached_property
    def beta(self) -> Interval:
        """As `median`."""
        return self.interval(lambda mean, log_beta: log_beta)

    @property
    def no_interval(self) -> str:
        """Why the curve has no intervals, in sentences; empty if it has some, or there is no curve."""
        if self.reason or self.resampled.log_median.size:
            return ""
        if self.records < FEWEST_RECORDS:
            return f"There are {self.records} records. A curve has no interval below {FEWEST_RECORDS}. Add records."
        return (
            f"The levels are too far apart for {self.records} records, so there is no interval: at too few levels some "
            "records stand and others overturn. Add records, or levels closer together."
        )

    def probability(self, intensity: ArrayLike) -> Band:
        """Give P at intensities, shape (k,), with intervals; NaN if there is no curve."""
        x = np.log(samples("intensity", intensity))
        band = self.band(lambda mean, log_beta: (x - mean) / np.exp(log_beta))
        return Band(*(scipy.special.ndtr(each) for each in band))

    def reaches(self, probability: float) -> Interval:
        """Give the intensity at which the curve reaches a probability, with its interval; NaN if there is no curve."""
        z = float(scipy.special.ndtri(probability))
        return self.interval(lambda mean, log_beta: mean + z * np.exp(log_beta))

    @np.errstate(over="ignore", invalid="ignore")  # of few records a limit may be as good as infinite
    def interval(self, log_value: Callable[[Array, Array], Array]) -> Interval:
        """Give a number that follows from the curve, with its interval; `log_value` is its logarithm, as of `band`."""
        return Interval(*(float(np.exp(each[0])) for each in self.band(log_value)))

    def band(self, function: Callable[[Array, Array], Array]) -> Band:
        """
        Give an interval of what follows from the curve.

        Parameters
        ----------
        function : callable
            Of ln median and ln β, shape (n, 1) each; returns shape (n, k), on a scale where it is about normal.
        """
        value, error = _with_errors(function, self.fit)
        values, errors = _with_errors(function, self.resampled)
        return studentised(value[0], error[0], values, errors, self.level, self.records)


def fit_lognormal(outcomes: Outcomes, resampling: Resampling, *, event: Mask | None = None) -> LognormalFit:
    """
    Fit a lognormal curve to outcomes.

    Parameters
    ----------
    outcomes : Outcomes
    resampling : Resampling
    event : ndarray, optional
        As of `Outcomes.cells`.

    Returns
    -------
    fit : LognormalFit

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Notes
    -----
    Maximum of the binomial likelihood on stripes (Baker 2015), which holds for any intensities. Histories of
    one record are not independent, so the standard errors are those of records (sandwich) and the intervals are
    studentised, of ln median and ln β.
    """
    cells, records = outcomes.cells(event), len(outcomes.records)
    parameters, _, reasons = fit_parameters(cells, resampling.weights(records))
    has_curve = reasons[1:] == ""
    counted = cells.histories.any(axis=0)
    shares = cells.events.sum(axis=0)[counted] / cells.histories.sum(axis=0)[counted]
    mixed = float(np.minimum(shares, 1 - shares).sum())
    shows = records >= ENOUGH_RECORDS or mixed >= LEAST_MIXED
    usable = has_curve & (shows and records >= FEWEST_RECORDS and has_curve.mean() >= 1 - MOST_WITHOUT)
    return LognormalFit(
        str(reasons[0]),
        resampling.level,
        records,
        Parameters(*(each[:1] for each in parameters)),
        Parameters(*(each[1:][usable] for each in parameters)),
    )


def _with_errors(function: Callable[[Array, Array], Array], at: Parameters) -> tuple[Array, Array]:
    """Values of a function of the parameters, and their standard errors by its derivatives, shape (n, k) each."""
    mean, log_beta = at.log_median[:, None], at.log_beta[:, None]
    by_mean = (function(mean + STEP, log_beta) - function(mean - STEP, log_beta)) / (2 * STEP)
    by_beta = (function(mean, log_beta + STEP) - function(mean, log_beta - STEP)) / (2 * STEP)
    variance = by_mean**2 * at.mm[:, None] + 2 * by_mean * by_beta * at.mb[:, None] + by_beta**2 * at.bb[:, None]
    return function(mean, log_beta), np.sqrt(np.maximum(variance, 0.0))


def lognormal_misfit(outcomes: Outcomes, resampling: Resampling) -> float:
    """
    Test whether a lognormal curve fits.

    Returns
    -------
    p_value : float
        Probability of so large a χ² of Pearson's of the stripes' shares if the curve were right, by resamples of the
        records. NaN without a curve.

    Notes
    -----
    The χ² of a deviance does not hold: a record at several levels is one record. The distribution under the curve is
    that of the resamples' departures about the observed ones (centred bootstrap, Hall and Wilson 1991).
    """
    stripes, weights = outcomes.stripes(), resampling.weights(len(outcomes.records))
    parameters, _, reasons = fit_parameters(outcomes.cells(), weights)
    of, beta = weights @ stripes.histories, np.exp(parameters.log_beta)[:, None]
    expected = scipy.special.ndtr((stripes.log_intensity[0] - parameters.log_median[:, None]) / beta)
    departures = weights @ stripes.events / np.where(of > 0, of, np.nan) - expected
    fitted = reasons == ""
    likely = np.clip(expected[0], 0.5 / len(outcomes.records), 1 - 0.5 / len(outcomes.records))
    scale = of[0] / (likely * (1 - likely))
    statistic = float((scale * departures[0] ** 2).sum())
    null = (scale * (departures[1:][fitted[1:]] - departures[0]) ** 2).sum(axis=1)
    return float((1 + (null >= statistic).sum()) / (1 + null.size)) if fitted[0] else np.nan


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
    """

    intensity: Array
    probability: Band

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
    the number of records.
    """
    stripes, weights = outcomes.stripes(), resampling.weights(len(outcomes.records))
    pooled = _pooled(weights @ stripes.events, weights @ stripes.histories)
    value, variance = pooled[0], pooled[1:].var(axis=0)
    of_records = (stripes.histories > 0).sum(axis=0)
    low, high = _limits(value, variance, of_records, resampling.level)
    # A curve that only rises has limits that only rise.
    band = Band(value, np.maximum.accumulate(low), np.minimum.accumulate(high[::-1])[::-1])
    return IsotonicCurve(np.exp(stripes.log_intensity[0]), band)


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
