"""
The full equation, by Taylor series with event location on the series themselves.

While the block rocks on side s = sgn θ its equation is

    θ̈ = −p² [ (1 + v/g) sin(α s − θ) + (a/g) cos(α s − θ) ],

or with ψ = α s − θ and x = p t:  ψ'' = u(x) sin ψ + b(x) cos ψ,  where u = 1 + v/g and b = a/g are linear within a
sample (v is the vertical acceleration of the base). Sine and cosine of a series follow from it by recurrence, so that
each step has as many terms as rounding asks for. |ψ''| ≤ |u| + |b|: with that bound no impact inside a step can be
missed. The same kernels solve the linearised equation, ψ'' = u(x) ψ + b(x), which has no closed form once u changes.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt, tan

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

ORDER = 18
"""Most terms of a series; short steps need fewer."""

LONGEST_STEP = 0.25
"""
In x = p t; shorter where |ψ'| or |ψ''| are large. The series converges far beyond; 0.25¹⁸ is 1e-11 of coefficients
that fall as well.
"""

NEGLIGIBLE = 1e-18
"""In rad: a series ends where two terms in a row are smaller than this at the end of its step."""

SHORTEST_ARC = 1e-4
"""In x: an arc this short rises 1e-9 α, below any rest rule; it is stepped over where an uplift begins."""

LARGEST_SINE = 1.6
"""What multiplies u is at most sin ψ ≤ 1, or |ψ| ≤ π/2 in the linearised equation up to where the block lies."""


@kernel
def _expand(
    work: Array,
    angle: float,
    velocity: float,
    base: float,
    slope: float,
    lift: float,
    lift_slope: float,
    step: float,
    linearised: bool,
) -> int:
    """
    Fill work[0] with the Taylor coefficients of ψ about x = 0, as many as `step` needs; return how many.

    From ψ, ψ', b = base + slope x and u = lift + lift_slope x. work[1] and work[2] get those of sin ψ and cos ψ.
    """
    series, sine, cosine = work[0], work[1], work[2]
    series[0], series[1] = angle, velocity
    sine[0], cosine[0] = (angle, 1.0) if linearised else (sin(angle), cos(angle))
    power, small = step, 0
    for k in range(series.size - 2):
        if k > 0 and linearised:
            sine[k], cosine[k] = series[k], 0.0
        elif k > 0:
            rising, falling = 0.0, 0.0
            for j in range(1, k + 1):
                rising += j * series[j] * cosine[k - j]
                falling += j * series[j] * sine[k - j]
            sine[k], cosine[k] = rising / k, -falling / k
        forcing = lift * sine[k] + base * cosine[k]
        if k > 0:
            forcing += lift_slope * sine[k - 1] + slope * cosine[k - 1]
        series[k + 2] = forcing / ((k + 1) * (k + 2))
        power *= step
        small = small + 1 if abs(series[k + 2]) * power < NEGLIGIBLE else 0
        if small == 2:
            return k + 3
    return int(series.size)


@kernel
def _value(series: Array, x: float) -> tuple[float, float, float]:
    """Value and first two derivatives of a series (Horner)."""
    value, first, half_second = 0.0, 0.0, 0.0
    for k in range(series.size - 1, -1, -1):
        half_second = half_second * x + first
        first = first * x + value
        value = value * x + series[k]
    return value, first, 2.0 * half_second


@kernel
def _first_landing(height: Array, end: float, bound: float, slope: float) -> float:
    """
    Find the first x in [0, end] where the block comes down to θ = 0; inf where it does not.

    `height` is the series of s θ, `bound` is at least |u| + |b| and `slope` their change. Over a width w a curve leaves
    its chord by at most w² bound/8, and its own parabola by at most w³ J/6 with J ≥ |ψ'''|: what these exclude is
    passed over, what they cannot is halved.
    """
    left = 0.0
    low, climb, curve = _value(height, left)
    if low <= 0.0 and climb < 0.0:
        return left
    if low <= 0.0 and climb <= 0.0:
        left = min(end, SHORTEST_ARC)
        low, climb, curve = _value(height, left)
    while left < end:
        width = end - left
        while True:
            high, descent, bend = _value(height, left + width)
            jerk = bound * (abs(climb) + bound * width) + slope
            rising = climb >= 0.0 and climb + 0.5 * curve * width >= jerk * width * width / 6.0
            if rising or min(low, high) > 0.125 * bound * width * width:
                left, low, climb, curve = left + width, high, descent, bend
                break
            if high < 0.0 and max(climb, descent) < 0.0 and -min(climb, descent) > bound * width:
                return _landing(height, left, left + width)
            width *= 0.5
            if width < 1e-7:
                if high < 0.0:
                    return left + width
                left, low, climb, curve = left + width, high, descent, bend
                break
    return np.inf


@kernel
def _landing(height: Array, low: float, high: float) -> float:
    """Root of s θ on a falling piece: Newton kept inside a shrinking bracket."""
    x = 0.5 * (low + high)
    for _ in range(80):
        value, climb, _curve = _value(height, x)
        if value > 0.0:
            low = x
        else:
            high = x
        following = x - value / climb
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= 4e-16 * high:
            return following
        x = following
    return x


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
def _hill(angle: float, linearised: bool) -> float:
    """Potential over m g R at ψ; 0 where the centre of mass is above the pole."""
    return -0.5 * angle * angle if linearised else -2.0 * sin(0.5 * angle) ** 2


@kernel
def survives_free_rocking(
    angle: float,
    velocity: float,
    critical: Array,
    p: Array,
    restitution: Array,
    speeds: Array | None = None,
    linearised: bool = False,
) -> bool:
    """Tell whether the block, left from this state on a base at rest, comes back to stand (by its energy)."""
    if angle == 0.0 and velocity == 0.0:
        return True
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    there = 1 - here
    outward = side * velocity / p[here]
    beyond = side * angle > critical[here]
    energy = 0.5 * outward * outward + _hill(critical[here] - side * angle, linearised)
    if (beyond and (outward >= 0.0 or energy <= 0.0)) or (not beyond and outward > 0.0 and energy > 0.0):
        return False
    arriving = p[here] * sqrt(max(2.0 * (energy - _hill(critical[here], linearised)), 0.0))
    after = _restitution(restitution, speeds, here, arriving) * arriving / p[there]
    return bool(0.5 * after * after + _hill(critical[there], linearised) <= 0.0)


@kernel
def _uplift(start: float, end: float, first: Array, last: Array) -> tuple[float, int]:
    """
    Find when in [start, end] a block at rest uplifts, and on which side; (inf, 0) where it stays.

    `first` and `last` are the moments about the poles, over m g R cos α, that uplift it to θ < 0 and to θ > 0, at the
    ends of [0, end]; they change linearly.
    """
    instant, chosen = np.inf, 0
    for k in range(2):
        now = first[k] + (last[k] - first[k]) * (start / end)
        if now > 0.0:
            return start, k
        if last[k] > 0.0:
            crossing = max(start, min(end, end * -first[k] / (last[k] - first[k])))
            if crossing < instant:
                instant, chosen = crossing, k
    return instant, chosen


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
    vertical: Array | None = None,
    linearised: bool = False,
) -> tuple[Array, Array, Array, Array, float]:
    """
    Propagate the block over the samples of a base motion; arguments and results as `linear.propagate`.

    `vertical` is the vertical acceleration of the base over gravity, shape (n,), above −1. A block that reaches ±π/2
    lies there and has overturned.
    """
    count = base.size
    angles, velocities = np.empty(count), np.empty(count)
    impact_times, impact_velocities = np.empty(64), np.empty(64)
    impacts = 0
    work = np.empty((3, ORDER + 1))
    passed, overturning_time = np.nan, np.nan
    resting = angle == 0.0 and velocity == 0.0
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    if side * angle > critical[here]:
        passed = 0.0
    # Per unit of u, what holds the block down on either side: against b, and against rising.
    thresholds, grips, leans = critical.copy(), critical.copy(), np.ones(2)
    if not linearised:
        for k in range(2):
            thresholds[k], grips[k], leans[k] = tan(critical[k]), sin(critical[k]), cos(critical[k])
    first, last = np.empty(2), np.empty(2)

    angles[0], velocities[0] = angle, velocity
    for sample in range(count - 1):
        a0, change = base[sample], base[sample + 1] - base[sample]
        u0, u1 = 1.0, 1.0
        if vertical is not None:
            u0, u1 = 1.0 + vertical[sample], 1.0 + vertical[sample + 1]
        lifting = u1 - u0
        bound = LARGEST_SINE * max(abs(u0), abs(u1)) + max(abs(a0), abs(base[sample + 1]))
        elapsed = 0.0
        while elapsed < dt:
            if resting:
                first[0], first[1] = a0 - thresholds[0] * u0, -a0 - thresholds[1] * u0
                last[0], last[1] = a0 + change - thresholds[0] * u1, -a0 - change - thresholds[1] * u1
                instant, here_next = _uplift(elapsed, dt, first, last)
                if instant == np.inf:
                    break
                elapsed, here, resting = instant, here_next, False
                side = 2.0 * here - 1.0
                angle, velocity = 0.0, 0.0
                if elapsed >= dt:
                    break
            remaining = p[here] * (dt - elapsed)
            step = min(remaining, LONGEST_STEP / max(1.0, abs(velocity) / p[here], 0.5 * sqrt(bound)))
            slope, lift_slope = change / (p[here] * dt), lifting / (p[here] * dt)
            now, lift = a0 + change * (elapsed / dt), u0 + lifting * (elapsed / dt)
            scaled = side * velocity / p[here]
            terms = _expand(
                work, critical[here] * side - angle, -side * scaled, now, slope, lift, lift_slope, step, linearised
            )
            # From ψ to the height s θ above the base: without the cancellation of α s − ψ near it.
            height = work[0, :terms]
            height *= -side
            height[0] = side * angle
            before = height[0]
            x = _first_landing(height, step, bound, abs(slope) + LARGEST_SINE * abs(lift_slope))
            stop = min(x, step)
            value, climb, _curve = _value(height, stop)
            angle, velocity = side * value, side * climb * p[here]
            if value > critical[here] and not before > critical[here]:
                passed = dt * sample + elapsed + _passing(height, stop, critical[here]) / p[here]
            if x > step:
                elapsed = dt if step == remaining else elapsed + step / p[here]
                if side * angle >= 0.5 * pi:
                    overturning_time = passed
                    break
                continue
            elapsed += x / p[here]
            if impacts == impact_times.size:
                impact_times = np.concatenate((impact_times, np.empty(impacts)))
                impact_velocities = np.concatenate((impact_velocities, np.empty(impacts)))
            impact_times[impacts], impact_velocities[impacts] = dt * sample + elapsed, velocity
            impacts += 1
            velocity, angle, side = _restitution(restitution, speeds, here, velocity) * velocity, 0.0, -side
            here = 1 - here
            share = elapsed / dt
            holding = grips[here] * (u0 + lifting * share) + side * (a0 + change * share) * leans[here]
            risen = velocity * velocity / (2.0 * p[here] * p[here])
            if holding >= 0.0 and risen <= rest_angle * critical[here] * holding:
                resting, velocity = True, 0.0
        if not np.isnan(overturning_time):
            angles[sample + 1 :], velocities[sample + 1 :] = side * 0.5 * pi, 0.0
            break
        angles[sample + 1], velocities[sample + 1] = (0.0, 0.0) if resting else (angle, velocity)

    if np.isnan(overturning_time) and not survives_free_rocking(
        angle, velocity, critical, p, restitution, speeds, linearised
    ):
        overturning_time = passed if side * angle > critical[here] else dt * (count - 1)
    return angles, velocities, impact_times[:impacts].copy(), impact_velocities[:impacts].copy(), overturning_time


@kernel
def _passing(height: Array, end: float, critical: float) -> float:
    """Find x in [0, end] where s θ passes α outwards, by bisection."""
    low, high = 0.0, end
    for _ in range(60):
        middle = 0.5 * (low + high)
        if _value(height, middle)[0] < critical:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
