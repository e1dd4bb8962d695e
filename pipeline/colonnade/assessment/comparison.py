"""Which measure of a motion predicts overturning best."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
from colonnade.assessment.intervals import Resampling
from colonnade.assessment.outcomes import Outcomes
from colonnade.assessment.probit import fit_parameters


@dataclass(frozen=True)
class MeasureScore:
    """
    How well one measure predicts.

    Attributes
    ----------
    measure : str
        Its id.
    deviance : float
        −2 log-likelihood per history of the best curve Φ(a + b ln x), which may also fall; 0 is perfect.
    best : float
        Share of the resamples of records in which its deviance is the smallest, ties shared.
    auc : float
        Probability that a history that overturned had more of it than one that did not; ties count half.
    scatter : float
        Standard deviation of ln peak about its regression on ln x, of histories that rocked and did not overturn.
    magnitude, distance : float or None
        Sufficiency (Luco and Cornell 2007): p of magnitude and ln distance explaining nothing of what is left of the
        records' mean ln peak (Student's t). None if they are not known of three records.
    """

    measure: str
    deviance: float
    best: float
    auc: float
    scatter: float
    magnitude: float | None
    distance: float | None


def compare_measures(
    outcomes: Outcomes,
    measures: Mapping[str, Array],
    resampling: Resampling,
    magnitude: Array | None = None,
    distance: Array | None = None,
) -> tuple[MeasureScore, ...]:
    """
    Compare measures on the same histories, the best by deviance first.

    Parameters
    ----------
    outcomes : Outcomes
    measures : mapping of str to ndarray, shape (r, l, 1) or (r, l, c)
        Positive values of each measure for the scaled records: such that all records have.
    resampling : Resampling
    magnitude, distance : ndarray, shape (r,), optional
        Of the records; distances positive. NaN if not known.
    """
    if not measures:
        return ()
    weights, was_run = resampling.weights(len(outcomes.records)), outcomes.was_run
    likelihoods = [fit_parameters(outcomes.cells(intensity=each), weights)[1] for each in measures.values()]
    deviances = -2 * np.array(likelihoods) / np.maximum(weights @ was_run.sum(axis=(1, 2, 3)), 1)
    first = deviances[:, 1:] <= deviances[:, 1:].min(axis=0) + 1e-12
    best = (first / first.sum(axis=0)).mean(axis=1)
    covariates = magnitude, None if distance is None else np.log(distance)
    scores = []
    for place, (name, intensity) in enumerate(measures.items()):
        x, fell = _histories(outcomes, intensity, was_run), outcomes.overturned[was_run]
        scatter, left = _regressed(outcomes, intensity)
        p_values = [None if each is None else _p_of_trend(each, left) for each in covariates]
        auc = np.nan
        if fell.any() and not fell.all():
            auc = float(scipy.stats.mannwhitneyu(x[fell], x[~fell]).statistic) / (fell.sum() * (~fell).sum())
        scores.append(MeasureScore(name, float(deviances[place, 0]), float(best[place]), auc, scatter, *p_values))
    return tuple(sorted(scores, key=lambda score: score.deviance))


def _histories(outcomes: Outcomes, intensity: Array, chosen: Mask) -> Array:
    """Intensity of the chosen histories, rounded so that equal ones tie."""
    logs: Array = np.log(intensity).round(9)
    return np.broadcast_to(logs[:, :, None, :], outcomes.peak.shape)[chosen]


def _regressed(outcomes: Outcomes, intensity: Array) -> tuple[float, Array]:
    """Scatter of ln peak about its regression on ln intensity, and the mean residual of each record, NaN of none."""
    counts = outcomes.was_run & (outcomes.peak > 0) & ~outcomes.overturned
    x, y = _histories(outcomes, intensity, counts), np.log(outcomes.peak[counts])
    record = np.nonzero(counts)[0]
    if y.size < 3:
        return np.nan, np.full(len(outcomes.records), np.nan)
    # A measure that is the same for all explains nothing.
    line = np.polyfit(x, y, 1) if np.ptp(x) > 0 else np.array([0.0, y.mean()])
    residual = np.asarray(y - np.polyval(line, x), dtype=np.float64)
    count = np.bincount(record, minlength=len(outcomes.records))
    mean = np.bincount(record, residual, count.size) / np.where(count > 0, count, np.nan)
    return float(np.sqrt((residual**2).sum() / (y.size - 2))), mean


def _p_of_trend(covariate: Array, left: Array) -> float | None:
    """One value a record: its histories share what is particular about it. None of fewer than three records."""
    known = np.isfinite(covariate) & np.isfinite(left)
    if known.sum() < 3 or np.ptp(covariate[known]) == 0:
        return None
    return float(scipy.stats.linregress(covariate[known], left[known]).pvalue)
