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

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

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
def _impact(
    end: float, side: float, angle: float, scaled: float, pull: float, slope: float, critical: float, largest: float
) -> float:
    """
    Find the first x in [0, end] at which the block, rocking on `side`, comes to θ = 0; inf where it does not.

    With h = s θ ≥ 0 and |a/g| ≤ `largest`, h'' lies between −(α + largest) and h + largest: that often tells at once
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
def _uplift(start: float, end: float, base: float, rate: float, thresholds: Array) -> tuple[float, float]:
    """
    Find when in [start, end] a block at rest uplifts, and to which side; (inf, 0) where it stays.

    a/g is base + rate t; it uplifts to θ < 0 where that is above the first threshold, to θ > 0 where −a/g is above
    the second, both strictly.
    """
    for k in range(2):
        sign = 1.0 - 2.0 * k
        if sign * (base + rate * start) > thresholds[k]:
            return start, -sign
    for k in range(2):
        sign = 1.0 - 2.0 * k
        if sign * (base + rate * end) > thresholds[k]:
            return max(start, min(end, (sign * thresholds[k] - base) / rate)), -sign
    return np.inf, 0.0


@kernel
def _restitution(restitution: Array, speeds: Array | None, here: int, velocity: float) -> float:
    """Give e of an impact that ends an arc on side `here`."""
    if speeds is None:
        return float(restitution[here])
    speed, first = abs(velocity), here * speeds.size
    above = int(np.searchsorted(speeds, speed))
    if above == 0 or above == speeds.size:
        return float(restitution[first + min(above, speeds.size - 1)])
    share = (speed - speeds[above - 1]) / (speeds[above] - speeds[above - 1])
    lower, upper = restitution[first + above - 1], restitution[first + above]
    return float(lower + share * (upper - lower))


@kernel
def survives_free_rocking(
    angle: float, velocity: float, critical: Array, p: Array, restitution: Array, speeds: Array | None = None
) -> bool:
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
    return bool(_restitution(restitution, speeds, here, impact) * impact <= p[there] * critical[there])


@kernel
def _march(
    angles: Array, velocities: Array, base: Array, sample: int, side: float, p: float, bounds: Array, factors: Array
) -> int:
    """
    Propagate sample by sample for as long as no impact can hide inside one and |θ| ≤ α; return where that ends.

    A chord lies above a curve by at most x²/8 times its largest second derivative: where both ends are higher than
    that, there is no impact between them; nor where it leaves the one end, or comes to the other, faster than
    (α + largest) x/2. `factors` and `bounds` are those of `_whole_sample`.
    """
    c, s, held, held_rate, now, now_rate, then, then_rate = factors
    critical, limit, floor, quick = bounds
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
def _whole_sample(step: float, critical: float, largest: float) -> tuple[Array, Array]:
    """Coefficients of θ and ω/p over a sample, of what α, a/g at its start and at its end take off each; bounds."""
    rise, excess = _growth(step)
    c, s, mean, mean_rate = 1.0 + rise, step + excess, excess / step, rise / step
    factors = np.array([c, s, rise * critical, s * critical, rise - mean, s - mean_rate, mean, mean_rate])
    return factors, np.array(
        [critical, 0.25 * step**2, 0.25 * step**2 * (critical + largest), 0.5 * step * (critical + largest)]
    )


@kernel
def _still(base: Array, sample: int, negative: float, positive: float) -> int:
    """Last sample up to which a block at rest at `sample` stays so."""
    if not -positive <= base[sample] <= negative:
        return sample
    while sample < base.size - 1 and -positive <= base[sample + 1] <= negative:
        sample += 1
    return sample


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
    speeds: Array | None = None,
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
    speeds : ndarray, shape (m,), optional
        With it `restitution`, shape (2 m,), is e at these |ω| (rad/s) before an impact, linear between them, on the
        one side and then on the other.

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
    angles, velocities = np.zeros(count), np.zeros(count)
    impact_times, impact_velocities = np.empty(64), np.empty(64)
    impacts = 0
    largest = max(base.max(), -base.min())
    passed, overturning_time = np.nan, np.nan
    resting = angle == 0.0 and velocity == 0.0
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    if side * angle > critical[here]:
        passed = 0.0

    steps = p * dt
    factors, bounds = np.empty((2, 8)), np.empty((2, 4))
    for k in range(2):
        factors[k], bounds[k] = _whole_sample(steps[k], critical[k], largest)

    angles[0], velocities[0] = angle, velocity
    sample = 0
    while sample < count - 1:
        reached = sample
        if resting:
            reached = _still(base, sample, critical[0], critical[1])
        elif steps[here] < 0.5:
            reached = _march(angles, velocities, base, sample, side, p[here], bounds[here], factors[here])
        if reached > sample:
            sample, angle, velocity = reached, angles[reached], velocities[reached]
            continue

        # Something may happen inside this sample: walk through it event by event.
        a0, change, elapsed = base[sample], base[sample + 1] - base[sample], 0.0
        while True:
            if resting:
                x, direction = _uplift(elapsed, dt, a0, change / dt, critical)
                angle, velocity = 0.0, 0.0
                if direction == 0.0:
                    break
                elapsed, side, resting = x, direction, False
                here = 1 if side > 0.0 else 0
                if elapsed >= dt:
                    break
            now = a0 + change * (elapsed / dt)
            end = p[here] * (dt - elapsed)
            pull = critical[here] * side + now
            slope = change / steps[here]
            scaled = velocity / p[here]
            x = _impact(end, side, angle, scaled, pull, slope, critical[here], largest)
            stop = min(x, end)
            end_angle, end_scaled = _state(stop, angle, scaled, pull, slope)
            threshold = critical[here]
            if x > end and side * end_angle > threshold:
                if not side * angle > threshold:
                    # The last outward pass: beyond it the angle is above α up to the end of the sample.
                    low = 0.0
                    for point in _turning_points(angle, scaled, pull, slope):
                        inside = SHORTEST_ARC < point < end
                        if inside and side * _state(point, angle, scaled, pull, slope)[0] < threshold:
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
            impact_times[impacts], impact_velocities[impacts] = dt * sample + elapsed, arriving
            impacts += 1
            angle, velocity = 0.0, _restitution(restitution, speeds, here, arriving) * arriving
            side, here = -side, 1 - here
            holding = critical[here] + side * (a0 + change * (elapsed / dt))
            risen = velocity * velocity / (2.0 * p[here] * p[here])
            if holding >= 0.0 and risen <= rest_angle * critical[here] * holding:
                resting, velocity = True, 0.0
        sample += 1
        angles[sample], velocities[sample] = angle, velocity
        if not np.isnan(overturning_time):
            _fall(angles, velocities, sample, base, dt, side, critical[here], p[here])
            break

    if np.isnan(overturning_time) and not survives_free_rocking(angle, velocity, critical, p, restitution, speeds):
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
