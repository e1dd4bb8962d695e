"""β of the records and β of the parameters, apart: draws are nested in records."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.assessment.intervals import (
    Band,
    Interval,
    Resampling,
    shows_spread,
    studentised,
)
from colonnade.assessment.outcomes import Outcomes, by_intensity

NODES = np.linspace(-6.0, 6.0, 401)
"""Of the records' standardised departure, over which the likelihood is integrated."""

SMALLEST = 1e-3
"""β below which draws, or records, do not differ."""

STEP = 1e-3
"""Of numerical derivatives: of the variances, and of the total β for ln median."""

Reason = Literal["", "one draw", "no overlap", "parameters alike", "records alike"]


@dataclass(frozen=True)
class Betas:
    """
    Scatter of ln capacity.

    Attributes
    ----------
    reason : str
        Empty if both are known. Else: a single draw, too few capacities between levels, or one of the two is below
        `SMALLEST`.
    records : Interval
        From one motion to the next: record and direction. NaN if not known.
    parameters : Interval
        From one draw to the next within a motion. NaN if not known.
    level : float
    """

    reason: Reason
    records: Interval
    parameters: Interval
    level: float


def separate_betas(outcomes: Outcomes, resampling: Resampling) -> Betas:
    """
    Separate the scatter between records from that between draws.

    Parameters
    ----------
    outcomes : Outcomes
        Each record with draws of its own.
    resampling : Resampling

    Returns
    -------
    betas : Betas

    Notes
    -----
    ln capacity = ln median + β_records R + β_parameters D, R and D standard normal, R one for each motion, D one for
    each of its draws: variance components of a nested design (Searle, Casella and McCulloch 1992, ch. 3). A capacity
    is known to lie between two levels; it is the lowest that overturns, so that the two make up the β of the curve only
    without resurrections. Maximum likelihood with R integrated out. The intervals are studentised, over resamples of
    records. A resample moves the two variances by the mean influence of its records (one Newton step, Davidson and
    MacKinnon 1999), which is nearly exact: they are nearly means.
    """
    level = resampling.level
    pairs, counts, record = _capacities(outcomes)
    unknown = Interval(np.nan, np.nan, np.nan)
    if outcomes.peak.shape[2] == 1:
        return Betas("one draw", unknown, unknown, level)
    if np.isfinite(pairs[counts.sum(axis=0) > 0]).all(axis=1).sum() < 1:
        return Betas("no overlap", unknown, unknown, level)
    estimate = _estimate(pairs, counts)
    alike = np.exp(estimate[1:]) < SMALLEST
    if alike.any():
        return Betas("records alike" if alike[0] else "parameters alike", unknown, unknown, level)
    band = _band(pairs, counts, record, estimate, resampling.weights(len(outcomes.records)), level)
    records, parameters = (Interval(*(float(each[part]) for each in band)) for part in (0, 1))
    return Betas("", records, parameters, level)


def _capacities(outcomes: Outcomes) -> tuple[Array, Array, NDArray[np.intp]]:
    """Intervals of ln capacity (u, 2), how many draws of each motion are in each (motions, u), record of a motion."""
    intensity, over, was_run = by_intensity(outcomes)
    y = np.log(np.where(was_run, intensity, 1.0))
    high = np.where(over, y, np.inf).min(axis=1)
    stood = was_run & ~over & (y < high[:, None])
    low = np.where(stood, y, -np.inf).max(axis=1)
    rows, draws, directions = high.shape
    flat = np.stack((low, high), axis=-1).transpose(0, 2, 1, 3).reshape(-1, 2)
    pairs, place = np.unique(np.round(flat, 9), axis=0, return_inverse=True)
    counts = np.zeros((rows * directions, len(pairs)))
    np.add.at(counts, (np.repeat(np.arange(rows * directions), draws), place.ravel()), 1.0)
    return pairs, counts, np.repeat(np.arange(rows), directions)


