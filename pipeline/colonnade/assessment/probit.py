"""The binomial fit P = Φ(a + b y) on y = ln x, for many weightings of the records at once."""

from __future__ import annotations

from math import erfc, exp, log, pi, sqrt
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.assessment.outcomes import Cells
from colonnade.dynamics.kernel import kernel

STEPS, CLOSE = 50, 1e-10
FAR = 25.0
"""Beyond it the hazard of the normal distribution is given by its series."""

SURE = 1e-300
"""Below it a hazard belongs to a probability of 1, with a logarithm of 0."""


@kernel
def _hazard(z: float) -> float:
    """φ(z) / Φ(−z)."""
    if z > FAR:
        return z + 1.0 / z
    return sqrt(2.0 / pi) * exp(-0.5 * z * z) / erfc(z / sqrt(2.0))


@kernel
def _log_above(count: float, z: float, hazard: float) -> float:
    """So many times ln Φ(−z), of z with its hazard."""
    return -count * (0.5 * z * z + log(sqrt(2.0 * pi) * hazard)) if count > 0.0 and hazard > SURE else 0.0


@kernel
def _at(y: Array, events: Array, histories: Array, weights: Array, fit: Array) -> tuple[float, Array, Array, Array]:
    """Log-likelihood at (a, b), its score (2), its information (2, 2), and the records' squared scores (2, 2)."""
    likelihood, score, information, squares = 0.0, np.zeros(2), np.zeros((2, 2)), np.zeros((2, 2))
    own, by = np.zeros(2), np.ones(2)
    for r in range(y.shape[0]):
        own[:] = 0.0
        for m in range(y.shape[1] if weights[r] > 0.0 else 0):
            if histories[r, m] > 0.0:
                by[1] = y[r, m]
                z, left = fit[0] + fit[1] * y[r, m], histories[r, m] - events[r, m]
                up, down = _hazard(-z), _hazard(z)
                likelihood += weights[r] * (_log_above(events[r, m], -z, up) + _log_above(left, z, down))
                curved = weights[r] * (events[r, m] * up * (up + z) + left * down * (down - z))
                for i in range(2):
                    own[i] += by[i] * (events[r, m] * up - left * down)
                    for j in range(2):
                        information[i, j] += by[i] * by[j] * curved
        for i in range(2):
            score[i] += weights[r] * own[i]
            for j in range(2):
                squares[i, j] += weights[r] * own[i] * own[j]
    return likelihood, score, information, squares


@kernel
def fit_each(y: Array, events: Array, histories: Array, weights: Array) -> Array:
    """
    Fit P = Φ(a + b y) for each weighting of the records, shape (n, r), in all of which outcomes overlap.

    y is about 0 and of order 1; y, events and histories have the shape (r, m). Gives shape (n, 6): a, b, their
    covariance (aa, ab, bb) with records as the independent units (the sandwich of Huber 1967), log-likelihood.
    """
    fits = np.empty((weights.shape[0], 6))
    for n in range(weights.shape[0]):
        # Newton with halved steps: the log-likelihood is concave.
        fit, step, likelihood, inverse = np.zeros(2), np.zeros(2), -np.inf, np.eye(2)
        for _ in range(STEPS):
            tried, score, information, squares = _at(y, events, histories, weights[n], fit + step)
            if not tried >= likelihood:
                step *= 0.5
                continue
            fit, likelihood = fit + step, tried
            turned = np.array([[information[1, 1], -information[0, 1]], [-information[0, 1], information[0, 0]]])
            inverse = turned / (information[0, 0] * information[1, 1] - information[0, 1] ** 2)
            step = inverse @ score
            if np.abs(step).sum() < CLOSE * (1.0 + np.abs(fit).sum()):
                break
        covariance = inverse @ squares @ inverse
        fits[n, :2], fits[n, 5] = fit + step, likelihood
        fits[n, 2], fits[n, 3], fits[n, 4] = covariance[0, 0], covariance[0, 1], covariance[1, 1]
    return fits


class Parameters(NamedTuple):
    """ln median and ln β, and their covariance (mm, mb, bb), each of shape (n,)."""

    log_median: Array
    log_beta: Array
    mm: Array
    mb: Array
    bb: Array


def fit_parameters(cells: Cells, weights: Array) -> tuple[Parameters, Array, NDArray[np.str_]]:
    """
    Fit each weighting of the records.

    Parameters
    ----------
    cells : Cells
    weights : ndarray, shape (n, r)

    Returns
    -------
    parameters : Parameters
        NaN if there is no curve that rises.
    log_likelihood : ndarray, shape (n,)
        If there is no curve its limit.
    reason : ndarray of str, shape (n,)
        Why there is no curve that rises: as of `assessment.curves.LognormalFit`; empty if there is one.
    """
    counted = cells.histories > 0
    centre = float(cells.log_intensity[counted].mean())
    width = float(cells.log_intensity[counted].std()) or 1.0
    y = (cells.log_intensity - centre) / width
    happened, survived = cells.events > 0, cells.events < cells.histories
    # Of each weighting: the lowest y with an event, the highest with a survivor, and the ends.
    drawn = weights > 0
    first, low = (np.where(drawn, _lowest(y, each), np.inf).min(axis=1) for each in (happened, counted))
    last, high = (np.where(drawn, -_lowest(-y, each), -np.inf).max(axis=1) for each in (survived, counted))
    whys = ("always", "never", "one intensity", "separated")
    reason = np.select([np.isinf(last), np.isinf(first), low == high, last <= first], whys, "")
    overlap = reason == ""
    fits = np.full((len(weights), 6), np.nan)
    fits[overlap] = fit_each(y, cells.events, cells.histories, weights[overlap])
    fits[~overlap, 5] = _at_one_intensity(y, cells, weights, first)[~overlap]
    reason[fits[:, 1] <= 0.0] = "falling"
    a, b, aa, ab, bb, log_likelihood = np.where((reason == "") | (np.arange(6) == 5)[:, None], fits.T, np.nan)
    middle = -a / b
    return (
        Parameters(
            centre + width * middle,
            np.log(width / b),
            width**2 * (aa + 2 * middle * ab + middle**2 * bb) / b**2,
            width * (ab + middle * bb) / b**2,
            bb / b**2,
        ),
        log_likelihood,
        reason,
    )


def _lowest(y: Array, chosen: Mask) -> Array:
    """Lowest chosen y of each record, infinite without one."""
    return np.asarray(np.where(chosen, y, np.inf).min(axis=1))


def _at_one_intensity(y: Array, cells: Cells, weights: Array, at: Array) -> Array:
    """Limit of the log-likelihood: of the outcomes at the one intensity of each weighting that may have both."""
    found = np.zeros(len(weights))
    for place in np.unique(at[np.isfinite(at)]):
        events, histories = (weights @ np.where(y == place, each, 0.0).sum(axis=1) for each in cells[1:])
        left = histories - events
        both = scipy.special.xlogy(events, events) + scipy.special.xlogy(left, left)
        found = np.where(at == place, both - scipy.special.xlogy(histories, histories), found)
    return found
