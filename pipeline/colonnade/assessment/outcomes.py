"""Outcomes of histories over intensity: records at levels, under draws of the block's properties, in directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array, Mask
from colonnade.errors import count

FEWEST = 2
"""Of a curve: one record has no scatter between records."""


class Cells(NamedTuple):
    """
    Histories counted where record and intensity are the same.

    Attributes
    ----------
    log_intensity : ndarray, shape (r, m)
    events, histories : ndarray, shape (r, m)
        Histories in which it happened, and all of them; 0 where none was run.
    """

    log_intensity: Array
    events: Array
    histories: Array


@dataclass(frozen=True)
class Outcomes:
    """
    What became of each history; made by `gather`.

    Attributes
    ----------
    records : tuple of str, length r
        Their names. A record at many levels is one record: intervals resample records.
    intensity : ndarray, shape (r, l, 1) or (r, l, c)
        Of each record at each level, positive and rising; the last axis if directions have intensities of their own.
    peak : ndarray, shape (r, l, d, c)
        max |θ| / α; 0 without uplift, NaN if the history was not run. Axes: record, level, draw, direction (components
        and signs). A draw is the same at all levels of its record. Other records have draws of their own; if all share
        the same few, every interval holds for those few alone.
    overturned : ndarray of bool, shape (r, l, d, c)
    """

    records: tuple[str, ...]
    intensity: Array
    peak: Array
    overturned: Mask

    @property
    def was_run(self) -> Mask:
        """Which histories were run, shape (r, l, d, c)."""
        return ~np.isnan(self.peak)

    def cells(self, event: Mask | None = None, intensity: Array | None = None) -> Cells:
        """
        Count histories by record and intensity.

        Parameters
        ----------
        event : ndarray of bool, shape (r, l, d, c), optional
            What is counted. Default: overturning.
        intensity : ndarray, shape (r, l, 1) or (r, l, c), optional
            Of another measure, positive.
        """
        event = self.overturned if event is None else event
        intensity = self.intensity if intensity is None else intensity
        axes = (2, 3) if intensity.shape[2] == 1 else (2,)
        events = (event & self.was_run).sum(axis=axes, dtype=np.float64)
        histories = self.was_run.sum(axis=axes, dtype=np.float64)
        rows = len(self.records)
        # Levels that were not run may have no intensity.
        known = np.where(histories.reshape(rows, -1) > 0, intensity.reshape(rows, -1), 1.0)
        return Cells(np.log(known), events.reshape(rows, -1), histories.reshape(rows, -1))


def gather(records: Sequence[str], intensity: ArrayLike, peak: ArrayLike, overturned: Mask | None = None) -> Outcomes:
    """
    Bring outcomes to their axes.

    Parameters
    ----------
    records : sequence of str, length r
        Names, each once.
    intensity : array_like, shape (r, l) or (r, l, c)
        Positive, in SI, rising along l.
    peak : array_like, shape (r, l), (r, l, d) or (r, l, d, c)
        max |θ| / α; NaN if the history was not run. Each record has a history.
    overturned : ndarray of bool, shape of peak, optional
        Default: peak above 1.

    Raises
    ------
    ValueError
        If there are fewer than `FEWEST` records.
    """
    if len(records) < FEWEST:
        raise ValueError(f"records has {count(len(records), 'name')}; at least {FEWEST} were expected")
    peaks = with_axes(peak, 4)
    over = peaks > 1.0 if overturned is None else overturned.reshape(peaks.shape)
    return Outcomes(tuple(records), with_axes(intensity, 3), peaks, over & ~np.isnan(peaks))


def with_axes(values: ArrayLike, axes: int) -> Array:
    """Add axes of length 1 at the end, up to so many in all."""
    array = np.asarray(values, dtype=np.float64)
    return array.reshape(*array.shape, *(1,) * (axes - array.ndim))


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
    events, histories, total = (
        summed(each, place, distinct.size) for each in (cells.events, cells.histories, cells.histories * y)
    )
    return Stripes(total.sum(axis=0) / histories.sum(axis=0), events, histories, place)


def summed(values: Array, place: NDArray[np.intp], count: int) -> Array:
    """Add up the values of each record, shape (r, m), that have the same place, shape (r, count)."""
    rows = len(values)
    flat = (np.arange(rows)[:, None] * count + place).ravel()
    return np.asarray(np.bincount(flat, values.ravel(), rows * count).reshape(rows, count), dtype=np.float64)


def resurrected(outcomes: Outcomes) -> float:
    """
    Give the share of all histories that survive although the same record and draw overturned at a lower level.

    That is what the curve would gain if overturning once were overturning at all higher levels.
    """
    before = np.logical_or.accumulate(outcomes.overturned, axis=1)
    return float((before & ~outcomes.overturned & outcomes.was_run).sum() / outcomes.was_run.sum())
