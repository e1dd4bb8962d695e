"""Limits of overturning over the amplitude of a base motion: from where it overturns, and up to where it may not."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log2
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes, Mask

Runs = Callable[[Array], Codes]
"""Returns the outcomes at some A, indices into `OUTCOMES`."""


class Limits(NamedTuple):
    """
    Limits in A.

    Attributes
    ----------
    lower : float
        Start of the first overturning interval at least `width` wide; NaN without one.
    upper : float
        End of the last surviving interval by the same rule; NaN if that reaches the largest A, or without one.
    intervals : ndarray, shape (k, 2)
        Every interval of A that overturns, from and to.
    """

    lower: float
    upper: float
    intervals: Array


def limits_of(scan: Array, codes: Codes, runs: Runs, *, width: float, edge: float) -> Limits:
    """
    Find the limits between outcomes.

    Parameters
    ----------
    scan : ndarray, shape (n,)
        A that were run, rising.
    codes : ndarray of int8, shape (n,)
        Their outcomes.
    runs : callable
    width : float
        In A: narrower intervals make no limit.
    edge : float
        In A: how closely the edges of intervals are found.
    """
    intervals = _intervals(scan, codes == 2, lambda amplitudes: runs(amplitudes) == 2, edge)
    low, high = float(scan[0]), float(scan[-1])
    return Limits(_first_wide(intervals, width), _last_wide_end(_gaps(intervals, low, high), width, high), intervals)


def onset_of(scan: Array, codes: Codes, runs: Runs, *, edge: float) -> float:
    """Find the A from which a block first does not stay at rest, to `edge`; NaN if it always does. As `limits_of`."""
    moves = codes > 0
    if not moves.any():
        return float("nan")
    first = slice(int(np.argmax(moves)) + 1)
    return float(_intervals(scan[first], moves[first], lambda amplitudes: runs(amplitudes) > 0, edge)[0, 0])


def islands_of(frequency_ratio: Array, start: Array, end: Array, width: float) -> Array:
    """Give the intervals that overturn and are narrower than `width`: rows of Ω, start and end in A, shape (k, 3)."""
    rows = np.column_stack([frequency_ratio, start, end])
    islands: Array = rows[end - start < width]
    return islands


def _intervals(scan: Array, found: Mask, holds: Callable[[Array], Mask], edge: float) -> Array:
    """Intervals in which something holds, shape (k, 2): each change in the scan halved down to `edge`."""
    changes = np.flatnonzero(found[1:] != found[:-1])
    low, high, before = scan[changes], scan[changes + 1], found[changes]
    if changes.size:
        for _ in range(max(0, ceil(log2(float((high - low).max()) / edge)))):
            middle = 0.5 * (low + high)
            as_before = holds(middle) == before
            low, high = np.where(as_before, middle, low), np.where(as_before, high, middle)
    edges = 0.5 * (low + high)
    first = scan[:1] if found[0] else scan[:0]
    last = scan[-1:] if found[-1] else scan[:0]
    return np.concatenate([first, edges, last]).reshape(-1, 2)


def _gaps(intervals: Array, low: float, high: float) -> Array:
    """What the intervals leave of [low, high], shape (k, 2)."""
    bounds = np.concatenate([[low], intervals.ravel(), [high]]).reshape(-1, 2)
    return bounds[bounds[:, 1] > bounds[:, 0]]


def _first_wide(intervals: Array, width: float) -> float:
    wide = intervals[intervals[:, 1] - intervals[:, 0] >= width]
    return float(wide[0, 0]) if wide.size else float("nan")


def _last_wide_end(intervals: Array, width: float, largest: float) -> float:
    wide = intervals[intervals[:, 1] - intervals[:, 0] >= width]
    return float(wide[-1, 1]) if wide.size and wide[-1, 1] < largest else float("nan")
