"""Regression of ln peak on ln intensity, of the histories that rocked and did not overturn."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.assessment.fragility.outcomes import Outcomes


def scatter(outcomes: Outcomes, intensity: Array, weights: Array) -> Array:
    """
    Give the standard deviation of ln peak about its regression on ln intensity.

    Parameters
    ----------
    outcomes : Outcomes
    intensity : ndarray, shape (r, l, 1) or (r, l, c)
    weights : ndarray, shape (n, r)
        Of the records.

    Returns
    -------
    scatter : ndarray, shape (n,)
        NaN of fewer than three histories.
    """
    count, _, _, left = _regressed(outcomes, intensity, weights)
    return np.asarray(np.sqrt(np.maximum(left, 0.0) / np.where(count > 2, count - 2, np.nan)))


def residuals(outcomes: Outcomes, intensity: Array) -> Array:
    """Give each record's mean residual of ln peak, shape (r,); NaN of records without a history that counts."""
    _, offset, slope, _ = _regressed(outcomes, intensity, np.ones((1, len(outcomes.records))))
    x, y, counts = _histories(outcomes, intensity)
    count = counts.sum(axis=(1, 2, 3))
    left = np.where(counts, y - offset - slope * x, 0.0).sum(axis=(1, 2, 3))
    return np.asarray(left / np.where(count > 0, count, np.nan))


def _regressed(outcomes: Outcomes, intensity: Array, weights: Array) -> tuple[Array, Array, Array, Array]:
    """Histories, offset, slope and sum of squared residuals of each weighting, shape (n,) each."""
    x, y, counts = _histories(outcomes, intensity)
    centre = x[counts].mean() if counts.any() else 0.0
    height = y[counts].mean() if counts.any() else 0.0
    x, y = np.where(counts, x - centre, 0.0), np.where(counts, y - height, 0.0)
    sums = [weights @ each.sum(axis=(1, 2, 3)) for each in (counts.astype(np.float64), x, y, x * x, x * y, y * y)]
    count, one_x, one_y, xx, xy, yy = sums
    some = np.where(count > 0, count, np.nan)
    xx, xy, yy = xx - one_x**2 / some, xy - one_x * one_y / some, yy - one_y**2 / some
    # A measure that is the same for all explains nothing.
    slope = np.where(xx > 1e-12 * some, xy / np.where(xx > 0, xx, 1.0), 0.0)
    offset = (one_y - slope * one_x) / some + height - slope * centre
    return count, offset, slope, yy - slope * xy


def _histories(outcomes: Outcomes, intensity: Array) -> tuple[Array, Array, Mask]:
    """ln intensity, ln peak, and which histories count."""
    counts = outcomes.was_run & (outcomes.peak > 0) & ~outcomes.overturned
    y = np.log(np.where(counts, outcomes.peak, 1.0))
    return np.broadcast_to(np.log(intensity)[:, :, None, :], y.shape), y, counts
