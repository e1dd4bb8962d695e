"""Stripes: the histories of all records at one intensity, or at about one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.assessment.fragility.outcomes import Cells

MOST_STRIPES = 20
"""Distinct intensities that are stripes of their own; of more, neighbours share one."""


class Stripes(NamedTuple):
    """
    Histories counted by record and stripe.

    Attributes
    ----------
    log_intensity : ndarray, shape (k,)
        Mean of a stripe, rising.
    events, histories : ndarray, shape (r, k)
    place : ndarray of int, shape (r, m)
        Stripe of each cell.
    """

    log_intensity: Array
    events: Array
    histories: Array
    place: NDArray[np.intp]


def striped(cells: Cells) -> Stripes:
    """Sort the cells into stripes: one for each intensity, or `MOST_STRIPES` with about as many histories each."""
    counted = cells.histories > 0
    y = cells.log_intensity
    distinct = np.unique(np.round(y[counted], 9))
    if distinct.size > MOST_STRIPES:
        distinct = np.unique(np.quantile(y[counted], (np.arange(MOST_STRIPES) + 0.5) / MOST_STRIPES))
    edges = (distinct[1:] + distinct[:-1]) / 2
    # Between two quantiles there may be nothing.
    distinct = np.unique(np.searchsorted(edges, y[counted]))
    place = np.minimum(np.searchsorted(distinct, np.searchsorted(edges, y)), distinct.size - 1)
    rows = np.repeat(np.arange(y.shape[0])[:, None], y.shape[1], axis=1)
    flat = (rows * distinct.size + place).ravel()
    shape = (y.shape[0], distinct.size)
    events, histories, total = (
        np.asarray(np.bincount(flat, each.ravel(), shape[0] * shape[1]).reshape(shape), dtype=np.float64)
        for each in (cells.events, cells.histories, cells.histories * y)
    )
    return Stripes(total.sum(axis=0) / histories.sum(axis=0), events, histories, place)
