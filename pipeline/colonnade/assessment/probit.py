"""The binomial fit P = Φ(a + b y) on y = ln x, for many weightings of the records at once."""

from __future__ import annotations

from math import erfc, exp, log, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.assessment.outcomes import Cells
from colonnade.dynamics.kernel import kernel

FITTED, SEPARATED, FALLING, ONE_OUTCOME, ONE_INTENSITY = 0, 1, 2, 3, 4
"""Status of a fit: only the first has a finite median and β > 0."""

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
def _status(y: Array, events: Array, histories: Array, weights: Array) -> tuple[int, float, float]:
    """Whether outcomes overlap, the highest y with a survivor, and the lowest with an event."""
    survived, happened, low, high = -np.inf, np.inf, np.inf, -np.inf
    for r in range(y.shape[0]):
        if weights[r] > 0.0:
            for m in range(y.shape[1]):
                if histories[r, m] > 0.0:
                    low, high = min(low, y[r, m]), max(high, y[r, m])
                    if events[r, m] < histories[r, m]:
                        survived = max(survived, y[r, m])
                    if events[r, m] > 0.0:
                        happened = min(happened, y[r, m])
    if survived == -np.inf or happened == np.inf:
        return ONE_OUTCOME, survived, happened
    if low == high:
        return ONE_INTENSITY, survived, happened
    if survived <= happened:
        return SEPARATED, survived, happened
    return FITTED, survived, happened


@kernel
def _likelihood(y: Array, events: Array, histories: Array, weights: Array, a: float, b: float) -> float:
    total = 0.0
    for r in range(y.shape[0]):
        if weights[r] > 0.0:
            for m in range(y.shape[1]):
                if histories[r, m] > 0.0:
                    z = a + b * y[r, m]
                    if events[r, m] > 0.0:
                        total += weights[r] * events[r, m] * _log_below(z)
                    if events[r, m] < histories[r, m]:
                        total += weights[r] * (histories[r, m] - events[r, m]) * _log_below(-z)
    return total


@kernel
def _derivatives(y: Array, events: Array, histories: Array, weights: Array, a: float, b: float) -> Array:
    """Score (2), information (3: aa, ab, bb) and the records' squared scores (3) of the log-likelihood, in one row."""
    found = np.zeros(8)
    for r in range(y.shape[0]):
        if weights[r] > 0.0:
            one, two = 0.0, 0.0
            for m in range(y.shape[1]):
                if histories[r, m] > 0.0:
                    z = a + b * y[r, m]
                    up, down = _hazard(-z), _hazard(z)
                    left = histories[r, m] - events[r, m]
                    slope = events[r, m] * up - left * down
                    curved = events[r, m] * up * (up + z) + left * down * (down - z)
                    one += slope
                    two += slope * y[r, m]
                    found[2] += weights[r] * curved
                    found[3] += weights[r] * curved * y[r, m]
                    found[4] += weights[r] * curved * y[r, m] ** 2
            found[0] += weights[r] * one
            found[1] += weights[r] * two
            found[5] += weights[r] * one * one
            found[6] += weights[r] * one * two
            found[7] += weights[r] * two * two
    return found


@kernel
def _maximise(y: Array, events: Array, histories: Array, weights: Array) -> tuple[float, float, float]:
    """Newton with halved steps: the log-likelihood is concave."""
    a, b = 0.0, 0.0
    best = _likelihood(y, events, histories, weights, a, b)
    for _ in range(STEPS):
        d = _derivatives(y, events, histories, weights, a, b)
        whole = d[2] * d[4] - d[3] * d[3]
        da, db = (d[4] * d[0] - d[3] * d[1]) / whole, (d[2] * d[1] - d[3] * d[0]) / whole
        step, tried = 1.0, -np.inf
        while step > 1e-6:
            tried = _likelihood(y, events, histories, weights, a + step * da, b + step * db)
            if tried >= best:
                break
            step *= 0.5
        if step <= 1e-6:
            break
        a, b, best = a + step * da, b + step * db, tried
        if abs(step * da) + abs(step * db) < CLOSE * (1.0 + abs(a) + abs(b)):
            break
    return a, b, best


@kernel
def fit_each(y: Array, events: Array, histories: Array, weights: Array) -> tuple[Array, NDArray[np.int64]]:
    """
    Fit P = Φ(a + b y) for each weighting of the records.

    Parameters
    ----------
    y, events, histories : ndarray, shape (r, m)
        y about 0 and of order 1.
    weights : ndarray, shape (n, r)

    Returns
    -------
    fits : ndarray, shape (n, 6)
        a, b, their covariance (aa, ab, bb) with records as the independent units (the sandwich of Huber 1967),
        log-likelihood.
    status : ndarray of int, shape (n,)
        If separated, the log-likelihood is its limit and the rest NaN.
    """
    fits, status = np.full((weights.shape[0], 6), np.nan), np.zeros(weights.shape[0], dtype=np.int64)
    for n in range(weights.shape[0]):
        found, survived, happened = _status(y, events, histories, weights[n])
        status[n] = found
        if found == FITTED:
            a, b, best = _maximise(y, events, histories, weights[n])
            d = _derivatives(y, events, histories, weights[n], a, b)
            whole = d[2] * d[4] - d[3] * d[3]
            aa, ab, bb = d[4] / whole, -d[3] / whole, d[2] / whole
            fits[n, 0], fits[n, 1], fits[n, 5] = a, b, best
            fits[n, 2] = aa * aa * d[5] + 2.0 * aa * ab * d[6] + ab * ab * d[7]
            fits[n, 3] = aa * ab * d[5] + (aa * bb + ab * ab) * d[6] + ab * bb * d[7]
            fits[n, 4] = ab * ab * d[5] + 2.0 * ab * bb * d[6] + bb * bb * d[7]
            if b <= 0.0:
                status[n] = FALLING
        else:
            fits[n, 5] = _at_one_intensity(y, events, histories, weights[n], survived, happened)
    return fits, status


@kernel
def _at_one_intensity(
    y: Array, events: Array, histories: Array, weights: Array, survived: float, happened: float
) -> float:
    """Log-likelihood of the outcomes that share the one intensity with both; 0 if there is none."""
    happens, all_of = 0.0, 0.0
    if survived == happened:
        for r in range(y.shape[0]):
            for m in range(y.shape[1]):
                if y[r, m] == survived:
                    happens += weights[r] * events[r, m]
                    all_of += weights[r] * histories[r, m]
    if happens == 0.0 or happens == all_of:
        return 0.0
    return happens * log(happens / all_of) + (all_of - happens) * log(1.0 - happens / all_of)


class Parameters(NamedTuple):
    """ln median and ln β, and their covariance (mm, mb, bb), each of shape (n,)."""

    log_median: Array
    log_beta: Array
    mm: Array
    mb: Array
    bb: Array


def fit_parameters(cells: Cells, weights: Array) -> tuple[Parameters, Array, NDArray[np.int64]]:
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
    log_likelihood, status : ndarray, shape (n,)
        As of `fit_each`.
    """
    counted = cells.histories > 0
    centre = float(cells.log_intensity[counted].mean())
    width = float(cells.log_intensity[counted].std()) or 1.0
    fits, status = fit_each((cells.log_intensity - centre) / width, cells.events, cells.histories, weights)
    a, b, aa, ab, bb, log_likelihood = np.where((status == FITTED) | (np.arange(6) == 5)[:, None], fits.T, np.nan)
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
        status,
    )
