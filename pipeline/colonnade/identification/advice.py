"""Whether e needs another free vibration and from which angle, and the Span of which the outcome is least certain."""

from __future__ import annotations

from dataclasses import dataclass
from math import log
from typing import Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.identification.restitution.pooling import Pooled, pool
from colonnade.validation import number, samples

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
    release_ratio : float
        θ/α from which to release the next test, signed: the largest allowed, to the side that has fewer tests.
    predicted_half_width : ndarray, shape (FARTHEST,)
        Of the interval after 1, 2, … more tests like that.
    needed : int or None
        More tests until it is as small as wanted; 0 if it is, None if more than `FARTHEST`.
    test_error, scatter : float
        Expected standard error of the next test by itself; scatter between tests that is reckoned with.
    limited_by : {"test", "scatter"}
        The larger of the two. By scatter, better single tests do not help: only more of them do.
    """

    pooled: Pooled
    is_enough: bool
    half_width: float
    release_ratio: float
    predicted_half_width: Array
    needed: int | None
    test_error: float
    scatter: float
    limited_by: Literal["test", "scatter"]


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
        e of each test, its standard error, and θ/α of its release, signed.
    wanted_half_width : float
        Of the interval of the pooled e.
    largest_release : float
        Largest |θ|/α from which a specimen may be released, below 1.
    level : float, optional
        Of the interval.

    Raises
    ------
    ValueError
        If there is no test, or an argument is out of its range.

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
    ...     [0.9755, 0.9761, 0.9758], [3e-4, 3e-4, 3e-4], [0.6, -0.5, 0.7], wanted_half_width=0.001, largest_release=0.7
    ... )
    >>> advice.is_enough, advice.needed, advice.release_ratio, advice.limited_by
    (True, 0, -0.7, 'scatter')
    """
    e, error = samples("restitution", restitution), samples("standard_error", standard_error)
    release = samples("release_ratio", release_ratio)
    wanted = number("wanted_half_width", wanted_half_width, "a positive half-width of e", above=0.0)
    largest = number(
        "largest_release", largest_release, f"|θ|/α from {2 * LAST_PEAK:g} to 1", low=2 * LAST_PEAK, below=1.0
    )
    number("level", level, "a probability between 0 and 1", above=0.0, below=1.0)
    if release.shape != e.shape:
        raise ValueError(f"release_ratio has shape {release.shape}; one a test, {e.shape}, was expected")
    if not ((np.abs(release) > LAST_PEAK) & (np.abs(release) < 1.0)).all():
        raise ValueError(f"release_ratio has to be between {LAST_PEAK:g} and 1 in magnitude throughout")
    pooled = pool(e, error, level=level)

    test_error = float(np.median(error * (_impacts(np.abs(release)) / _impacts(np.array(largest))) ** 1.5))
    scatter = float(np.sqrt(((e.size - 1) * pooled.between**2 + USUAL_SCATTER**2) / e.size))
    more = np.arange(1, FARTHEST + 1)
    weights = (1 / (error**2 + scatter**2)).sum() + more / (test_error**2 + scatter**2)
    predicted = scipy.special.stdtrit(e.size + more - 1, (1 + level) / 2) / np.sqrt(weights)

    half_width = (pooled.high - pooled.low) / 2
    is_enough = e.size > 1 and half_width <= wanted
    reached = np.flatnonzero(predicted <= wanted)
    return RestitutionAdvice(
        pooled,
        is_enough,
        half_width,
        -largest if (release > 0).sum() > (release < 0).sum() else largest,
        predicted,
        0 if is_enough else int(more[reached[0]]) if reached.size else None,
        test_error,
        scatter,
        "scatter" if scatter > test_error else "test",
    )


def _impacts(release: Array) -> Array:
    """Number of impacts from a release down to `LAST_PEAK`, over that which halves the energy e times."""
    energy, last = 1 - (1 - release) ** 2, 1 - (1 - LAST_PEAK) ** 2
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
    is_within_risk : bool
        Whether any Span is within the risk; if not, the advised one has the least.
    is_step : bool
        Whether all outcomes are certain and the specimen stands throughout: the last Span is advised, as a step to
        where it may fall.
    """

    span: float
    probabilities: tuple[float, float, float]
    entropy: float
    is_enough: bool
    is_within_risk: bool
    is_step: bool


def advise_span(span: ArrayLike, rocking: ArrayLike, overturning: ArrayLike, *, largest_risk: float) -> SpanAdvice:
    """
    Advise the Span of which the outcome is least certain.

    Parameters
    ----------
    span : array_like, shape (n,)
        Candidates, increasing.
    rocking, overturning : array_like, shape (n,)
        Probabilities of the outcomes `rocking` and `overturned` at each, as an ensemble gives them.
    largest_risk : float
        Largest predicted probability that the specimen overturns.

    Raises
    ------
    ValueError
        If Spans do not increase, or the probabilities are none.

    Notes
    -----
    The entropy of the outcome is what observing it is expected to say about everything that it depends on, since the
    outcome follows from the inputs of the ensemble (Lindley 1956). Of equal Spans the smaller is advised.

    Examples
    --------
    >>> advise_span([2.0, 2.5, 3.0], [1.0, 0.9, 0.5], [0.0, 0.1, 0.5], largest_risk=1.0).span
    3.0
    """
    spans, rocks, falls = samples("span", span), samples("rocking", rocking), samples("overturning", overturning)
    risk = number("largest_risk", largest_risk, "a probability above 0 and at most 1", above=0.0, high=1.0)
    if not (rocks.shape == falls.shape == spans.shape):
        raise ValueError(
            f"rocking has shape {rocks.shape} and overturning {falls.shape}; one for each Span, {spans.shape}, "
            "was expected"
        )
    if not (np.diff(spans) > 0).all():
        raise ValueError("span has to increase")
    if (rocks < 0).any() or (falls < 0).any() or (rocks + falls > 1 + 1e-9).any():
        raise ValueError("rocking and overturning have to be probabilities whose sum is at most 1")
    outcomes: Array = np.stack([np.maximum(1 - rocks - falls, 0.0), rocks, falls])
    entropy = scipy.special.entr(outcomes).sum(axis=0) / log(2)
    allowed = falls <= risk
    best = int(np.argmax(np.where(allowed, entropy, -1.0))) if allowed.any() else int(np.argmin(falls))
    is_within_risk = bool(allowed.any())
    is_decided = is_within_risk and bool(entropy[best] < DECIDED)
    is_step = is_decided and bool(falls[-1] < min(risk, 0.5))
    if is_step:
        best = spans.size - 1
    still, rocked, fell = (float(each) for each in outcomes[:, best])
    is_enough = is_decided and not is_step
    return SpanAdvice(
        float(spans[best]), (still, rocked, fell), float(entropy[best]), is_enough, is_within_risk, is_step
    )
