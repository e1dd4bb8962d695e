"""One restitution for a specimen from several free vibrations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

PRIOR_FREEDOM = 14
"""How slowly the tests' own errors are told apart from the scatter between them: chosen by coverage of new tests."""


@dataclass(frozen=True)
class Pooled:
    """
    Value pooled of `tests`, its interval at `level`, standard error, scatter between tests, and `new_test` (all of e).

    `new_test` is the standard deviation of a new test's e about the value, as far as the tests show it.
    """

    value: float
    low: float
    high: float
    standard_error: float
    between: float
    new_test: float
    level: float
    tests: int

    def of_new_test(self, usual: float) -> tuple[float, int | None]:
        """
        Say how far e of a new test may be from the pooled value.

        Parameters
        ----------
        usual : float
            Standard deviation of e between tests, for a single test, which does not show it.

        Returns
        -------
        deviation : float
            Of the error of the pooled value and the scatter between tests together.
        freedom : int or None
            Degrees of freedom of Student's t that it is the scale of (Higgins et al. 2009); None for a normal one.
        """
        if self.tests == 1:
            return float(np.hypot(self.new_test, usual)), None
        return self.new_test, self.tests - 1


def pool(values: ArrayLike, standard_errors: ArrayLike, *, level: float = 0.95) -> Pooled:
    """
    Pool the results of repeated tests.

    Parameters
    ----------
    values, standard_errors : array_like, shape (k,)
        e of each test and its standard error.
    level : float, optional
        Of the interval of confidence.

    Returns
    -------
    pooled : Pooled

    Raises
    ------
    ValueError
        If values are missing or an error is not positive.

    Notes
    -----
    Random effects: each test has its own error and all share a scatter τ between tests (Paule and Mandel 1982: τ² is
    where the weighted sum of squares equals its degrees of freedom). The interval takes the larger of the standard
    error from the weights and the one from the observed scatter (Hartung and Knapp 2001), with Student's t of k − 1;
    a single test keeps its normal interval.

    A new test's e scatters by less than those of the tests, which have errors of their own. Few tests do not show how
    much less: of k tests (k − 1) / (k − 1 + `PRIOR_FREEDOM`) of the variance of their own errors is taken off. Its 95 %
    range then holds 93 to 97 % of new tests, from 2 tests to 20, whether their errors are half the scatter or twice.
    """
    e, error = np.asarray(values, dtype=np.float64), np.asarray(standard_errors, dtype=np.float64)
    if e.size == 0 or e.shape != error.shape or not (error > 0).all():
        raise ValueError(
            "values and positive standard errors of at least one test, in arrays of one length, were expected"
        )
    freedom = e.size - 1
    if freedom == 0:
        half = float(scipy.stats.norm.ppf((1 + level) / 2)) * float(error[0])
        return Pooled(
            float(e[0]), float(e[0]) - half, float(e[0]) + half, float(error[0]), 0.0, float(error[0]), level, 1
        )

    def excess(variance: float) -> float:
        weights = 1 / (error**2 + variance)
        return float((weights * (e - np.average(e, weights=weights)) ** 2).sum()) - freedom

    widest = float(np.ptp(e)) ** 2 * e.size
    between = float(scipy.optimize.brentq(excess, 0.0, widest, xtol=1e-18)) if excess(0.0) > 0 else 0.0
    weights = 1 / (error**2 + between)
    value = float(np.average(e, weights=weights))
    by_weights = float(1 / np.sqrt(weights.sum()))
    by_scatter = float(np.sqrt((weights * (e - value) ** 2).sum() / (freedom * weights.sum())))
    standard_error = max(by_weights, by_scatter)
    reach = float(scipy.stats.t.ppf((1 + level) / 2, freedom))
    half = reach * standard_error
    own = freedom / (freedom + PRIOR_FREEDOM) * float(np.average(error**2, weights=weights))
    # Tests that agree by chance: the range still holds a standard error of their mean.
    new_test = max(float(np.sqrt(by_scatter**2 + max(e.size * by_scatter**2 - own, 0.0))), by_weights / reach)
    return Pooled(value, value - half, value + half, standard_error, float(np.sqrt(between)), new_test, level, e.size)
