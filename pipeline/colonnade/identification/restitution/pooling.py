"""One restitution for a specimen from several free vibrations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.identification.restitution.result import EXACT, Joint

PRIOR_FREEDOM = 20
"""How slowly the tests' own errors are told apart from the scatter between them: chosen by coverage of new tests."""

LEAST_ERROR = 2 / 3
"""Of the tests' median error, that of a test at least."""

LEAST_ALONE = 1e-6
"""Share of a test's variance that is its own at least, when α and p are known."""


@dataclass(frozen=True)
class Pooled:
    """
    What several tests say of e, α and p together.

    Attributes
    ----------
    value, low, high, standard_error : float
        e of the specimen, its interval of confidence, and its standard error.
    between : float
        Standard deviation of e between tests.
    new_test : float
        Standard deviation of a new test's e about the value, as far as the tests show it.
    tests : int
    mean : ndarray, shape (3,)
        Of ln e, and of ln of α and of p over those of the block.
    covariance : ndarray, shape (3, 3)
        Of these, for the specimen; a new test's ln e varies by `new_test` over `value` instead.
    """

    value: float
    low: float
    high: float
    standard_error: float
    between: float
    new_test: float
    tests: int
    mean: Array
    covariance: Array

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


def pool(
    values: ArrayLike,
    standard_errors: ArrayLike,
    *,
    level: float = 0.95,
    joints: Sequence[Joint] = (),
    known: tuple[float, float] = (0.0, 0.0),
) -> Pooled:
    """
    Pool the results of repeated tests.

    Parameters
    ----------
    values, standard_errors : array_like, shape (k,)
        e of each test and its standard error.
    level : float, optional
        Of the interval of confidence.
    joints : sequence of Joint, optional
        Of each test: what it says of e, α and p together; without them the errors of the tests are independent.
    known : (float, float), optional
        Standard deviations of ln α and ln p with which each of them was identified.

    Returns
    -------
    pooled : Pooled

    Notes
    -----
    The tests share α and p, not the gains of their set-ups: what each says of α and p is put together, and e of each is
    what it is with those; the error that α and p leave is common to all.

    Random effects: each test has its own error and all share a scatter τ between tests (Paule and Mandel 1982: τ² is
    where the weighted sum of squares equals its degrees of freedom). The interval takes the larger of the standard
    error from the weights and the one from the observed scatter (Hartung and Knapp 2001), with Student's t of k − 1;
    a single test keeps its normal interval.

    A new test's e scatters by less than those of the tests, which have errors of their own. Few tests do not show how
    much less: of k tests (k − 1) / (k − 1 + `PRIOR_FREEDOM`) of the variance of their own errors is taken off. Its 95 %
    range then holds 92 to 96 % of new tests, from 2 tests to 20, and 92 to 100 % if e does not scatter between them
    (reports/restitution-study.md).
    """
    e, error = np.asarray(values, dtype=np.float64), np.asarray(standard_errors, dtype=np.float64)
    z = float(scipy.special.ndtri((1 + level) / 2))
    if e.size == 1:
        value, standard_error = float(e[0]), float(error[0])
        mean, covariance = np.array([np.log(value), 0.0, 0.0]), np.diag([(standard_error / value) ** 2, 0.0, 0.0])
        if len(joints) == 1:
            mean, covariance = joints[0].mean, joints[0].covariance
        half = z * standard_error
        return Pooled(value, value - half, value + half, standard_error, 0.0, standard_error, 1, mean, covariance)
    mean, covariance, slopes = np.zeros(3), np.zeros((3, 3)), np.zeros((e.size, 2))
    if len(joints) == e.size:
        e, error, mean, covariance, slopes = _share(e, error, joints, np.array(known))
    # The scatter of e is the block's: a test that seems to know e far better than the others saw it by chance.
    error = np.maximum(error, LEAST_ERROR * np.median(error))
    freedom, between = e.size - 1, _between(e, error)
    weights = 1 / (error**2 + between)
    value, by_weights = float(np.average(e, weights=weights)), float(1 / np.sqrt(weights.sum()))
    reach = float(scipy.special.stdtrit(freedom, (1 + level) / 2))
    by_scatter = float(np.sqrt((weights * (e - value) ** 2).sum() / (freedom * weights.sum())))
    own = freedom / (freedom + PRIOR_FREEDOM) * float(np.average(error**2, weights=weights))
    # Tests that agree by chance: the range still holds a standard error of their mean.
    by_tests = float(np.sqrt(by_scatter**2 + max(e.size * by_scatter**2 - own, 0.0)))
    standard_error, new_test = max(by_weights, by_scatter), max(by_tests, by_weights / reach)
    slope = np.average(slopes, axis=0, weights=weights)
    common = max(float(slope @ covariance[1:, 1:] @ slope), 0.0) ** 0.5
    # The common error is a normal one, however few the tests are.
    half = float(np.hypot(reach * standard_error, z * common))
    covariance[0, 1:] = covariance[1:, 0] = covariance[1:, 1:] @ slope / value
    standard_error, new_test = float(np.hypot(standard_error, common)), float(np.hypot(new_test, common))
    mean[0], covariance[0, 0] = np.log(value), (standard_error / value) ** 2
    between = float(np.sqrt(between))
    return Pooled(value, value - half, value + half, standard_error, between, new_test, e.size, mean, covariance)


def _share(e: Array, error: Array, joints: Sequence[Joint], known: Array) -> tuple[Array, Array, Array, Array, Array]:
    """
    Put together what tests say of α and p.

    Returns e of each test and its error with those, mean and covariance as of `Pooled`, of which e is left out, and how
    e of each test depends on ln α and ln p, shape (k, 2).
    """
    mean, covariance = np.zeros(3), np.zeros((3, 3))
    means = np.array([joint.mean for joint in joints])
    covariances = np.array([joint.covariance for joint in joints])
    inverses = np.linalg.inv(covariances[:, 1:, 1:] + EXACT**2 * np.eye(2))
    beforehand = (e.size - 1) * np.diag(1 / (known**2 + EXACT**2))
    covariance[1:, 1:] = np.linalg.inv(inverses.sum(axis=0) - beforehand)
    mean[1:] = covariance[1:, 1:] @ np.einsum("tij,tj->i", inverses, means[:, 1:])
    slopes = np.einsum("tij,tj->ti", inverses, covariances[:, 1:, 0])
    alone = 1 - (slopes * covariances[:, 1:, 0]).sum(axis=1) / covariances[:, 0, 0]
    values = e * (1 + (slopes * (mean[1:] - means[:, 1:])).sum(axis=1))
    return values, error * np.maximum(alone, LEAST_ALONE) ** 0.5, mean, covariance, e[:, None] * slopes


def _between(e: Array, error: Array) -> float:
    """Variance of e between tests with which the weighted sum of squares equals its degrees of freedom."""

    def excess(variance: float) -> float:
        weights = 1 / (error**2 + variance)
        return float((weights * (e - np.average(e, weights=weights)) ** 2).sum()) - (e.size - 1)

    widest = float(np.ptp(e)) ** 2 * e.size
    return float(scipy.optimize.brentq(excess, 0.0, widest, xtol=1e-18)) if excess(0.0) > 0 else 0.0
