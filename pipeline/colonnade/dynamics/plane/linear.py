"""
The linear model, solved exactly over each sample of a piecewise-linear base motion.

While the block rocks on side s = sgn θ its equation is

    θ̈ = p² [θ − α s − a(t)/g],        a(t) = a₀ + a₁ t within a sample,

and with x = p t its solution from (θ₀, ω₀) is

    θ(t) = θ₀ cosh x + (ω₀/p) sinh x − (α s + a₀/g)(cosh x − 1) − (a₁/(g p))(sinh x − x).

Nothing is integrated step by step; only the times of impacts (θ = 0) and of uplift are searched.
"""

from __future__ import annotations

from math import log, pi, sinh, sqrt
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.sides import Pair
from colonnade.dynamics.plane.step import Interval, Step

LONGEST_SAMPLE = 0.5
"""In x = p t: the bounds of longer samples exclude too few impacts for whole samples to be tried."""

SHORTEST_ARC = 1e-4
"""Turning points closer than this (in p t) to an arc's start are rounding, not motion: such an arc rises 1e-9 α."""

NEARLY = 1e-6
"""Newton's step over the root, below which Halley's has reached rounding: further ones only wander in it."""


@kernel
def _growth(x: float) -> tuple[float, float]:
    """Return cosh x − 1 and sinh x − x without the cancellation at small x."""
    if abs(x) > 0.3:
        half = sinh(0.5 * x)
        return 2.0 * half * half, sinh(x) - x
    q = x * x
    rise = 1 / 2 + q * (1 / 24 + q * (1 / 720 + q * (1 / 40320 + q * (1 / 3628800 + q / 479001600))))
    excess = 1 / 6 + q * (1 / 120 + q * (1 / 5040 + q * (1 / 362880 + q * (1 / 39916800 + q / 6227020800))))
    return q * rise, x * q * excess


@kernel
def _state(x: float, angle: float, scaled: float, pull: float, slope: float) -> tuple[float, float]:
    """
    Angle and angular velocity / p after x = p t.

    `scaled` is ω₀/p, `pull` is α s + a₀/g and `slope` is a₁/(g p).
    """
    rise, excess = _growth(x)
    s = x + excess
    return (
        angle + angle * rise + scaled * s - pull * rise - slope * excess,
        angle * s + scaled + scaled * rise - pull * s - slope * rise,
    )


@kernel
def _crossing(low: float, high: float, angle: float, scaled: float, pull: float, slope: float, target: float) -> float:
    """Find the one x in [low, high] where θ = target on a monotone piece: Halley's steps in a shrinking bracket."""
    first, last = _state(low, angle, scaled, pull, slope)[0], _state(high, angle, scaled, pull, slope)[0]
    rising = last > target
    x = low + (high - low) * (target - first) / (last - first)
    if not low < x < high:
        x = 0.5 * (low + high)
    # From far out, where θ grows as exp x, a step comes in by no more than 2 in x.
    for _ in range(500):
        value, velocity = _state(x, angle, scaled, pull, slope)
        if (value > target) == rising:
            high = x
        else:
            low = x
        newton = (value - target) / velocity
        following = x - newton / (1.0 - 0.5 * newton * (value - pull - slope * x) / velocity)
        if abs(newton) <= NEARLY * x:
            return min(max(following, low), high)
        if not low < following < high:
            following = 0.5 * (low + high)
        if high - low <= 4e-16 * high:
            return following
        x = following
    return x


@kernel
def _turning_points(angle: float, scaled: float, pull: float, slope: float) -> tuple[float, float]:
    """
    Return the x at which the angular velocity is zero, in order; inf if the arc has no such point.

    The velocity is A sinh x + B cosh x + C, a quadratic in y = exp x: (A + B) y² + 2 C y + (B − A) = 0.
    """
    a, b, c = angle - pull, scaled - slope, slope
    square, constant = a + b, b - a
    first, second = np.inf, np.inf
    discriminant = c * c - square * constant
    if discriminant < 0.0:
        return first, second
    root = -(c + sqrt(discriminant)) if c >= 0.0 else -(c - sqrt(discriminant))
    if square != 0.0 and root / square > 1.0:
        first = log(root / square)
    if root != 0.0 and constant / root > 1.0:
        second = log(constant / root)
    return min(first, second), max(first, second)


@kernel
def _impact(
    end: float, side: float, angle: float, scaled: float, pull: float, slope: float, critical: float, largest: float
) -> float:
    """
    Find the first x in [0, end] at which the block, rocking on `side`, comes to θ = 0; inf where it does not.

    With h = s θ ≥ 0 and |a/g| ≤ `largest`, h'' is between −(α + largest) and h + largest: that often tells at once
    that the block rises too fast to come down, or falls throughout.
    """
    height, climb = side * angle, side * scaled
    if height <= 0.0 and climb < 0.0:
        return 0.0
    if height >= 0.0 and climb > 0.5 * end * (critical + largest):
        return np.inf
    if climb < -end * (height + largest):
        if side * _state(end, angle, scaled, pull, slope)[0] >= 0.0:
            return np.inf
        return _crossing(0.0, end, angle, scaled, pull, slope, 0.0)
    first, second = _turning_points(angle, scaled, pull, slope)
    low = 0.0
    for point in (first, second, end):
        if point < SHORTEST_ARC and point < end:
            continue
        high = min(point, end)
        if side * _state(high, angle, scaled, pull, slope)[0] < 0.0:
            return _crossing(low, high, angle, scaled, pull, slope, 0.0)
        if high == end:
            break
        low = high
    return np.inf


