"""Whether e needs another free vibration and from which angle, and the Span of which the outcome is least certain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.identification.restitution.pooling import Pooled, pool

USUAL_SCATTER = 0.001
"""Scatter of e between tests before any is seen, weighed as one test: the last digit with which e is given."""

LAST_PEAK = 0.05
"""|θ|/α of the last peak that an identification is expected to use; smaller ones are little above noise."""

FARTHEST = 20
"""Tests ahead that are looked at."""

DECIDED = 0.3
"""bit: entropy of an outcome that is predicted with a probability of 95 %; less is not worth a test."""


@dataclass(frozen=True)
class RestitutionAdvice:
    """
    Whether another free vibration is needed, with the reason.

    Attributes
    ----------
    pooled : Pooled
        e of the tests so far.
    is_enough : bool
        Whether the half-width of its interval is as small as wanted. Never by one test: it does not show the scatter
        between tests.
    half_width : float
        Of the interval now.
    predicted_half_width : ndarray, shape (FARTHEST,)
        Of the interval after 1, 2, … more tests from the largest release.
    needed : int or None
        More tests until it is as small as wanted; 0 if it is, None if more than `FARTHEST`.
    """

    pooled: Pooled
    is_enough: bool
    half_width: float
    predicted_half_width: Array
    needed: int | None


def advise_free_vibration(
    restitution: ArrayLike,
    standard_error: ArrayLike,
    release_ratio: ArrayLike,
    *,
    wanted_half_width: float,
    largest_release: float,
    level: float = 0.95,
) -> RestitutionAdvice:
    """
    Advise whether to run another free vibration.

    Parameters
    ----------
    restitution, standard_error, release_ratio : array_like, shape (k,)
        e of each test, its standard error, and |θ|/α of its release, above `LAST_PEAK` and below 1.
    wanted_half_width : float
        Of the interval of the pooled e.
    largest_release : float
        |θ|/α from which the next test is released.
    level : float, optional
        Of the interval.

    Notes
    -----
    After n more tests the interval is that of `pool`: Student's t of k + n − 1 times the standard error from the
    weights 1/(s² + τ²). τ² is that of the tests with `USUAL_SCATTER` as one more degree of freedom, since two or three
    tests hardly show it. The error s of a new test follows those of the tests so far: the slope of ln energy over N
    impacts has an error ∝ N^(−3/2), and from a release r down to `LAST_PEAK` there are N ∝ ln of the ratio of their
    energies 1 − (1 − r)² (Housner 1963).

    Examples
    --------
    >>> advice = advise_free_vibration(
    ...     [0.9755, 0.9761, 0.9758], [3e-4, 3e-4, 3e-4], [0.6, 0.5, 0.7], wanted_half_width=0.001, largest_release=0.7
    ... )
    >>> advice.is_enough, advice.needed
    (True, 0)
    """
    error, release = np.asarray(standard_error, dtype=np.float64), np.asarray(release_ratio, dtype=np.float64)
    pooled = pool(restitution, error, level=level)
    test_error = float(np.median(error * (_impacts(release) / _impacts(largest_release)) ** 1.5))
    scatter = float(np.sqrt(((error.size - 1) * pooled.between**2 + USUAL_SCATTER**2) / error.size))
    more = np.arange(1, FARTHEST + 1)
    weights = (1 / (error**2 + scatter**2)).sum() + more / (test_error**2 + scatter**2)
    predicted = scipy.special.stdtrit(error.size + more - 1, (1 + level) / 2) / np.sqrt(weights)
    half_width = (pooled.high - pooled.low) / 2
    is_enough = error.size > 1 and half_width <= wanted_half_width
    reached = more[predicted <= wanted_half_width]
    needed = 0 if is_enough else int(reached[0]) if reached.size else None
    return RestitutionAdvice(pooled, is_enough, half_width, predicted, needed)


def _impacts(release: ArrayLike) -> Array:
    """Number of impacts from a release down to `LAST_PEAK`, over that which halves the energy e times."""
    energy, last = 1 - (1 - np.asarray(release, dtype=np.float64)) ** 2, 1 - (1 - LAST_PEAK) ** 2
    return np.asarray(np.log(energy / last))


@dataclass(frozen=True)
class SpanAdvice:
    """
    The next Span of an earthquake, with its reason.

    Attributes
    ----------
    span : float
    probabilities : tuple of float
        Of no rocking, rocking and overturning at this Span.
    entropy : float
        bit, of its outcome; at most log2 3 = 1.58.
    is_enough : bool
        Whether the outcomes of all Spans within the risk are predicted with such certainty that none is worth a test.
    is_step : bool
        Whether all outcomes are certain and the specimen stands throughout: the last Span is advised, as a step to
        where it may fall.
    """

    span: float
    probabilities: tuple[float, float, float]
    entropy: float
    is_enough: bool
    is_step: bool


def advise_span(span: Sequence[float], rocking: Array, overturning: Array, *, largest_risk: float) -> SpanAdvice:
    """
    Advise the Span of which the outcome is least certain.

    Parameters
    ----------
    span : sequence of float, length n
        Candidates, increasing.
    rocking, overturning : ndarray, shape (n,)
        Probabilities of the outcomes `rocking` and `overturned` at each, as an ensemble gives them.
    largest_risk : float
        Largest predicted probability that the specimen overturns.

    Notes
    -----
    The entropy of the outcome is what observing it is expected to say about everything that it depends on, since the
    outcome follows from the inputs of the ensemble (Lindley 1956). Of equal Spans the smaller is advised.

    Examples
    --------
    >>> advise_span([2.0, 2.5, 3.0], np.array([1.0, 0.9, 0.5]), np.array([0.0, 0.1, 0.5]), largest_risk=1.0).span
    3.0
    """
    outcomes: Array = np.stack([np.maximum(1 - rocking - overturning, 0.0), rocking, overturning])
    entropy = scipy.special.entr(outcomes).sum(axis=0) / log(2)
    allowed = overturning <= largest_risk
    # Where every Span is too risky, that with the least risk.
    best = int(np.argmax(np.where(allowed, entropy, -1.0))) if allowed.any() else int(np.argmin(overturning))
    is_decided = bool(allowed.any() and entropy[best] < DECIDED)
    is_step = is_decided and bool(overturning[-1] < min(largest_risk, 0.5))
    if is_step:
        best = len(span) - 1
    still, rocked, fell = outcomes[:, best].tolist()
    return SpanAdvice(span[best], (still, rocked, fell), float(entropy[best]), is_decided and not is_step, is_step)
