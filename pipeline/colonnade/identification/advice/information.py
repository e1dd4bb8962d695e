"""How much the outcome of a test is expected to say about a boundary."""

from __future__ import annotations

from math import log

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.identification.advice.prior import Grid

NEGLIGIBLE = 1e-4
"""Probability of the posterior's ends, beyond which no test is considered."""


def expected_information(grid: Grid, weight: Array, candidates: Array) -> tuple[Array, Array]:
    """
    Expected fall of the entropy of a boundary's posterior by one test, and the risk that the test overturns.

    Parameters
    ----------
    grid : Grid
    weight : ndarray, shape (n, w)
        Probability of each offset and σ.
    candidates : ndarray of int, shape (c,)
        Indices of offsets, as amplitudes.

    Returns
    -------
    information, risk : ndarray, shape (c,)
        bit; probability.

    Notes
    -----
    The mutual information of the outcome and the boundary alone, σ being summed out first (Lindley 1956; Chaloner and
    Verdinelli 1995, sec. 3): the entropy of the predicted outcome less its mean entropy given the boundary, which is
    how Houlsby et al. (2011) compute it. It needs no posterior of outcomes that have not happened.
    """
    offset_weight = weight.sum(axis=1)
    likely = np.flatnonzero(offset_weight > 1e-9 * offset_weight.max())
    held = slice(int(likely[0]), int(likely[-1]) + 1)
    own, total = weight[held], offset_weight[held]
    overturning = np.einsum("cnw,nw->cn", grid.chances[candidates, held], own)
    risk = overturning.sum(axis=1) / total.sum()
    given = overturning / np.maximum(total, np.finfo(float).tiny)
    return (outcome_entropy(risk) - outcome_entropy(given) @ (total / total.sum())), risk


def candidates_of(grid: Grid, weight: Array) -> Array:
    """Indices of the amplitudes at which a test can say anything: where the boundary may be."""
    below = np.cumsum(weight.sum(axis=1))
    first, last = np.searchsorted(below / below[-1], [NEGLIGIBLE, 1.0 - NEGLIGIBLE])
    return np.arange(first, min(int(last) + 1, grid.offset.size))


def outcome_entropy(probability: Array) -> Array:
    """Entropy of an outcome that happens with a probability, or does not, bit."""
    entropy: Array = (scipy.special.entr(probability) + scipy.special.entr(1.0 - probability)) / log(2.0)
    return entropy
