"""Clocks: what a column of times says, and channels brought to one clock."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_DECIMALS = range(10)


@dataclass(frozen=True)
class ClockReport:
    """
    What a column of times says.

    Attributes
    ----------
    interval : float
        Sampling interval, s, by a straight line through the times; gaps do not count.
    time : ndarray, shape (n,)
        Times that can be relied on, s, strictly increasing: those of the file, with repeated, backward and missing
        ones replaced; where the file rounds its times, the straight line that they were rounded from.
    jitter : float
        Standard deviation of the steps that are not gaps, as a fraction of the interval. 0 where the times are rounded.
    gaps : ndarray of int
        Indices of the samples after which a step is longer than `gap` intervals.
    backwards : ndarray of int
        Indices of the samples that are not later than one before them.
    uneven : ndarray of int
        Indices of the samples after which a step, no gap, is off by more than `jitter` intervals.
    missing : ndarray of int
        Indices of samples without a time.
    resolution : float
        Step that the times are rounded to, s, where that accounts for their unevenness; else 0.
    """

    interval: float
    time: Array
    jitter: float
    gaps: Indices
    backwards: Indices
    uneven: Indices
    missing: Indices
    resolution: float


def analyse_clock(time: ArrayLike, *, gap: float = 1.5, jitter: float = 0.05) -> ClockReport:
    """
    Find sampling interval, gaps, jitter and damage of a column of times.

    Parameters
    ----------
    time : array_like, shape (n,)
        s; NaN where missing.
    gap : float
        A step longer than this is a gap, in sampling intervals.
    jitter : float
        Steps may be off by this much, in sampling intervals.

    Raises
    ------
    ValueError
        If fewer than two times are numbers, or the time does not advance.

    Examples
    --------
    >>> report = analyse_clock([0.0, 0.1, 0.2, 0.6, 0.7])
    >>> round(report.interval, 9), report.gaps.tolist()
    (0.1, [2])
    """
    stamps = np.asarray(time, dtype=np.float64)
    known = np.isfinite(stamps)
    if known.sum() < 2:
        raise ValueError(f"{int(known.sum())} of {stamps.size} times are numbers; at least two were expected")
    filled = _along_index(stamps, known)
    resolution = _resolution(filled[known])
    # A coarse column repeats a time; only a step back by more than its rounding is damage.
    highest = np.concatenate(([-np.inf], np.maximum.accumulate(filled)[:-1]))
    backward = filled < highest if _is_rounded(filled, resolution) else filled <= highest
    forward = _along_index(filled, ~backward)
    interval = _interval(forward)
    slots = _slots(forward, interval)
    line = np.polynomial.Polynomial.fit(slots, forward, 1).convert().coef
    interval, fitted = float(line[1]), line[0] + line[1] * slots
    steps = np.diff(forward) / interval
    gaps = np.flatnonzero(steps > gap)
    rounded = bool(resolution > 0 and np.abs(fitted - forward).max() <= 1.01 * resolution)
    if rounded:
        # A rounded step may look long; on the line it is a gap only where a sample is missing.
        gaps = np.flatnonzero(np.diff(slots) > gap)
        steps = np.diff(slots)
    within = np.delete(steps, gaps)
    off = np.abs(steps - 1.0) > jitter
    off[gaps] = False
    return ClockReport(
        interval=interval,
        time=fitted if rounded and not _is_exact(forward, fitted, interval) else forward,
        jitter=float(np.std(within)) if within.size else 0.0,
        gaps=gaps,
        backwards=np.flatnonzero(backward & known),
        uneven=np.flatnonzero(off),
        missing=np.flatnonzero(~known),
        resolution=resolution if rounded and not _is_exact(forward, fitted, interval) else 0.0,
    )


def uniform_clock(start: float, stop: float, interval: float) -> Array:
    """
    Times from start in equal steps, none later than stop (but for rounding), s.

    Examples
    --------
    >>> uniform_clock(0.0, 0.3, 0.1).size
    4
    """
    return start + interval * np.arange(int(np.floor((stop - start) / interval + 1e-6)) + 1)


def resample(time: ArrayLike, values: ArrayLike, onto: ArrayLike) -> Array:
    """
    Values at other times, by a cubic spline; for values that have been low-passed.

    Parameters
    ----------
    time : array_like, shape (n,)
        s, strictly increasing.
    values : array_like, shape (n,)
        Without NaN: gaps are bridged before, by a straight line, which the spline then follows.
    onto : array_like, shape (m,)
        s.

    Returns
    -------
    resampled : ndarray, shape (m,)
        The end values where `onto` goes beyond `time`.

    Notes
    -----
    Of an oscillation with n samples a period the spline loses at most about 1.1 (2/n)⁴ of the amplitude: 2e-3 at
    10 samples, 1e-4 at 20; a straight line loses 1.2 (2/n)²: 5e-2 and 1.2e-2, which is why it is not used.
    """
    at, samples, wanted = (np.asarray(each, dtype=np.float64) for each in (time, values, onto))
    if at.size < 4:
        return np.interp(wanted, at, samples)
    return np.asarray(CubicSpline(at, samples)(np.clip(wanted, at[0], at[-1])), dtype=np.float64)


def _along_index(stamps: Array, good: NDArray[np.bool_]) -> Array:
    """Replace times that are not good by lines through the others, carried on at the ends by the median step."""
    if good.all():
        return stamps
    index = np.arange(stamps.size)
    at, known = index[good], stamps[good]
    filled = np.where(good, stamps, np.interp(index, at, known))
    if at.size > 1:
        step = float(np.median(np.diff(known) / np.diff(at)))
        filled[: at[0]] = known[0] - step * (at[0] - index[: at[0]])
        filled[at[-1] + 1 :] = known[-1] + step * (index[at[-1] + 1 :] - at[-1])
    return filled


def _interval(time: Array) -> float:
    """First estimate; where a coarse clock repeats its times, the mean step."""
    if not time[-1] > time[0]:
        raise ValueError(f"the time does not advance: it goes from {time[0]:g} s to {time[-1]:g} s")
    steps = np.diff(time)
    middle = float(np.median(steps))
    mean = float((time[-1] - time[0]) / (time.size - 1))
    if middle <= 0:
        return mean
    usual = steps[steps <= 2.5 * middle]
    return float(np.mean(usual))


def _slots(time: Array, interval: float) -> Array:
    """Number of each sample on an even clock, gaps counted as the samples that they miss."""
    steps = np.diff(time) / interval
    return np.concatenate(([0.0], np.cumsum(np.where(steps > 2.5, np.round(steps), 1.0))))


def _resolution(time: Array) -> float:
    """Largest power of ten, s, that all times are multiples of; 0 where there is none."""
    for decimals in _DECIMALS:
        scaled = time * 10.0**decimals
        if np.abs(scaled - np.round(scaled)).max() < 1e-6 * max(1.0, 1e-6 * np.abs(scaled).max()):
            return float(10.0**-decimals)
    return 0.0


def _is_rounded(time: Array, resolution: float) -> bool:
    """Whether repeated times are what rounding makes of an even clock."""
    mean = (time[-1] - time[0]) / (time.size - 1)
    return bool(resolution > 0 and 0 < mean < resolution)


def _is_exact(time: Array, fitted: Array, interval: float) -> bool:
    return bool(np.abs(fitted - time).max() < 1e-3 * interval)
