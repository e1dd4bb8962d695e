"""Advice on earthquakes: the Span whose outcome is least certain."""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.validation import number, samples

DECIDED = 0.3
"""bit: entropy of an outcome that is predicted with a probability of 95 %; less is not worth a test."""


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
