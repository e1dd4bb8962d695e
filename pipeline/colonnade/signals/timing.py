"""Time columns: the reliable stamps, the even clock behind rounded ones, their faults; values on another clock."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.errors import count
from colonnade.findings import serious, warning
from colonnade.signals.quality import Flag, Verdict, counted, first_at
from colonnade.signals.samples import blocks, stretches

ROUNDING = 0.75
"""Of the last digit; times that lie closer to an even clock than this were rounded (or cut off) from it."""

COARSEST = 0.01
"""Of a record's length; from times of fewer digits its interval cannot be told."""

EXACT = 1e-7
"""Of an interval; times that lie closer than this to an even clock are on it."""

WILD = 2.5
"""Steps by which a stamp differs from the median of five around it that is not of this clock."""

LAG = 200
"""Samples, at least, over which the interval of rounded times is first taken."""

LONGEST_BRIDGE = 5
"""Intervals; over a longer gap values are not interpolated but missing."""


@dataclass(frozen=True)
class Clock:
    """
    What a time column says.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, increasing; NaN where a sample's stamp cannot be relied on.
    interval : float
        s; NaN where no two times increase.
    resolution : float
        Last digit that the stamps were rounded to, s, where `time` is the even clock behind them; otherwise 0.
    is_exact : bool
        Whether no stamp is further than `EXACT` from an even clock: no check of its order, steps and gaps flags one.
    """

    time: Array
    interval: float
    resolution: float
    is_exact: bool = False


def read_clock(stamps: Array) -> Clock:
    """
    Find the times of a record from its time column.

    Parameters
    ----------
    stamps : ndarray, shape (n,)
        s, as in the file; NaN where missing.

    Returns
    -------
    clock : Clock

    Notes
    -----
    Kept are stamps in order, without single ones gone wild. A line through them over their sample numbers,
    with a step at each gap, replaces them where it meets all of them within their rounding.

    Examples
    --------
    >>> read_clock(np.array([*range(6), 99.0, *range(7, 12)])).time[5:8].tolist()
    [5.0, nan, 7.0]
    """
    if _is_exact(stamps):
        return Clock(stamps, float(stamps[-1] - stamps[0]) / (stamps.size - 1), 0.0, is_exact=True)
    kept = _in_order(stamps, repeats=True)
    resolution = _resolution(stamps[kept])
    if kept.size > 2 and 0 < resolution <= COARSEST * np.ptp(stamps[kept]):
        even, interval = _even(kept, stamps[kept], resolution)
        misfit = float(np.abs(even - stamps[kept]).max())
        if 1e-6 * interval < misfit <= ROUNDING * resolution and (np.diff(even) > 0).all():
            return Clock(_in_place(kept, even, stamps.size), interval, resolution)
    kept = _in_order(stamps, repeats=False)
    return Clock(_in_place(kept, stamps[kept], stamps.size), sampling_interval(stamps[kept]), 0.0)


def check_order(stamps: Array, clock: Clock) -> Verdict:
    """Flag samples whose stamp does not fit in with the others."""
    where = np.isfinite(stamps) & ~np.isfinite(clock.time)
    if not where.any():
        return Verdict.good(stamps.size)
    first = f"the first is sample {int(np.argmax(where)) + 1}"
    back = np.flatnonzero(np.diff(stamps) <= 0)
    if back.size:
        at, then = stamps[back[0] : back[0] + 2]
        first = f"the clock goes from {at:.6g} to {then:.6g} s at sample {back[0] + 2:,}"
    reason = f"{counted(where)} whose time is out of order; {first}"
    starts, stops = stretches(where)
    if (stops - starts <= LONGEST_BRIDGE).all():
        return Verdict(Flag.FAIL, where, warning("time column", reason))
    reason += ". They are left out, and the largest readings may be among them: repair the time column"
    return Verdict(Flag.FAIL, where, serious("time column", reason))


def check_steps(clock: Clock, *, share: float, factor: float) -> list[Verdict]:
    """
    Flag the samples on either side of a gap, and those whose step is uneven; where stamps are lost, these are no gap.

    A gap is a step longer than `factor` intervals; another step is uneven if it differs from one by more than `share`.
    """
    kept = np.flatnonzero(np.isfinite(clock.time))
    steps, counts = np.diff(clock.time[kept]) / clock.interval, np.diff(kept)
    longer = steps - (counts - 1)
    after = np.flatnonzero(longer > factor)
    # Where a stamp is lost, its sample may be lost with it or not.
    off = np.minimum(np.abs(steps - 1), np.abs(steps - counts))
    uneven = (off > share) & (longer <= factor)
    beside, odd = np.zeros((2, clock.time.size), dtype=bool)
    beside[kept[after]] = beside[kept[after + 1]] = True
    odd[kept[1:][uneven]] = True
    lost = count(int(np.rint(longer[after] - 1).sum()), "sample")
    gaps = f"{count(after.size, 'gap')} in time, about {lost} lost{first_at(clock.time, beside)}"
    largest = 1e3 * clock.interval * float(off[uneven].max(initial=0.0))
    jitter = f"{counted(odd)} up to {largest:.3g} ms off an even clock of {1e3 * clock.interval:.6g} ms"
    return [
        Verdict(Flag.SUSPECT, beside, warning("lost samples", gaps)),
        Verdict(Flag.SUSPECT, odd, warning("time column", jitter)),
    ]


