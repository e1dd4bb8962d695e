"""Annual rate of overturning, with the share of it that rests on extrapolation."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.fragility.curves.hazard import Hazard, isotonic_rate, lognormal_rate
from colonnade.assessment.fragility.curves.isotonic import IsotonicCurve
from colonnade.assessment.fragility.curves.lognormal import LognormalFit
from colonnade.assessment.fragility.resampling import Interval

YEARS = 50.0
LARGEST_SHARE = 0.05
"""Of a rate from outside the range of hazard or levels, above which it depends on extrapolation."""

BINS = 20
"""Of the disaggregation."""


@dataclass(frozen=True)
class AnnualRate:
    """
    Rate of overturning.

    Attributes
    ----------
    rate, in_50_years : Interval
        Per year; probability of at least once in `YEARS`, 1 − exp(−λ t).
    below_hazard, above_hazard : float
        Shares of the rate from below the first point of the hazard curve and above its last, which is extrapolated.
    below_levels, above_levels : float
        Shares from below the lowest level and above the highest, where nothing was computed.
    is_extrapolated : bool
        Whether more than `LARGEST_SHARE` is from outside either.
    edges, contributions : ndarray, shape (n + 1,) and (n,)
        Disaggregation: shares of the rate between intensities.
    isotonic : float
        Rate by the isotonic curve: 0 below the lowest level, constant above the highest, ln x linear between.
    """

    rate: Interval
    in_50_years: Interval
    below_hazard: float
    above_hazard: float
    below_levels: float
    above_levels: float
    is_extrapolated: bool
    edges: Array
    contributions: Array
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

    Raises
    ------
    ValueError
        If there is no curve.

    Notes
    -----
    McGuire (2004). The interval is that of the fragility over records; the hazard has none.
    """
    if fit.reason:
        raise ValueError(f"fit has no curve ({fit.reason}); a fitted curve was expected")

    def log_rate(mean: Array, log_beta: Array) -> Array:
        return np.log(lognormal_rate(hazard, np.exp(mean[:, 0]), np.exp(log_beta[:, 0])))[:, None]

    rate = Interval(*(float(np.exp(each[0])) for each in fit.band(log_rate)))

    def share(low: float, high: float) -> float:
        return float(lognormal_rate(hazard, fit.median.value, fit.beta.value, low=low, high=high)[0]) / rate.value

    first, last = float(isotonic.intensity[0]), float(isotonic.intensity[-1])
    below_hazard, above_hazard = share(0.0, hazard.intensity[0]), share(hazard.intensity[-1], np.inf)
    below_levels, above_levels = share(0.0, first), share(last, np.inf)
    edges = np.geomspace(min(hazard.intensity[0], first), max(hazard.intensity[-1], last), BINS + 1)
    return AnnualRate(
        rate,
        Interval(*(float(-np.expm1(-YEARS * each)) for each in rate)),
        below_hazard,
        above_hazard,
        below_levels,
        above_levels,
        max(below_hazard + above_hazard, below_levels + above_levels) > LARGEST_SHARE,
        edges,
        np.array([share(low, high) for low, high in pairwise(edges)]),
        isotonic_rate(hazard, isotonic.intensity, isotonic.probability.value),
    )