def _log_likelihood(pairs: Array, counts: Array, at: Array) -> Array:
    """Of each motion, at ln median, ln β of records, ln β of parameters."""
    edges = (pairs[:, :, None] - at[0] - np.exp(at[1]) * NODES) / np.exp(at[2])
    # Differences in the tail where they keep their digits.
    turned = np.where(edges[:, 0] > 0, -1.0, 1.0)
    chance = np.abs(scipy.special.ndtr(turned * edges[:, 1]) - scipy.special.ndtr(turned * edges[:, 0]))
    logs = np.log(np.maximum(chance, 1e-300))
    prior = scipy.stats.norm.logpdf(NODES) + np.log(NODES[1] - NODES[0])
    return np.asarray(scipy.special.logsumexp(counts @ logs + prior, axis=1))


def _estimate(pairs: Array, counts: Array) -> Array:
    finite = np.clip(pairs, pairs[np.isfinite(pairs)].min(), pairs[np.isfinite(pairs)].max()).mean(axis=1)
    mean = float(counts.sum(axis=0) @ finite / counts.sum())
    spread = max(float(np.sqrt(counts.sum(axis=0) @ (finite - mean) ** 2 / counts.sum())), 0.05)
    start = np.array([mean, np.log(spread), np.log(spread / 2)])
    smallest = np.log(SMALLEST / 2)
    found = scipy.optimize.minimize(
        lambda at: -_log_likelihood(pairs, counts, at).sum(),
        start,
        method="L-BFGS-B",
        bounds=[(None, None), (smallest, 3.0), (smallest, 3.0)],
    )
    return np.asarray(found.x)


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # of few records a limit may be as good as infinite
def _band(pairs: Array, counts: Array, record: NDArray[np.intp], at: Array, weights: Array, level: float) -> Band:
    """β of the records and β of the parameters with their limits, shape (2,) each."""
    variances = np.exp(2 * at[1:])
    unit = np.diag(STEP * np.array([np.sqrt(variances.sum()), *variances]))

    def of_records(shift: Array) -> Array:
        moved = np.array([at[0] + shift[0], *(np.log(variances + shift[1:]) / 2)])
        found = np.bincount(record, _log_likelihood(pairs, counts, moved), weights.shape[1])
        return np.asarray(found, dtype=np.float64)

    scores, information = _derivatives(of_records, unit)
    influence = scores @ np.linalg.pinv(information)
    steps = weights @ influence
    # What each record would move the moved estimate by, of all records the mean.
    left = influence[None] - (steps / weights.shape[1])[:, None]
    errors = np.sqrt(np.einsum("nr,nri->ni", weights, left**2))[:, 1:]
    moved = variances + steps[:, 1:] - steps[0, 1:]
    usable = np.all(moved > 0, axis=1)
    usable[1:] &= shows_spread(usable[1:], weights.shape[1])
    values, errors = np.log(moved[usable]) / 2, errors[usable] / (2 * moved[usable])
    return Band(
        *(np.exp(each) for each in studentised(values[0], errors[0], values[1:], errors[1:], level, weights.shape[1]))
    )


def _derivatives(function: Callable[[Array], Array], unit: Array) -> tuple[Array, Array]:
    """Scores of each record, (r, 3), and information of all, (3, 3), by differences of the steps in `unit`."""
    steps = np.diag(unit)
    up, down = np.array([function(each) for each in unit]), np.array([function(-each) for each in unit])
    middle, above, below = function(np.zeros(3)).sum(), up.sum(axis=1), down.sum(axis=1)
    information = np.diag(2 * middle - above - below)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        both = function(unit[i] + unit[j]).sum() + function(-unit[i] - unit[j]).sum()
        mixed = both - above[i] - above[j] + 2 * middle - below[i] - below[j]
        information[i, j] = information[j, i] = -mixed / 2
    return ((up - down) / (2 * steps[:, None])).T, information / np.outer(steps, steps)