def _is_exact(stamps: Array) -> bool:
    """Whether all stamps lie on the line through the first and the last, within `EXACT` of its step."""
    interval = float(stamps[-1] - stamps[0]) / (stamps.size - 1) if stamps.size > 2 else 0.0
    return 0 < interval < np.inf and all(
        np.abs(stamps[part] - stamps[0] - interval * np.arange(part.start, part.stop)).max() <= EXACT * interval
        for part in blocks(stamps.size)
    )


def _in_place(kept: NDArray[np.intp], times: Array, size: int) -> Array:
    time = np.full(size, np.nan)
    time[kept] = times
    return time


def _in_order(stamps: Array, *, repeats: bool) -> NDArray[np.intp]:
    """
    Indices of stamps in order, without single ones gone wild; with `repeats` equal ones count as in order.

    Those above all before or those below all after, whichever are more: a few that are too high spoil the first alone.
    """
    finite = np.flatnonzero(np.isfinite(stamps))
    if finite.size > 8:
        times = stamps[finite]
        steps = np.diff(times)
        limit = np.full(finite.size, WILD * float(np.median(steps[steps > 0])) if (steps > 0).any() else np.inf)
        # A wild stamp at an end may be in order all the same, but is further off than all others reach.
        limit[[0, -1]] = np.where(steps[[0, -1]] < 0, limit[0], abs(times[-2] - times[1]))
        finite = finite[np.abs(times - scipy.ndimage.median_filter(times, 5, mode="mirror")) <= limit]
    times = stamps[finite]
    highest, lowest = np.maximum.accumulate(times), np.minimum.accumulate(times[::-1])[::-1]
    above_all_before = times == highest if repeats else np.diff(highest, prepend=-np.inf) > 0
    below_all_after = times == lowest if repeats else np.diff(lowest, append=np.inf) > 0
    return finite[max(above_all_before, below_all_after, key=np.count_nonzero)]


def _resolution(times: Array) -> float:
    """Largest power of ten, s, that all times are multiples of; 0 if it has none."""
    largest = float(np.abs(times).max(initial=0.0))
    for decimals in range(10):
        scaled = times * 10.0**decimals
        tolerance = 1e-6 + 4 * np.finfo(np.float64).eps * largest * 10.0**decimals
        if tolerance < 1e-2 and np.abs(scaled - np.round(scaled)).max(initial=0.0) < tolerance:
            return float(10.0**-decimals)
    return 0.0


def _even(numbers: NDArray[np.intp], times: Array, resolution: float) -> tuple[Array, float]:
    """Line of one slope through times over sample numbers, with a step at each gap; and the slope, s."""
    lag = min(max(LAG, numbers.size // 50), numbers.size - 1)
    interval = float(np.median((times[lag:] - times[:-lag]) / (numbers[lag:] - numbers[:-lag])))
    gaps = np.diff(times) > (np.diff(numbers) + 0.5) * interval + resolution
    stretch = np.concatenate(([0], np.cumsum(gaps)))
    sizes = np.bincount(stretch)
    middle_number = (np.bincount(stretch, numbers) / sizes)[stretch]
    middle_time = (np.bincount(stretch, times) / sizes)[stretch]
    across, along = numbers - middle_number, times - middle_time
    slope = float(across @ along / max(float(across @ across), 1.0))
    return middle_time + slope * across, slope


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
    gaps = np.flatnonzero(np.diff(time) > 1.5 * interval)
    knots, heights = time, values
    if gaps.size:
        # Points on the chord keep the spline from swinging out over a gap.
        filling = [uniform_clock(time[gap] + interval, time[gap + 1] - 0.5 * interval, interval) for gap in gaps]
        knots = np.sort(np.concatenate([time, *filling]))
        heights = np.interp(knots, time, values)
    inside = np.clip(onto, time[0], time[-1])
    spline = scipy.interpolate.CubicSpline(knots, heights) if knots.size > 3 else None
    resampled = np.interp(inside, knots, heights) if spline is None else spline(inside)
    between = np.concatenate(([-np.inf], time, [np.inf]))
    after = np.searchsorted(between, onto)
    before, behind = onto - between[after - 1], between[after] - onto
    is_far = before + behind > (LONGEST_BRIDGE + 0.5) * interval
    return np.asarray(resampled, dtype=np.float64), is_far & (np.minimum(before, behind) > 1e-6 * interval)
