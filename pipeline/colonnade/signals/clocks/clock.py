"""Clocks: the interval of a time column, and values brought from one clock to another."""

from __future__ import annotations

import numpy as np
import scipy

from colonnade.arrays import Array, Mask

LONGEST_BRIDGE = 5
"""Intervals; over a longer gap values are not interpolated but missing."""


def sampling_interval(time: Array) -> float:
    """
    Interval of a clock, s.

    Returns
    -------
    interval : float
        The mean of the steps that lie within half of their median, so that gaps, repeated times and times written with
        few digits do not count; NaN where no two times increase.
    """
    steps = np.diff(time[np.isfinite(time)])
    steps = steps[steps > 0]
    if steps.size == 0:
        return float("nan")
    typical = float(np.median(steps))
    return float(steps[np.abs(steps - typical) <= 0.5 * typical].mean())


def uniform_clock(start: float, stop: float, interval: float) -> Array:
    """Times from `start` in steps of `interval` up to `stop`, s; `stop` counts as reached within 1e-6 intervals."""
    count = int(np.floor((stop - start) / interval + 1e-6)) + 1
    return start + interval * np.arange(max(count, 0), dtype=np.float64)


def resample(time: Array, values: Array, onto: Array, interval: float) -> tuple[Array, Mask]:
    """
    Bring values to another clock.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s, increasing; finite.
    onto : ndarray, shape (m,)
        s, increasing.
    interval : float
        Of `time`, s.

    Returns
    -------
    resampled : ndarray, shape (m,)
        By a cubic spline; over gaps, straight lines.
    missing : ndarray of bool, shape (m,)
        Samples outside the record or inside a gap of more than `LONGEST_BRIDGE` intervals.

    Notes
    -----
    The error of the spline for a sine with n samples a period is about 2 (2π/n)⁴ / 384 of its amplitude: 1.6e-5 at 30.
    """
    if time.size == onto.size and np.abs(time - onto).max() <= 1e-6 * interval:
        return values, np.zeros(onto.size, dtype=bool)
    steps = np.diff(time)
    gaps = np.flatnonzero(steps > 1.5 * interval)
    knots, heights = time, values
    if gaps.size:
        # Points on the chord keep the spline from swinging out over a gap.
        filling = [uniform_clock(time[gap] + interval, time[gap + 1] - 0.5 * interval, interval) for gap in gaps]
        knots = np.sort(np.concatenate([time, *filling]))
        heights = np.interp(knots, time, values)
    inside = np.clip(onto, time[0], time[-1])
    resampled = (
        scipy.interpolate.CubicSpline(knots, heights)(inside) if knots.size > 3 else np.interp(inside, knots, heights)
    )
    after = np.clip(np.searchsorted(time, onto, side="right"), 1, max(time.size - 1, 1))
    within = time[after] - time[after - 1] > (LONGEST_BRIDGE + 0.5) * interval if time.size > 1 else np.ones(onto.size)
    slack = 1e-6 * interval
    outside = (onto < time[0] - slack) | (onto > time[-1] + slack)
    on_sample = np.minimum(np.abs(onto - time[after - 1]), np.abs(onto - time[after])) <= slack
    return np.asarray(resampled, dtype=np.float64), outside | (np.asarray(within, dtype=bool) & ~on_sample)
