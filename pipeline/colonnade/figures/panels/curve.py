"""A curve over time, and the envelopes of curves and bands that draw the same with a few hundred points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array

INTERVALS = 600
"""Time intervals of an envelope: finer than a screen or a printer shows across a figure's width."""


class Curve(NamedTuple):
    """Times (s) and values of one line, both shape (n,); NaN for a missing value."""

    time: Array
    values: Array


def envelope(curve: Curve, *, intervals: int = INTERVALS) -> Curve:
    """
    Thin a long curve to the lowest and highest value of each time interval, so that no peak is lost.

    Parameters
    ----------
    curve : Curve
        Times not decreasing.
    intervals : int, optional
        Equal intervals over the curve's time.

    Returns
    -------
    thinned : Curve
        The curve itself where it has at most two values an interval; else at most two an interval, in their order of
        time, and the first and last value. An interval without any value gives one NaN, so that gaps stay gaps.

    Raises
    ------
    ValueError
        If times and values differ in shape.

    Examples
    --------
    >>> short = Curve(np.array([0.0, 1.0]), np.array([0.0, 2.0]))
    >>> envelope(short) is short
    True
    """
    time, values = curve
    if time.shape != values.shape:
        raise ValueError(
            f"time has shape {time.shape} and values {values.shape}; two arrays of one length were expected"
        )
    if time.size <= 2 * intervals:
        return curve
    edges = np.linspace(time[0], time[-1], intervals + 1)[1:-1]
    starts = np.unique(np.concatenate(([0], np.searchsorted(time, edges))))
    starts = starts[starts < time.size]
    finite = np.isfinite(values)
    lowest = _first_equal(np.minimum.reduceat(np.where(finite, values, np.inf), starts), values, starts)
    highest = _first_equal(np.maximum.reduceat(np.where(finite, values, -np.inf), starts), values, starts)
    index = np.unique(np.concatenate(([0, time.size - 1], lowest, highest)))
    return Curve(time[index], values[index])


def between(time: Array, below: Array, above: Array, *, intervals: int = INTERVALS) -> tuple[Array, Array, Array]:
    """
    Thin a band to one lowest and one highest value an interval of time, so that nothing inside it is lost.

    Parameters
    ----------
    time, below, above : ndarray, shape (n,)
    intervals : int, optional

    Returns
    -------
    time, below, above : ndarray
        As given where there are at most two samples an interval; else one of each an interval.
    """
    if time.size <= 2 * intervals:
        return time, below, above
    starts = np.unique(np.searchsorted(time, np.linspace(time[0], time[-1], intervals + 1)[:-1]))
    ends = np.append(starts[1:], time.size) - 1
    return (
        0.5 * (time[starts] + time[ends]),
        np.fmin.reduceat(below, starts),
        np.fmax.reduceat(above, starts),
    )


def _first_equal(extremes: Array, values: Array, starts: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the index of the first sample of each interval that is its extreme; its start where it has no value."""
    ends = np.append(starts[1:], values.size)
    interval = np.repeat(np.arange(starts.size), ends - starts)
    hits = np.flatnonzero(values == extremes[interval])
    found = starts.copy()
    owners, first = np.unique(interval[hits], return_index=True)
    found[owners] = hits[first]
    return found
