"""Whether outcomes are lognormal: shares of the stripes against the curve, with a record as one record."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.fragility.curves import probit
from colonnade.assessment.fragility.curves.parameters import Parameters, fit_parameters
from colonnade.assessment.fragility.outcomes import Cells, Outcomes
from colonnade.assessment.fragility.resampling import RESAMPLES, record_weights
from colonnade.assessment.fragility.stripes import Stripes, striped


@dataclass(frozen=True)
class Misfit:
    """
    Departure of the stripes from the lognormal curve.

    Attributes
    ----------
    intensity, departure : ndarray, shape (k,)
        Of each stripe: share less the curve's probability.
    deviance : float
        Twice the log-likelihood that the curve loses to the shares of the stripes, histories taken as independent.
    statistic : float
        Pearson's, of which `p_value` is judged.
    p_value : float
        Probability of such a departure if the curve were right, by resamples of the records. NaN without a curve.
    """

    intensity: Array
    departure: Array
    deviance: float
    statistic: float
    p_value: float


def lognormal_misfit(outcomes: Outcomes, *, resamples: int = RESAMPLES, seed: int = 0) -> Misfit:
    """
    Test whether a lognormal curve fits.

    Parameters
    ----------
    outcomes : Outcomes
    resamples, seed : int, optional
        Of the bootstrap over records.

    Returns
    -------
    misfit : Misfit

    Notes
    -----
    The χ² of a deviance does not hold: a record at several levels is one record. The distribution under the curve is
    that of the resamples' departures about the observed ones (centred bootstrap, Hall and Wilson 1991).
    """
    cells = outcomes.cells()
    stripes = striped(cells)
    weights = np.vstack((np.ones(len(outcomes.records)), record_weights(len(outcomes.records), resamples, seed)))
    parameters, log_likelihood, status = fit_parameters(cells, weights)
    shares, expected = _shares(cells, stripes, weights, parameters)
    departures = shares - expected
    fitted = status == probit.FITTED
    likely = np.clip(expected[0], 0.5 / len(outcomes.records), 1 - 0.5 / len(outcomes.records))
    scale = stripes.histories.sum(axis=0) / (likely * (1 - likely))
    statistic = float((scale * departures[0] ** 2).sum())
    null = (scale * (departures[1:][fitted[1:]] - departures[0]) ** 2).sum(axis=1)
    p_value = float((1 + (null >= statistic).sum()) / (1 + null.size)) if fitted[0] else np.nan
    return Misfit(
        np.exp(stripes.log_intensity), departures[0], _deviance(stripes, float(log_likelihood[0])), statistic, p_value
    )


def _shares(cells: Cells, stripes: Stripes, weights: Array, parameters: Parameters) -> tuple[Array, Array]:
    """Shares of the stripes and those expected by each fit, shape (n, k)."""
    events, histories = weights @ stripes.events, weights @ stripes.histories
    expected = np.empty_like(events)
    rows, stripes_of = cells.histories.shape[0], stripes.log_intensity.size
    flat = (np.arange(rows)[:, None] * stripes_of + stripes.place).ravel()
    for n, (mean, log_beta) in enumerate(zip(parameters.log_median, parameters.log_beta, strict=True)):
        likely = cells.histories * scipy.special.ndtr((cells.log_intensity - mean) / np.exp(log_beta))
        expected[n] = weights[n] @ np.bincount(flat, likely.ravel(), rows * stripes_of).reshape(rows, stripes_of)
    of = np.where(histories > 0, histories, np.nan)
    return events / of, expected / of


def _deviance(stripes: Stripes, log_likelihood: float) -> float:
    events, histories = stripes.events.sum(axis=0), stripes.histories.sum(axis=0)
    share = events / histories
    saturated = scipy.special.xlogy(events, share) + scipy.special.xlogy(histories - events, 1 - share)
    return float(2 * (saturated.sum() - log_likelihood))
