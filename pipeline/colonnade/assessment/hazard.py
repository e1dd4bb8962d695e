"""Hazard curves, log–log linear between their points, and the annual rate of overturning of a fragility over one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import log_ndtr, ndtr

from colonnade.arrays import Array
from colonnade.assessment.curves import IsotonicCurve, LognormalFit
from colonnade.assessment.intervals import Interval
from colonnade.validation import samples


@dataclass(frozen=True)
class Hazard:
    """
    Annual rate λ at which an intensity is exceeded; made by `hazard_curve`.

    Attributes
    ----------
    intensity, rate : ndarray, shape (k,)
        Rising and falling; log–log linear between the points, and beyond the ends as next to them. Rate per year.
    """

    intensity: Array
    rate: Array

    @property
    def slopes(self) -> Array:
        """k = −d ln λ / d ln x below the first point, between points, and above the last, shape (points + 1,)."""
        return np.pad(-np.diff(np.log(self.rate)) / np.diff(np.log(self.intensity)), 1, mode="edge")


def hazard_curve(intensity: ArrayLike, rate: ArrayLike) -> Hazard:
    """
    Check a hazard curve.

    Parameters
    ----------
    intensity, rate : array_like, shape (k,)
        At least two points; intensities in SI, rates per year.

    Raises
    ------
    ValueError
        If intensities are not positive and rising, or rates not positive and falling (a rate may repeat).
    """
    x, annual = samples("hazard.intensity", intensity, fewest=2), samples("hazard.rate", rate, fewest=2)
    if x.size != annual.size or not (x > 0).all() or not (np.diff(x) > 0).all():
        raise ValueError(
            f"hazard: {x.size} intensities, {annual.size} rates; as many positive, rising intensities were expected"
        )
    if not (annual > 0).all() or not (np.diff(annual) <= 0).all() or annual[0] == annual[-1]:
        raise ValueError(
            "hazard.rate is not positive and falling; the annual rate at which an intensity is exceeded falls"
        )
    return Hazard(x, annual)


def lognormal_rate(
    hazard: Hazard, median: ArrayLike, beta: ArrayLike, *, low: float = 0.0, high: float = np.inf
) -> Array:
    """
    Integrate λ = ∫ P(x) |dλ(x)| between two intensities.

    Parameters
    ----------
    hazard : Hazard
    median, beta : array_like, shape (n,)
        Of lognormal curves.
    low, high : float, optional
        Intensities.

    Returns
    -------
    rate : ndarray, shape (n,)
        Per year.

    Notes
    -----
    Exact: between points λ is a power x^−k, and for one power from 0 to ∞ this is the closed form
    k₀ m^−k exp(k² β² / 2) (Cornell et al. 2002).

    Examples
    --------
    >>> power = hazard_curve([0.1, 1.0], [1e-2, 1e-5])  # 1e-5 x^-3
    >>> float(round(lognormal_rate(power, 0.5, 0.4)[0] / (1e-5 * 0.5**-3 * np.exp(9 * 0.4**2 / 2)), 12))
    1.0
    """
    mean, width = np.log(np.atleast_1d(median))[:, None], np.atleast_1d(beta).astype(np.float64)[:, None]
    points, k = np.log(hazard.intensity), hazard.slopes
    with np.errstate(divide="ignore"):
        ends = np.clip(np.concatenate(([-np.inf], points, [np.inf])), np.log(low), np.log(high))
    # By parts: P λ at both ends, and ∫ λ dP, of which each piece is a shifted normal from a point of known rate on.
    place = np.concatenate(([0], np.arange(points.size)))
    shift = np.log(hazard.rate)[place] - k * (mean - points[place]) + (k * width) ** 2 / 2
    lower, upper = ((each - mean) / width + k * width for each in (ends[:-1], ends[1:]))
    # In the upper tail the difference of the small complements keeps its digits.
    turned = np.where(lower > 0, -1.0, 1.0)
    pieces = turned * (np.exp(shift + log_ndtr(turned * upper)) - np.exp(shift + log_ndtr(turned * lower)))

    def border(y: float) -> Array:
        return np.asarray((ndtr((y - mean) / width) * _rate_at(hazard, np.array([y])))[:, 0])

    # A rate that no longer falls at the last point is still there at the highest intensity.
    found = np.where(lower < upper, pieces, 0.0).sum(axis=1) - border(min(ends[-1], points[-1] + FAR))
    return np.asarray(found + border(ends[0]) if low > 0.0 else found)


def isotonic_rate(hazard: Hazard, intensity: Array, probability: Array) -> float:
    """
    Integrate ∫ λ dP over a curve that rises from point to point, per year.

    Parameters
    ----------
    hazard : Hazard
    intensity, probability : ndarray, shape (k,)
        0 below the first intensity, constant above the last, linear in ln x between.
    """
    y, points = np.log(intensity), np.log(hazard.intensity)
    ends = np.union1d(y, points[(points > y[0]) & (points < y[-1])])
    rates, rises = _rate_at(hazard, ends), np.diff(np.interp(ends, y, probability))
    falls = -np.diff(np.log(rates))
    mean = np.where(falls > 0, -np.expm1(-falls) / np.where(falls > 0, falls, 1.0), 1.0)
    return float(probability[0] * rates[0] + rises @ (rates[:-1] * mean))


def _rate_at(hazard: Hazard, y: Array) -> Array:
    """Rate at ln intensities, extrapolated beyond the ends."""
    points = np.log(hazard.intensity)
    place = np.searchsorted(points, y)
    reference = np.maximum(place - 1, 0)
    return np.asarray(hazard.rate[reference] * np.exp(-hazard.slopes[place] * (y - points[reference])))


FAR = 1e6
"""Beyond the last point, in ln x: where any hazard that falls has fallen to 0."""

YEARS = 50.0
LARGEST_SHARE = 0.05
"""Of a rate from outside the range of hazard or levels, above which it depends on extrapolation."""


@dataclass(frozen=True)
class AnnualRate:
    """
    Rate of overturning.

    Attributes
    ----------
    rate, in_50_years : Interval
        Per year; probability of at least once in `YEARS`, 1 − exp(−λ t).
    outside_hazard : float
        Share of the rate from below the first point of the hazard curve and above its last, which is extrapolated.
    outside_levels : float
        Share from below the lowest level and above the highest, where nothing was computed.
    isotonic : float
        Rate by the isotonic curve: 0 below the lowest level, constant above the highest, ln x linear between.
    """

    rate: Interval
    in_50_years: Interval
    outside_hazard: float
    outside_levels: float
    isotonic: float


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # of few records a resample may be nearly flat
def annual_rate(hazard: Hazard, fit: LognormalFit, isotonic: IsotonicCurve) -> AnnualRate:
    """
    Put a fragility curve over a hazard curve of the same measure.

    Parameters
    ----------
    hazard : Hazard
    fit : LognormalFit
        With a curve (no `reason`).
    isotonic : IsotonicCurve
        Of the same outcomes; its stripes are the levels.

    Notes
    -----
    McGuire (2004). The interval is that of the fragility over records; the hazard has none.
    """

    def log_rate(mean: Array, log_beta: Array) -> Array:
        return np.log(lognormal_rate(hazard, np.exp(mean[:, 0]), np.exp(log_beta[:, 0])))[:, None]

    rate = fit.interval(log_rate)

    def outside(known: Array) -> float:
        inside = lognormal_rate(hazard, fit.median.value, fit.beta.value, low=known[0], high=known[-1])
        return max(1.0 - float(inside[0]) / rate.value, 0.0)

    return AnnualRate(
        rate,
        Interval(*(float(-np.expm1(-YEARS * each)) for each in rate)),
        outside(hazard.intensity),
        outside(isotonic.intensity),
        isotonic_rate(hazard, isotonic.intensity, isotonic.probability.value),
    )
