"""ln median and ln β of lognormal curves, with their covariance, for many weightings of the records."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.assessment.fragility.curves import probit
from colonnade.assessment.fragility.outcomes import Cells


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
        As of `probit.fit_each`.
    """
    counted = cells.histories > 0
    centre = float(cells.log_intensity[counted].mean())
    width = float(cells.log_intensity[counted].std()) or 1.0
    fits, status = probit.fit_each((cells.log_intensity - centre) / width, cells.events, cells.histories, weights)
    a, b, aa, ab, bb, log_likelihood = np.where(
        (status == probit.FITTED) | (np.arange(6) == 5)[:, None], fits.T, np.nan
    )
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