@kernel
def closed_step(
    interval: Interval,
    elapsed: float,
    angle: float,
    velocity: float,
    side: float,
    critical: float,
    p: float,
    largest: float,
) -> Step:
    """
    Follow an arc to its impact or to the end of an interval.

    Parameters
    ----------
    interval : Interval
        Its weights are not used.
    elapsed, angle, velocity : float
        s into the interval; θ (rad) and ω (rad/s) there.
    side, critical, p : float
        ±1; α (rad) and p (rad/s) on that side.
    largest : float
        Largest |a/g| of the motion.
    """
    dt, change = interval.length, interval.next_base - interval.base
    end = p * (dt - elapsed)
    pull = critical * side + (interval.base + change * (elapsed / dt))
    slope, scaled = change / (p * dt), velocity / p
    x = _impact(end, side, angle, scaled, pull, slope, critical, largest)
    end_angle, end_scaled = _state(min(x, end), angle, scaled, pull, slope)
    if x <= end:
        return Step(True, elapsed + x / p, 0.0, end_scaled * p, np.nan, False)
    # Only what is above α at the end of a sample can have passed for good.
    passed, height = np.nan, side * end_angle
    if height > critical and not side * angle > critical:
        passed = interval.begin + elapsed + _passing(end, side, angle, scaled, pull, slope, critical) / p
    never_returns = height > critical + largest and side * end_scaled > 0.0
    return Step(False, dt, end_angle, end_scaled * p, passed, never_returns)


@kernel
def _passing(end: float, side: float, angle: float, scaled: float, pull: float, slope: float, critical: float) -> float:
    """Find where in [0, end] the block last passes α outwards; beyond it the angle is above α up to the end."""
    low = 0.0
    for point in _turning_points(angle, scaled, pull, slope):
        inside = SHORTEST_ARC < point < end
        if inside and side * _state(point, angle, scaled, pull, slope)[0] < critical:
            low = point
    return _crossing(low, end, angle, scaled, pull, slope, side * critical)


class WholeSample(NamedTuple):
    """
    What it takes to pass over whole samples on one side.

    Attributes
    ----------
    side, p, step, critical : float
        ±1, p (rad/s), p dt and α.
    factors : tuple of float
        Coefficients of θ and ω/p over a sample, and of what α and a/g at its start and end take off each.
    bounds : tuple of float
        What excludes an impact inside a sample, see `_march`.
    """

    side: float
    p: float
    step: float
    critical: float
    factors: tuple[float, float, float, float, float, float, float, float]
    bounds: tuple[float, float, float]


@kernel
def whole_sample(side: float, critical: float, p: float, dt: float, largest: float) -> WholeSample:
    """Prepare one side for samples of the length `dt` under a motion of at most `largest` a/g."""
    step = p * dt
    rise, excess = _growth(step)
    c, s, mean, mean_rate = 1.0 + rise, step + excess, excess / step, rise / step
    factors = c, s, rise * critical, s * critical, rise - mean, s - mean_rate, mean, mean_rate
    limit, most = 0.25 * step**2, critical + largest
    return WholeSample(side, p, step, critical, factors, (limit, limit * most, 0.5 * step * most))


@kernel
def undisturbed(
    angles: Array,
    velocities: Array,
    base: Array,
    sample: int,
    is_resting: bool,
    thresholds: Pair,
    whole: WholeSample,
) -> int:
    """
    Pass over the samples in which nothing happens, filling in their state; return the last that is reached.

    `thresholds` are those of `level_uplift`, `whole` is that of the side on which the block rocks.
    """
    if is_resting:
        return _still(base, sample, thresholds)
    if whole.step >= LONGEST_SAMPLE:
        return sample
    return _march(angles, velocities, base, sample, whole)


@kernel
def _march(angles: Array, velocities: Array, base: Array, sample: int, whole: WholeSample) -> int:
    """
    Propagate sample by sample for as long as no impact can hide inside one and |θ| ≤ α; return where that ends.

    A chord is above a curve by at most x²/8 times its largest second derivative: where both ends are higher than
    that, there is no impact between them; nor where it leaves the one end, or comes to the other, faster than
    (α + largest) x/2.
    """
    side, p, _step, critical, factors, bounds = whole
    c, s, held, held_rate, now, now_rate, then, then_rate = factors
    limit, floor, quick = bounds
    height, climb = side * angles[sample], side * velocities[sample] / p
    back = side * p
    while sample < base.size - 1:
        push, following = side * base[sample], side * base[sample + 1]
        end = c * height + s * climb - (held + now * push + then * following)
        end_climb = s * height + c * climb - (held_rate + now_rate * push + then_rate * following)
        clear = climb > quick or min(height, end) > floor + limit * max(height, end) or end_climb < -quick
        if end > critical or end < 0.0 or not clear:
            return sample
        height, climb = end, end_climb
        sample += 1
        angles[sample], velocities[sample] = side * height, back * climb
    return sample


@kernel
def _still(base: Array, sample: int, thresholds: Pair) -> int:
    """Last sample up to which a block at rest at `sample` stays so."""
    negative, positive = thresholds
    for following in range(sample, base.size):
        if not -positive <= base[following] <= negative:
            return max(sample, following - 1)
    return int(base.size - 1)


@kernel
def fall(
    angles: Array, velocities: Array, sample: int, base: Array, dt: float, here: int, critical: float, p: float
) -> int:
    """Go on from `sample` past return by the equation; return the sample from which the block lies at ±π/2."""
    step, side = p * dt, 2.0 * here - 1.0
    while side * angles[sample] < 0.5 * pi:
        if sample == base.size - 1:
            return base.size
        change = base[sample + 1] - base[sample]
        pull = critical * side + base[sample]
        angle, scaled = _state(step, angles[sample], velocities[sample] / p, pull, change / step)
        sample += 1
        angles[sample], velocities[sample] = angle, scaled * p
    return sample
