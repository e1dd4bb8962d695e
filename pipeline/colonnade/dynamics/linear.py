"""
The linear model, solved exactly over each sample of a piecewise-linear base motion.

While the block rocks on side s = sgn θ its equation is

    θ̈ = p² [θ − α s − a(t)/g],        a(t) = a₀ + a₁ t within a sample,

and with x = p t its solution from (θ₀, ω₀) is

    θ(t) = θ₀ cosh x + (ω₀/p) sinh x − (α s + a₀/g)(cosh x − 1) − (a₁/(g p))(sinh x − x).

Nothing is integrated step by step; only the times of impacts (θ = 0) and of uplift are searched. All kernels of
this chain stand in this file (see `kernel`).
"""

from __future__ import annotations

from math import cosh, log, pi, sinh, sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.kernel import kernel

Array = NDArray[np.float64]

SHORTEST_ARC = 1e-4
"""Turning points closer than this (in p t) to an arc's start are rounding, not motion: such an arc rises 1e-9 α."""


@kernel
def _sinh_excess(x: float) -> float:
    """Return sinh x − x without the cancellation at small x."""
    if abs(x) > 0.3:
        return sinh(x) - x
    square = x * x
    series = 1.0 + square / 20 * (1.0 + square / 42 * (1.0 + square / 72 * (1.0 + square / 110 * (1.0 + square / 156))))
    return x * square / 6 * series


@kernel
def _state(x: float, angle: float, scaled: float, pull: float, slope: float) -> tuple[float, float]:
    """
    Angle and angular velocity / p after x = p t.

    `scaled` is ω₀/p, `pull` is α s + a₀/g and `slope` is a₁/(g p).
    """
    c, s = cosh(x), sinh(x)
    half = sinh(0.5 * x)
    rise = 2.0 * half * half
    return (
        angle * c + scaled * s - pull * rise - slope * _sinh_excess(x),
        angle * s + scaled * c - pull * s - slope * rise,
    )


@kernel
def _crossing(low: float, high: float, angle: float, scaled: float, pull: float, slope: float, target: float) -> float:
    """Find the one x in [low, high] where θ = target on a monotone piece: Newton kept inside a shrinking bracket."""
    rising = _state(high, angle, scaled, pull, slope)[0] > target
    x = 0.5 * (low + high)
    for _ in range(100):
        value, velocity = _state(x, angle, scaled, pull, slope)
        if (value > target) == rising:
            high = x
        else:
            low = x
        following = x - (value - target) / velocity if velocity != 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= 4e-16 * high or high - low <= 4e-16 * high:
            return following
        x = following
    return x


