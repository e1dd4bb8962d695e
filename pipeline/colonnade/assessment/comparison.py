"""Which measure of a motion predicts overturning best."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.assessment.intervals import Resampling
from colonnade.assessment.outcomes import FEWEST, Cells, Outcomes, summed, with_axes
from colonnade.assessment.probit import fit_parameters
from colonnade.validation import samples


@dataclass(frozen=True)
class Trend:
    """Slope of the records' mean residuals of ln peak, its standard error, and p of no slope (Student's t)."""

    slope: float
    error: float
    p_value: float


@dataclass(frozen=True)
class MeasureScore:
    """
    How well one measure predicts.

    Attributes
    ----------
    name : str
    deviance : float
        −2 log-likelihood per history of the best curve Φ(a + b ln x), which may also fall; 0 is perfect.
    auc : float
        Probability that a history that overturned had more of it than one that did not; ties count half.
    scatter : float
        Standard deviation of ln peak about its regression on ln x, of histories that rocked and did not overturn.
    best_deviance, best_auc, best_scatter : float
        Share of the resamples of records in which it is the best of all measures.
    on_magnitude, on_log_distance : Trend or None
        Sufficiency (Luco and Cornell 2007): what magnitude and ln distance still explain.
    """

    name: str
    deviance: float
    auc: float
    scatter: float
    best_deviance: float
    best_auc: float
    best_scatter: float
    on_magnitude: Trend | None
    on_log_distance: Trend | None


@dataclass(frozen=True)
class Comparison:
    """Measures, the best by deviance first, and the records left out because they lack one of them."""

    scores: tuple[MeasureScore, ...]
    left_out: tuple[str, ...]


def compare_measures(
    outcomes: Outcomes,
    measures: Mapping[str, ArrayLike],
    resampling: Resampling,
    *,
    magnitude: ArrayLike | None = None,
    distance: ArrayLike | None = None,
) -> Comparison:
    """
    Compare measures on the same histories.

    Parameters
    ----------
    outcomes : Outcomes
    measures : mapping of str to array_like, shape (r, l) or (r, l, c)
        Positive values of each measure for the scaled records; NaN if a record does not have it.
    resampling : Resampling
    magnitude, distance : array_like, shape (r,), optional
        Of the records; distances positive. NaN if not known.

    Returns
    -------
    comparison : Comparison

    Raises
    ------
    ValueError
        If there is no measure, a shape does not fit, a value is not positive, or fewer than `FEWEST` records
        have all measures.
    """
    if not measures:
        raise ValueError("measures is empty; at least one measure was expected")
    arrays = {name: _checked(name, values, outcomes) for name, values in measures.items()}
    was_run = outcomes.was_run.any(axis=2)
    known = np.all([~(np.isnan(each) & was_run).any(axis=(1, 2)) for each in arrays.values()], axis=0)
    if known.sum() < FEWEST:
        raise ValueError(f"{known.sum()} records have all measures; at least {FEWEST} were expected")
    chosen = outcomes.only(known)
    weights = resampling.weights(int(known.sum()))
    found = np.array([_scored(chosen, each[known], weights) for each in arrays.values()])
    deviances, aucs, scatters = found.swapaxes(0, 1)
    best = [_shares_best(each) for each in (deviances, -np.maximum(aucs, 1 - aucs), scatters)]
    by_magnitude = None if magnitude is None else samples("magnitude", magnitude, gaps=True)[known]
    by_distance = None if distance is None else np.log(samples("distance", distance, gaps=True)[known])
    scores = []
    for place, (name, intensity) in enumerate(arrays.items()):
        left = residuals(chosen, intensity[known])
        deviance, auc, spread = found[place, :, 0].tolist()
        of_deviance, of_auc, of_scatter = (float(each[place]) for each in best)
        trends = _trend(by_magnitude, left), _trend(by_distance, left)
        scores.append(MeasureScore(name, deviance, auc, spread, of_deviance, of_auc, of_scatter, *trends))
    left_out = tuple(name for name, is_in in zip(outcomes.records, known, strict=True) if not is_in)
    return Comparison(tuple(sorted(scores, key=lambda score: score.deviance)), left_out)


def _checked(name: str, values: ArrayLike, outcomes: Outcomes) -> Array:
    array = with_axes(samples(name, values, dimensions=(2, 3), gaps=True), 3)
    rows, levels, _, directions = outcomes.peak.shape
    if array.shape not in ((rows, levels, 1), (rows, levels, directions)):
        raise ValueError(f"measure {name} has shape {array.shape}; {rows} records and {levels} levels were expected")
    if (array <= 0).any():
        raise ValueError(f"measure {name} is not positive for all records; positive values or NaN were expected")
    return array


def _scored(outcomes: Outcomes, intensity: Array, weights: Array) -> tuple[Array, Array, Array]:
    """Deviance per history, AUC and scatter of each weighting, shape (n,) each."""
    cells = outcomes.cells(intensity=intensity)
    log_likelihood = fit_parameters(cells, weights)[1]
    histories = weights @ cells.histories.sum(axis=1)
    return -2 * log_likelihood / histories, _auc(cells, weights), scatter(outcomes, intensity, weights)


def _auc(cells: Cells, weights: Array) -> Array:
    """Mann and Whitney's statistic of events against survivals, over the number of pairs."""
    distinct, place = np.unique(np.round(cells.log_intensity, 9), return_inverse=True)
    place = place.reshape(cells.events.shape)
    events, histories = (weights @ summed(each, place, distinct.size) for each in (cells.events, cells.histories))
    survivals = histories - events
    below = np.cumsum(survivals, axis=1) - survivals / 2
    pairs = events.sum(axis=1) * survivals.sum(axis=1)
    return np.asarray((events * below).sum(axis=1) / np.where(pairs > 0, pairs, np.nan))


def _shares_best(values: Array) -> Array:
    """Share of the resamples in which each row is the smallest, ties shared; shape (measures,)."""
    resampled = values[:, 1:]
    usable = ~np.isnan(resampled).any(axis=0)
    if not usable.any():
        return np.full(len(values), np.nan)
    resampled = resampled[:, usable]
    is_best = resampled <= resampled.min(axis=0) + 1e-12
    return np.asarray((is_best / is_best.sum(axis=0)).mean(axis=1))


def _trend(covariate: Array | None, left: Array) -> Trend | None:
    """One value a record: its histories share what is particular about it. None of fewer than three records."""
    if covariate is None:
        return None
    known = np.isfinite(covariate) & np.isfinite(left)
    if known.sum() < 3 or np.ptp(covariate[known]) == 0:
        return None
    line = scipy.stats.linregress(covariate[known], left[known])
    return Trend(float(line.slope), float(line.stderr), float(line.pvalue))


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
