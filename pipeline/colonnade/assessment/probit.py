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


@kernel
def _hazard(z: float) -> float:
    """φ(z) / Φ(−z)."""
    if z > FAR:
        return z + 1.0 / z
    return sqrt(2.0 / pi) * exp(-0.5 * z * z) / erfc(z / sqrt(2.0))


@kernel
def _log_below(z: float) -> float:
    """ln Φ(z)."""
    if z < -FAR:
        return -0.5 * z * z - log(-z * sqrt(2.0 * pi))
    return log(0.5 * erfc(-z / sqrt(2.0)))


@kernel
def _at(y: Array, events: Array, histories: Array, weights: Array, a: float, b: float) -> Array:
    """Log-likelihood, its score (2), information (3: aa, ab, bb) and the records' squared scores (3), in one row."""
    found = np.zeros(9)
    for r in range(y.shape[0]):
        if weights[r] > 0.0:
            one, two = 0.0, 0.0
            for m in range(y.shape[1]):
                if histories[r, m] > 0.0:
                    z = a + b * y[r, m]
                    left = histories[r, m] - events[r, m]
                    if events[r, m] > 0.0:
                        found[0] += weights[r] * events[r, m] * _log_below(z)
                    if left > 0.0:
                        found[0] += weights[r] * left * _log_below(-z)
                    up, down = _hazard(-z), _hazard(z)
                    slope = events[r, m] * up - left * down
                    curved = events[r, m] * up * (up + z) + left * down * (down - z)
                    one += slope
                    two += slope * y[r, m]
                    found[3] += weights[r] * curved
                    found[4] += weights[r] * curved * y[r, m]
                    found[5] += weights[r] * curved * y[r, m] ** 2
            found[1] += weights[r] * one
            found[2] += weights[r] * two
            found[6] += weights[r] * one * one
            found[7] += weights[r] * one * two
            found[8] += weights[r] * two * two
    return found


@kernel
def _maximise(y: Array, events: Array, histories: Array, weights: Array) -> tuple[float, float, Array]:
    """Newton with halved steps: the log-likelihood is concave."""
    a, b = 0.0, 0.0
    d = _at(y, events, histories, weights, a, b)
    for _ in range(STEPS):
        whole = d[3] * d[5] - d[4] * d[4]
        da, db = (d[5] * d[1] - d[4] * d[2]) / whole, (d[3] * d[2] - d[4] * d[1]) / whole
        step = 1.0
        tried = _at(y, events, histories, weights, a + da, b + db)
        while not tried[0] >= d[0]:
            step *= 0.5
            if step <= 1e-6:
                return a, b, d
            tried = _at(y, events, histories, weights, a + step * da, b + step * db)
        a, b, d = a + step * da, b + step * db, tried
        if abs(step * da) + abs(step * db) < CLOSE * (1.0 + abs(a) + abs(b)):
            break
    return a, b, d


@kernel
def fit_each(y: Array, events: Array, histories: Array, weights: Array) -> Array:
    """
    Fit P = Φ(a + b y) for each weighting of the records, shape (n, r), in all of which outcomes overlap.

    y is about 0 and of order 1; y, events and histories have the shape (r, m). Gives shape (n, 6): a, b, their
    covariance (aa, ab, bb) with records as the independent units (the sandwich of Huber 1967), log-likelihood.
    """
    fits = np.empty((weights.shape[0], 6))
    for n in range(weights.shape[0]):
        a, b, d = _maximise(y, events, histories, weights[n])
        whole = d[3] * d[5] - d[4] * d[4]
        aa, ab, bb = d[5] / whole, -d[4] / whole, d[3] / whole
        fits[n, 0], fits[n, 1], fits[n, 5] = a, b, d[0]
        fits[n, 2] = aa * aa * d[6] + 2.0 * aa * ab * d[7] + ab * ab * d[8]
        fits[n, 3] = aa * ab * d[6] + (aa * bb + ab * ab) * d[7] + ab * bb * d[8]
        fits[n, 4] = ab * ab * d[6] + 2.0 * ab * bb * d[7] + bb * bb * d[8]
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
        Why there is no curve that rises: a `Reason` of `assessment.curves`; empty if there is one.
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