@kernel
def _turning_points(angle: float, scaled: float, pull: float, slope: float) -> tuple[float, float]:
    """
    Return the x at which the angular velocity is zero, in order; inf where there is none.

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
def _impact(end: float, side: float, angle: float, scaled: float, pull: float, slope: float) -> float:
    """Find the first x in [0, end] at which the block, rocking on `side`, comes to θ = 0; inf where it does not."""
    if side * angle <= 0.0 and side * scaled < 0.0:
        return 0.0
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
def _uplift(
    start: float, end: float, base: float, slope: float, negative: float, positive: float
) -> tuple[float, float]:
    """
    Find when in [start, end] a block at rest uplifts, and to which side; (inf, 0) where it stays.

    `base` is a/g at x = 0 and `slope` its change a₁/(g p) with x; it uplifts to θ < 0 where a/g > `negative`, and to
    θ > 0 where −a/g > `positive`, both strictly.
    """
    at_start, at_end = base + slope * start, base + slope * end
    if at_start > negative:
        return start, -1.0
    if -at_start > positive:
        return start, 1.0
    if at_end > negative:
        return max(start, min(end, (negative - base) / slope)), -1.0
    if -at_end > positive:
        return max(start, min(end, (-positive - base) / slope)), 1.0
    return np.inf, 0.0


@kernel
def survives_free_rocking(angle: float, velocity: float, critical: Array, p: Array, restitution: Array) -> bool:
    """Tell whether the block, left from this state on a base at rest, comes back to stand (closed form)."""
    if angle == 0.0 and velocity == 0.0:
        return True
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    beyond, outward = side * angle - critical[here], side * velocity / p[here]
    if beyond + outward > 0.0:
        return False
    impact = p[here] * sqrt(max(outward * outward - beyond * beyond + critical[here] ** 2, 0.0))
    there = 1 - here
    # What is left after one impact decides both sides: every later impact only takes energy.
    return bool(restitution[here] * impact <= p[there] * critical[there])


@kernel
def propagate(
    base: Array,
    dt: float,
    critical: Array,
    p: Array,
    restitution: Array,
    rest_angle: float,
    angle: float,
    velocity: float,
) -> tuple[Array, Array, Array, Array, float]:
    """
    Propagate the block over the samples of a base motion.

    Parameters
    ----------
    base : ndarray, shape (n,)
        Base acceleration over gravity, a/g.
    dt : float
        Sampling interval, s.
    critical, p, restitution : ndarray, shape (2,)
        α (rad), p (rad/s) and e on the sides θ < 0 and θ > 0; e belongs to the impact that ends an arc on that side.
    rest_angle : float
        As a fraction of α. After an impact whose next arc, under the base acceleration of that instant, would not rise
        above it, the block is at rest until the base acceleration uplifts it again.
    angle, velocity : float
        Initial θ (rad) and ω (rad/s).

    Returns
    -------
    angles, velocities : ndarray, shape (n,)
        θ (rad) and ω (rad/s) at the samples. A block past return goes on by the equation until it lies at ±π/2.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    overturning_time : float
        s, when |θ| passed α for good; NaN where the block came back within the record.
    """
    count = base.size
    angles, velocities = np.empty(count), np.empty(count)
    impact_times, impact_velocities = np.empty(64), np.empty(64)
    impacts = 0
    largest = np.abs(base).max()
    passed, overturning_time = np.nan, np.nan
    resting = angle == 0.0 and velocity == 0.0
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    if side * angle > critical[here]:
        passed = 0.0

    # Closed-form factors of one whole sample, for either side.
    steps = p * dt
    c, s, rise, excess = np.empty(2), np.empty(2), np.empty(2), np.empty(2)
    for k in range(2):
        c[k], s[k] = cosh(steps[k]), sinh(steps[k])
        rise[k] = 2.0 * sinh(0.5 * steps[k]) ** 2
        excess[k] = _sinh_excess(steps[k])

    angles[0], velocities[0] = angle, velocity
    for sample in range(count - 1):
        a0 = base[sample]
        change = base[sample + 1] - a0
        if resting:
            if -critical[1] <= a0 <= critical[0] and -critical[1] <= base[sample + 1] <= critical[0]:
                angles[sample + 1], velocities[sample + 1] = 0.0, 0.0
                continue
        else:
            # A chord lies above a curve by at most h²/8 times its largest second derivative: where both ends are
            # higher than that, no impact hides inside the sample.
            step = steps[here]
            pull = critical[here] * side + a0
            slope = change / step
            scaled = velocity / p[here]
            end_angle = angle * c[here] + scaled * s[here] - pull * rise[here] - slope * excess[here]
            end_scaled = angle * s[here] + scaled * c[here] - pull * s[here] - slope * rise[here]
            lowest = min(side * angle, side * end_angle)
            highest = max(side * angle, side * end_angle)
            if step < 0.5 and lowest > 0.25 * step * step * (highest + critical[here] + largest):
                threshold = critical[here]
                if side * end_angle > threshold:
                    if not side * angle > threshold:
                        passed = dt * (
                            sample + _crossing(0.0, step, angle, scaled, pull, slope, side * threshold) / step
                        )
                    if side * end_angle > threshold + largest and side * end_scaled > 0.0:
                        overturning_time = passed
                angle, velocity = end_angle, end_scaled * p[here]
                angles[sample + 1], velocities[sample + 1] = angle, velocity
                if not np.isnan(overturning_time):
                    _fall(angles, velocities, sample + 1, base, dt, side, critical[here], p[here])
                    break
                continue

        # Something may happen inside this sample: walk through it event by event.
        elapsed = 0.0
        while True:
            if resting:
                rate = change / dt
                x, direction = _uplift(elapsed, dt, a0, rate, critical[0], critical[1])
                if direction == 0.0:
                    angle, velocity = 0.0, 0.0
                    break
                elapsed, side, resting = x, direction, False
                here = 1 if side > 0.0 else 0
                angle, velocity = 0.0, 0.0
                if elapsed >= dt:
                    break
            now = a0 + change * (elapsed / dt)
            end = p[here] * (dt - elapsed)
            pull = critical[here] * side + now
            slope = change / steps[here]
            scaled = velocity / p[here]
            x = _impact(end, side, angle, scaled, pull, slope)
            stop = min(x, end)
            end_angle, end_scaled = _state(stop, angle, scaled, pull, slope)
            threshold = critical[here]
            if x > end and side * end_angle > threshold:
                if not side * angle > threshold:
                    # The last outward pass: beyond it the angle is above α up to the end of the sample.
                    low = 0.0
                    for point in _turning_points(angle, scaled, pull, slope):
                        if (
                            SHORTEST_ARC < point < end
                            and side * _state(point, angle, scaled, pull, slope)[0] < threshold
                        ):
                            low = point
                    passing = _crossing(low, end, angle, scaled, pull, slope, side * threshold)
                    passed = dt * sample + elapsed + passing / p[here]
                if side * end_angle > threshold + largest and side * end_scaled > 0.0:
                    overturning_time = passed
            if x > end:
                angle, velocity = end_angle, end_scaled * p[here]
                break
            elapsed += x / p[here]
            arriving = end_scaled * p[here]
            if impacts == impact_times.size:
                impact_times = np.concatenate((impact_times, np.empty(impacts)))
                impact_velocities = np.concatenate((impact_velocities, np.empty(impacts)))
            impact_times[impacts] = dt * sample + elapsed
            impact_velocities[impacts] = arriving
            impacts += 1
            velocity = restitution[here] * arriving
            angle = 0.0
            side = -side
            here = 1 - here
            holding = critical[here] + side * (a0 + change * (elapsed / dt))
            risen = velocity * velocity / (2.0 * p[here] * p[here])
            if holding >= 0.0 and risen <= rest_angle * critical[here] * holding:
                resting = True
                velocity = 0.0
        angles[sample + 1], velocities[sample + 1] = angle, velocity
        if not np.isnan(overturning_time):
            _fall(angles, velocities, sample + 1, base, dt, side, critical[here], p[here])
            break

    if np.isnan(overturning_time) and not survives_free_rocking(angle, velocity, critical, p, restitution):
        overturning_time = passed if side * angle > critical[here] else dt * (count - 1)
    return angles, velocities, impact_times[:impacts].copy(), impact_velocities[:impacts].copy(), overturning_time


@kernel
def _fall(
    angles: Array, velocities: Array, sample: int, base: Array, dt: float, side: float, critical: float, p: float
) -> None:
    """Go on from `sample` past return: by the equation until the block lies at ±π/2, then still."""
    step = p * dt
    while side * angles[sample] < 0.5 * pi:
        if sample == base.size - 1:
            return
        change = base[sample + 1] - base[sample]
        pull = critical * side + base[sample]
        angle, scaled = _state(step, angles[sample], velocities[sample] / p, pull, change / step)
        sample += 1
        angles[sample], velocities[sample] = angle, scaled * p
    angles[sample:] = side * 0.5 * pi
    velocities[sample:] = 0.0
