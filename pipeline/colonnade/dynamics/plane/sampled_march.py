"""A block through a sampled base motion, step by step: in closed form, or by series of the full equation."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.impact import rebound, survives_free_rocking
from colonnade.dynamics.plane.linear import closed_step, fall, undisturbed, whole_sample
from colonnade.dynamics.plane.nonlinear import BySeries, series_step
from colonnade.dynamics.plane.sides import Pair, Sides, of_side
from colonnade.dynamics.plane.step import Interval
from colonnade.dynamics.plane.uplift import level_uplift, sampled_uplift, uplift_threshold


class March(NamedTuple):
    """
    Where a block is on its way: θ (rad), ω (rad/s), and its side, 0 for θ < 0 and 1 for θ > 0.

    `passed` (s) is when |θ| last passed α outwards; `is_past` says that the block cannot come back.
    """

    angle: float
    velocity: float
    here: int
    is_resting: bool
    passed: float
    is_past: bool


@kernel
def propagate(
    base: Array, dt: float, sides: Sides, angle: float, velocity: float, series: BySeries | None
) -> tuple[Array, Array, Array, Array, float]:
    """
    Propagate the block over the samples of a base motion that is linear between them.

    Parameters
    ----------
    base : ndarray, shape (n,)
        Base acceleration over gravity, a/g.
    dt : float
        Sampling interval, s.
    sides : Sides
    angle, velocity : float
        Initial θ (rad) and ω (rad/s).
    series : BySeries or None
        None for the linear equation in closed form, which knows no vertical motion.

    Returns
    -------
    angles, velocities : ndarray, shape (n,)
        θ (rad) and ω (rad/s) at the samples. A block past return lies at ±π/2 in the end.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    overturning_time : float
        s, when |θ| passed α for good; NaN where the block came back within the record.
    """
    angles, velocities = np.zeros(base.size), np.zeros(base.size)
    angles[0], velocities[0] = angle, velocity
    march, record, count = _start(angle, velocity, sides), np.empty((64, 2)), 0
    linearised, largest = _is_linearised(series), _largest(base)
    (left, right), p = sides.critical, sides.p
    thresholds = uplift_threshold(left, linearised), uplift_threshold(right, linearised)
    whole = whole_sample(-1.0, left, p[0], dt, largest), whole_sample(1.0, right, p[1], dt, largest)
    sample = 0
    while sample < base.size - 1 and not march.is_past:
        # In closed form, samples in which nothing happens are passed over at once.
        if series is None:
            reached = undisturbed(angles, velocities, base, sample, march.is_resting, thresholds, whole[march.here])
            if reached > sample:
                sample = reached
                march = March(
                    angles[sample], velocities[sample], march.here, march.is_resting, march.passed, march.is_past
                )
                continue
        # Something may happen before the next one: impact by impact.
        interval, elapsed = _interval(base, dt, sample, series), 0.0
        while elapsed < dt and not march.is_past:
            march, elapsed, has_landed = _to_impact(
                march, elapsed, interval, sides.critical, sides.p, thresholds, largest, series
            )
            if has_landed:
                if count == record.shape[0]:
                    record = np.concatenate((record, np.empty_like(record)))
                record[count, 0], record[count, 1] = interval.begin + elapsed, march.velocity
                count += 1
                march = _after_impact(march, elapsed, interval, sides, linearised)
        sample += 1
        angles[sample], velocities[sample] = march.angle, march.velocity
    overturning_time = _overturning_time(march, dt * (base.size - 1), sides, linearised)
    if march.is_past:
        _lay(angles, velocities, march.here, base, dt, sample, sides, series)
    times, before = record[:count].T
    return angles, velocities, times.copy(), before.copy(), overturning_time


@kernel
def _largest(base: Array) -> float:
    """Largest magnitude, in one pass."""
    largest = 0.0
    for value in base:
        largest = max(largest, abs(value))
    return largest


@kernel
def _start(angle: float, velocity: float, sides: Sides) -> March:
    """Begin at rest or on the side to which the block leans or moves; it may lean beyond α."""
    here = 1 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else 0
    passed = 0.0 if abs(angle) > of_side(sides.critical, here) else np.nan
    return March(angle, velocity, here, angle == 0.0 and velocity == 0.0, passed, False)


@kernel
def _is_linearised(series: BySeries | None) -> bool:
    if series is None:
        return True
    return series.is_linearised


@kernel
def _interval(base: Array, dt: float, sample: int, series: BySeries | None) -> Interval:
    """Give the motion from a sample to the next."""
    if series is None:
        return Interval(dt * sample, dt, base[sample], base[sample + 1], 1.0, 1.0)
    lift = series.vertical
    return Interval(dt * sample, dt, base[sample], base[sample + 1], 1.0 + lift[sample], 1.0 + lift[sample + 1])


@kernel
def _to_impact(
    march: March,
    elapsed: float,
    interval: Interval,
    critical: Pair,
    p: Pair,
    thresholds: Pair,
    largest: float,
    series: BySeries | None,
) -> tuple[March, float, bool]:
    """
    Follow the block to its next impact, to the end of the interval, or until it cannot come back.

    Returns the state, before the impact if there is one; when in the interval, s; and whether there is an impact.
    """
    angle, velocity, here, is_resting, passed, is_past = march
    while elapsed < interval.length and not is_past:
        # At rest, up to the uplift.
        if is_resting:
            elapsed, there = _uplift(elapsed, interval, thresholds, series)
            if elapsed == np.inf:
                break
            here, is_resting = there, False
            if elapsed >= interval.length:
                break

        # One step, as far as the model's own arc goes.
        side, alpha, p_here = 2.0 * here - 1.0, of_side(critical, here), of_side(p, here)
        if series is None:
            step = closed_step(interval, elapsed, angle, velocity, side, alpha, p_here, largest)
        else:
            step = series_step(interval, elapsed, angle, velocity, side, alpha, p_here, series)
        has_landed, elapsed, angle, velocity, new_passed, is_past = step
        if not np.isnan(new_passed):
            passed = new_passed

        if has_landed:
            return March(angle, velocity, here, is_resting, passed, is_past), elapsed, True
    return March(angle, velocity, here, is_resting, passed, is_past), elapsed, False


@kernel
def _after_impact(march: March, elapsed: float, interval: Interval, sides: Sides, linearised: bool) -> March:
    """Give what an impact leaves, and on which side the block goes on."""
    share = elapsed / interval.length
    pull = interval.base + (interval.next_base - interval.base) * share
    weight = interval.weight + (interval.next_weight - interval.weight) * share
    leaving, is_resting = rebound(march.velocity, march.here, weight, pull, sides, linearised)
    return March(march.angle, leaving, 1 - march.here, is_resting, march.passed, march.is_past)


@kernel
def _uplift(elapsed: float, interval: Interval, thresholds: Pair, series: BySeries | None) -> tuple[float, int]:
    """Find when after `elapsed` a block at rest uplifts in an interval, and to which side; (inf, 0) if it stays."""
    _begin, dt, now, then, u0, u1 = interval
    if series is None:
        return level_uplift(elapsed, dt, now, (then - now) / dt, thresholds)
    first = (now - thresholds[0] * u0, -now - thresholds[1] * u0)
    last = (then - thresholds[0] * u1, -then - thresholds[1] * u1)
    return sampled_uplift(elapsed, dt, first, last)


@kernel
def _overturning_time(march: March, end: float, sides: Sides, linearised: bool) -> float:
    """Give when the block passed α for good, under the motion or left to itself where that ends; NaN if it stands."""
    side = 2.0 * march.here - 1.0
    height, rate = side * march.angle, side * march.velocity / of_side(sides.p, march.here)
    if march.is_past:
        return march.passed
    if survives_free_rocking(height, rate, march.here, sides, linearised):
        return np.nan
    return march.passed if height > of_side(sides.critical, march.here) else end


@kernel
def _lay(
    angles: Array,
    velocities: Array,
    here: int,
    base: Array,
    dt: float,
    sample: int,
    sides: Sides,
    series: BySeries | None,
) -> None:
    """Fill in the samples of a block past return: in closed form it goes on until it lies, by series it lies."""
    if series is None:
        sample = fall(angles, velocities, sample, base, dt, here, of_side(sides.critical, here), of_side(sides.p, here))
    angles[sample:] = (2.0 * here - 1.0) * 0.5 * pi
    velocities[sample:] = 0.0
