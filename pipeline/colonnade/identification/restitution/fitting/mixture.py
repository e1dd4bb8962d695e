"""Interval of a mean whose scatter is unknown: a mixture over all possible values of the scatter."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from colonnade.arrays import Array

SCALE = 0.002
"""Scatter of ln e from impact to impact that weighs most; ..."""

SMALLER, LARGER = 0.7, 0.5
"""... powers with which the weight falls off towards smaller and larger ones, by their logarithm."""

NO_SCATTER = 5.0
"""Times that the record is to be likelier with one e for all impacts before it is taken to have one."""

NEGLIGIBLE = 1e-8
"""Weight of a part of the mixture that is left out."""

SCATTERS = np.concatenate(([0.0], np.geomspace(3e-6, 0.1, 45)))
"""Standard deviations of ln e from impact to impact that are tried."""


@dataclass(frozen=True)
class MeanByScatter:
    """
    What a record says of a mean for each scatter that e may have; all shape (n,).

    Attributes
    ----------
    scatter : ndarray
        Standard deviation of ln e from impact to impact; 0 for one e.
    likelihood : ndarray
        Logarithm of the restricted likelihood, up to a constant.
    centre, error : ndarray
        The mean and its standard error with this scatter.
    freedom : float
        Degrees of freedom of the errors.
    step : float, optional
        Between the logarithms of scatters that are tried.
    """

    scatter: Array
    likelihood: Array
    centre: Array
    error: Array
    freedom: float
    step: float = float(np.log(SCATTERS[2] / SCATTERS[1]))


@dataclass(frozen=True)
class Mean:
    """A mean with its interval and standard error, and the scatter: its mean by weight, 0 if it has none."""

    value: float
    low: float
    high: float
    standard_error: float
    scatter: float

    def moved(self, step: float) -> Mean:
        """Return the mean with a step added to the value and its bounds."""
        return replace(self, value=self.value + step, low=self.low + step, high=self.high + step)


def mean_of_student(value: float, error: float, freedom: float, level: float) -> Mean:
    """Return a mean with a standard error of so many degrees of freedom: its interval is Student's."""
    half = float(scipy.special.stdtrit(freedom, (1 + level) / 2)) * error
    return Mean(value, value - half, value + half, error, 0.0)


def mean_over_scatters(parts: MeanByScatter, level: float) -> Mean:
    """
    Combine what is said for each scatter.

    Parameters
    ----------
    parts : MeanByScatter
    level : float
        Of the interval.

    Returns
    -------
    mean : Mean

    Notes
    -----
    The scatter of a few impacts is badly known, and an interval that takes the likeliest one is too narrow. Each
    scatter counts by its restricted likelihood times a weight (`SCALE`), as in a random-effects meta-analysis of few
    studies (Röver 2020). Only where one e for all impacts is `NO_SCATTER` times as likely as all of these together is
    there no scatter. These numbers were set by simulation: docs/decisions/0024.
    """
    likelihood = np.exp(parts.likelihood - parts.likelihood.max())
    scattered = parts.scatter > 0
    # The scatters tried are spaced evenly in their logarithm.
    weight = np.where(scattered, likelihood * _weight(parts.scatter), 0.0) * parts.step
    one = float(likelihood[~scattered].sum())
    if one > NO_SCATTER * float(weight.sum()):
        weight = np.where(scattered, 0.0, likelihood)
    weight = weight / weight.sum()
    kept = weight > NEGLIGIBLE
    weight, centre, error = weight[kept], parts.centre[kept], parts.error[kept]
    middle = float(weight @ centre / weight.sum())
    spread = float(np.sqrt(weight @ (error**2 + (centre - middle) ** 2) / weight.sum()))

    def quantile(share: float) -> float:
        def excess(value: float) -> float:
            return float(weight @ scipy.special.stdtr(parts.freedom, (value - centre) / error) / weight.sum()) - share

        reach = spread
        while not excess(middle - reach) < 0 < excess(middle + reach):
            reach *= 2
        return float(scipy.optimize.brentq(excess, middle - reach, middle + reach, xtol=1e-6 * spread))

    low, value, high = (quantile(share) for share in ((1 - level) / 2, 0.5, (1 + level) / 2))
    # Of the normal distribution whose interval is as wide.
    normal = (high - low) / 2 / float(scipy.special.ndtri((1 + level) / 2))
    return Mean(value, low, high, normal, float(weight @ parts.scatter[kept] / weight.sum()))


def _weight(scatter: Array) -> Array:
    """Weight of each scatter by its logarithm; its integral is 1."""
    size = scatter / SCALE
    height = (SMALLER + LARGER) * np.sin(np.pi * SMALLER / (SMALLER + LARGER)) / np.pi
    return np.asarray(height * size**SMALLER / (1 + size ** (SMALLER + LARGER)))
