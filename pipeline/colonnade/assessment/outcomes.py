"""Outcomes of histories over intensity: records at levels, under draws of the block's properties, in directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array, Mask
from colonnade.validation import samples

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
        Of each record at each level, positive; the last axis if directions have intensities of their own.
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

    def only(self, chosen: Mask) -> Outcomes:
        """Give the outcomes of some records; `chosen` has shape (r,)."""
        names = tuple(name for name, is_in in zip(self.records, chosen, strict=True) if is_in)
        return Outcomes(names, self.intensity[chosen], self.peak[chosen], self.overturned[chosen])


def gather(
    records: Sequence[str], intensity: ArrayLike, peak: ArrayLike, overturned: ArrayLike | None = None
) -> Outcomes:
    """
    Check outcomes and bring them to their axes.

    Parameters
    ----------
    records : sequence of str, length r
        Names, each once.
    intensity : array_like, shape (r, l) or (r, l, c)
        Positive, in SI.
    peak : array_like, shape (r, l), (r, l, d) or (r, l, d, c)
        max |θ| / α; NaN if the history was not run.
    overturned : array_like of bool, shape of peak, optional
        Default: peak above 1.

    Returns
    -------
    outcomes : Outcomes

    Raises
    ------
    ValueError
        If the shapes do not fit, a name occurs twice, there are fewer than `FEWEST` records, a peak is
        negative, a record has no history, or an intensity of a history is missing or not positive.
    """
    peaks = with_axes(samples("peak", peak, dimensions=(2, 3, 4), gaps=True, finite=False, each="history"), 4)
    over = _overturned(overturned, peaks)
    names = tuple(str(name) for name in records)
    given = with_axes(samples("intensity", intensity, dimensions=(2, 3), gaps=True, each="value"), 3)
    rows, levels, _, directions = peaks.shape
    if given.shape not in ((rows, levels, 1), (rows, levels, directions)) or len(names) != rows:
        raise ValueError(
            f"there are {len(names)} records, intensity has shape {given.shape} and peak {peaks.shape}; one intensity "
            "for each record and level (and direction) of peak was expected"
        )
    if len(set(names)) < len(names) or rows < FEWEST:
        raise ValueError(f"records has {len(set(names))} different names; at least {FEWEST} were expected, each once")
    was_run = ~np.isnan(peaks)
    if (peaks < 0).any() or not was_run.any(axis=(1, 2, 3)).all():
        raise ValueError("peak is negative, or a record has no history; max |θ| / α of each record was expected")
    needed = np.any(was_run, axis=2) if given.shape[2] > 1 else np.any(was_run, axis=(2, 3))[:, :, None]
    if not (given[needed] > 0).all():
        raise ValueError("intensity is missing or not positive for a history that was run; a positive one was expected")
    return Outcomes(names, given, peaks, over & was_run)


def with_axes(values: Array, count: int) -> Array:
    """Add axes of length 1 at the end, up to so many in all."""
    return np.asarray(np.reshape(values, (*values.shape, *(1,) * (count - values.ndim))), dtype=np.float64)


def _overturned(given: ArrayLike | None, peaks: Array) -> Mask:
    """Give the mask in the shape of the peaks; by default above 1."""
    if given is None:
        return np.asarray(peaks > 1.0)
    mask = np.asarray(given)
    if mask.dtype.kind != "b" or mask.size != peaks.size or mask.shape != peaks.shape[: mask.ndim]:
        raise ValueError(
            f"overturned has shape {mask.shape} and holds {mask.dtype}; truth values in the shape of peak were expected"
        )
    return np.asarray(mask.reshape(peaks.shape))


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


@dataclass(frozen=True)
class Resurrection:
    """
    How often a stronger motion spares what a weaker one overturned.

    Attributes
    ----------
    pairs : float
        Share of the pairs of record and draw (in each direction) that overturn at a level and survive at a higher one.
    records : tuple of str
        In which it happens.
    lost : float
        Share of all histories that survive although the same pair overturned at a lower level: what the curve would
        gain if overturning once were overturning at all higher levels.
    """

    pairs: float
    records: tuple[str, ...]
    lost: float


def resurrection(outcomes: Outcomes) -> Resurrection:
    """Count resurrections; the levels of a record are compared by their intensities."""
    over, was_run = by_intensity(outcomes)[1:]
    before = np.logical_or.accumulate(over, axis=1)
    lost: Mask = before & ~over & was_run
    pairs: Mask = np.any(lost, axis=1)
    counted = np.any(was_run, axis=1)
    names = tuple(name for name, has in zip(outcomes.records, np.any(pairs, axis=(1, 2)), strict=True) if has)
    return Resurrection(float(pairs.sum() / counted.sum()), names, float(lost.sum() / was_run.sum()))


def by_intensity(outcomes: Outcomes) -> tuple[Array, Mask, Mask]:
    """Give intensity, overturned and was_run with the levels of each record and direction in rising order."""
    intensity = np.broadcast_to(outcomes.intensity[:, :, None, :], outcomes.peak.shape)
    order = np.argsort(intensity, axis=1)
    over, was_run = (np.take_along_axis(each, order, axis=1) for each in (outcomes.overturned, outcomes.was_run))
    return np.take_along_axis(intensity, order, axis=1), over, was_run
