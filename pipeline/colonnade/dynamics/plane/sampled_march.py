"""A block through a sampled base motion, step by step: in closed form, or by series of the full equation."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.impact import rebound, survives_free_rocking
from colonnade.dynamics.plane.linear import closed_step, fall, undisturbed, whole_samples
from colonnade.dynamics.plane.nonlinear import BySeries, series_step
from colonnade.dynamics.plane.sides import Sides
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


class Impacts(NamedTuple):
    """Time (s) and angular velocity before (rad/s) of the impacts so far, the first `impact_count` of shape (m, 2)."""

    record: Array
    impact_count: int


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
    march, impacts = _start(angle, velocity, sides), Impacts(np.empty((64, 2)), 0)
    linearised, largest = _is_linearised(series), max(base.max(), -base.min())
    thresholds = np.array([uplift_threshold(critical, linearised) for critical in sides.critical])
    whole = whole_samples(sides, dt, largest)
    sample = 0
    while sample < base.size - 1 and not march.is_past:
        # In closed form, samples in which nothing happens are passed over at once.
        if series is None:
            reached = undisturbed(angles, velocities, base, sample, march.here, march.is_resting, dt, sides, whole)
            if reached > sample:
                sample = reached
                march = March(
                    angles[sample], velocities[sample], march.here, march.is_resting, march.passed, march.is_past
                )
                continue
        # Something may happen inside this sample: event by event.
        march, impacts = _through(march, impacts, base, dt, sample, sides, thresholds, largest, series)
        sample += 1
        angles[sample], velocities[sample] = march.angle, march.velocity
    overturning_time = _overturning_time(march, dt * (base.size - 1), sides, linearised)
    if march.is_past:
        _lay(angles, velocities, march.here, base, dt, sample, sides, series)
    times, before = impacts.record[: impacts.impact_count].T
    return angles, velocities, times.copy(), before.copy(), overturning_time


@kernel
def _start(angle: float, velocity: float, sides: Sides) -> March:
    """Begin at rest or on the side to which the block leans or moves; it may lean beyond α."""
    here = 1 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else 0
    passed = 0.0 if abs(angle) > sides.critical[here] else np.nan
    return March(angle, velocity, here, angle == 0.0 and velocity == 0.0, passed, False)


@kernel
def _is_linearised(series: BySeries | None) -> bool:
    if series is None:
        return True
    return series.is_linearised


@kernel
def _through(
    march: March,
    impacts: Impacts,
    base: Array,
    dt: float,
    sample: int,
    sides: Sides,
    thresholds: Array,
    largest: float,
    series: BySeries | None,
) -> tuple[March, Impacts]:
    """Follow the block to the end of a sample, or until it cannot come back."""
    angle, velocity, here, is_resting, passed, is_past = march
    record, count = impacts
    elapsed = 0.0
    while elapsed < dt and not is_past:
        # At rest, up to the uplift.
        if is_resting:
            instant, side = _uplift(elapsed, base, dt, sample, thresholds, series)
            if instant == np.inf:
                break
            elapsed, here, is_resting = instant, side, False
            if elapsed >= dt:
                break

        # One step, as far as the model's own arc goes.
        if series is None:
            step = closed_step(base, sample, dt, elapsed, angle, velocity, here, sides, largest)
        else:
            step = series_step(base, sample, dt, elapsed, angle, velocity, here, sides, series)
        has_landed, elapsed, angle, velocity, new_passed, is_past = step
        if not np.isnan(new_passed):
            passed = new_passed

        # The impact: what it leaves, and on which side the block goes on.
        if has_landed:
            if count == record.shape[0]:
                record = np.concatenate((record, np.empty_like(record)))
            record[count, 0], record[count, 1] = dt * sample + elapsed, velocity
            count += 1
            share = elapsed / dt
            pull = base[sample] + (base[sample + 1] - base[sample]) * share
            weight = _weight(series, sample, share)
            velocity, is_resting = rebound(velocity, here, weight, pull, sides, _is_linearised(series))
            here = 1 - here
    return March(angle, velocity, here, is_resting, passed, is_past), Impacts(record, count)


@kernel
def _weight(series: BySeries | None, sample: int, share: float) -> float:
    """Return 1 + v/g of the base, a share of a sample on."""
    if series is None:
        return 1.0
    now, then = 1.0 + series.vertical[sample], 1.0 + series.vertical[sample + 1]
    return float(now + (then - now) * share)


@kernel
def _uplift(
    elapsed: float, base: Array, dt: float, sample: int, thresholds: Array, series: BySeries | None
) -> tuple[float, int]:
    """Find when after `elapsed` a block at rest uplifts within a sample, and on which side; (inf, 0) where it stays."""
    now, change = base[sample], base[sample + 1] - base[sample]
    if series is None:
        return level_uplift(elapsed, dt, now, change / dt, thresholds)
    then, u0, u1 = now + change, 1.0 + series.vertical[sample], 1.0 + series.vertical[sample + 1]
    first = (now - thresholds[0] * u0, -now - thresholds[1] * u0)
    last = (then - thresholds[0] * u1, -then - thresholds[1] * u1)
    return sampled_uplift(elapsed, dt, first, last)


@kernel
def _overturning_time(march: March, end: float, sides: Sides, linearised: bool) -> float:
    """Give when the block passed α for good, under the motion or left to itself where that ends; NaN if it stands."""
    side = 2.0 * march.here - 1.0
    height, rate = side * march.angle, side * march.velocity / sides.p[march.here]
    if march.is_past:
        return march.passed
    if survives_free_rocking(height, rate, march.here, sides, linearised):
        return np.nan
    return march.passed if height > sides.critical[march.here] else end


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
        sample = fall(angles, velocities, sample, base, dt, here, sides.critical[here], sides.p[here])
    angles[sample:] = (2.0 * here - 1.0) * 0.5 * pi
    velocities[sample:] = 0.0
