"""The records that decide a curve: what changes if one of them is left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.fragility.curves.hazard import Hazard, lognormal_rate
from colonnade.assessment.fragility.curves.parameters import fit_parameters
from colonnade.assessment.fragility.outcomes import Outcomes


@dataclass(frozen=True)
class Influence:
    """
    A curve without each record.

    Attributes
    ----------
    records : tuple of str, length r
        The most influential first: by the change of the rate if there is a hazard, else of the median. A record
        without which there is no curve comes first of all.
    median, beta : ndarray, shape (r,)
        Without the record; NaN if there is then no curve.
    rate : ndarray, shape (r,), or None
        Per year, if there is a hazard.
    """

    records: tuple[str, ...]
    median: Array
    beta: Array
    rate: Array | None


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # without a record the curve may be nearly flat
def influence(outcomes: Outcomes, hazard: Hazard | None = None) -> Influence:
    """Leave out one record after the other; `hazard` is of the same measure."""
    rows = len(outcomes.records)
    weights = np.vstack((np.ones(rows), 1.0 - np.eye(rows)))
    parameters = fit_parameters(outcomes.cells(), weights)[0]
    median, beta = np.exp(parameters.log_median), np.exp(parameters.log_beta)
    rate = None if hazard is None else _rates(hazard, median, beta)
    decides = median if rate is None else rate
    change = np.abs(np.log(decides[1:] / decides[0]))
    order = np.argsort(-np.where(np.isnan(change), np.inf, change), kind="stable")
    return Influence(
        tuple(outcomes.records[place] for place in order),
        median[1:][order],
        beta[1:][order],
        None if rate is None else rate[1:][order],
    )


def _rates(hazard: Hazard, median: Array, beta: Array) -> Array:
    found = np.full(median.size, np.nan)
    known = np.isfinite(median)
    found[known] = lognormal_rate(hazard, median[known], beta[known])
    return found
