"""
The nonlinear model, by Taylor series with event location on the series themselves.

While the block rocks on side s = sgn θ its equation is

    θ̈ = −p² [ sin(α s − θ) + (a/g) cos(α s − θ) ],

or with ψ = α s − θ and x = p t:  ψ'' = sin ψ + b(x) cos ψ,  b = a/g linear within a sample. Sine and cosine of a series
follow from it by recurrence, so that each step has as many terms as rounding asks for. |ψ''| ≤ 1 + |b|: with that
bound no impact inside a step can be missed. All kernels of this chain stand in this file (see `kernel`).
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt, tan

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.kernel import kernel

Array = NDArray[np.float64]

ORDER = 18
"""Terms of a series; the step is chosen so that the last ones are below rounding."""

LONGEST_STEP = 0.25
"""In x = p t. The series converges far beyond; 0.25¹⁸ is 1e-11 of coefficients that fall as well."""

SHORTEST_ARC = 1e-4
"""In x: an arc this short rises 1e-9 α, below any rest rule; it is stepped over where an uplift begins."""


@kernel
def _expand(series: Array, angle: float, velocity: float, base: float, slope: float) -> None:
    """Fill `series` with the Taylor coefficients of ψ about x = 0 from ψ, ψ' and b = base + slope x."""
    count = series.size
    sine, cosine = np.empty(count), np.empty(count)
    series[0], series[1] = angle, velocity
    sine[0], cosine[0] = sin(angle), cos(angle)
    for k in range(count - 2):
        if k > 0:
            rising, falling = 0.0, 0.0
            for j in range(1, k + 1):
                rising += j * series[j] * cosine[k - j]
                falling += j * series[j] * sine[k - j]
            sine[k], cosine[k] = rising / k, -falling / k
        forcing = base * cosine[k] + (slope * cosine[k - 1] if k > 0 else 0.0)
        series[k + 2] = (sine[k] + forcing) / ((k + 1) * (k + 2))


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
def _first_landing(height: Array, end: float, largest: float, slope: float) -> float:
    """
    Find the first x in [0, end] where the block comes down to θ = 0; inf where it does not.

    `height` is the series of s θ, `largest` the largest |b| and `slope` its change. Over a width w a curve leaves its
    chord by at most w² (1 + |b|)/8, and its own parabola by at most w³ J/6 with J ≥ |ψ'''|: what these exclude is
    passed over, what they cannot is halved.
    """
    bound = 1.0 + largest
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
            jerk = bound * (abs(climb) + bound * width) + abs(slope)
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
def survives_free_rocking(angle: float, velocity: float, critical: Array, p: Array, restitution: Array) -> bool:
    """Tell whether the block, left from this state on a base at rest, comes back to stand (by its energy)."""
    if angle == 0.0 and velocity == 0.0:
        return True
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    there = 1 - here
    outward = side * velocity / p[here]
    beyond = side * angle > critical[here]
    energy = 0.5 * outward * outward + cos(critical[here] - side * angle)
    if (beyond and (outward >= 0.0 or energy <= 1.0)) or (not beyond and outward > 0.0 and energy > 1.0):
        return False
    arriving = p[here] * sqrt(max(2.0 * (energy - cos(critical[here])), 0.0))
    after = restitution[here] * arriving / p[there]
    return bool(0.5 * after * after + cos(critical[there]) <= 1.0)


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
    Propagate the block over the samples of a base motion; arguments and results as `linear.propagate`.

    A block that reaches ±π/2 lies there and has overturned.
    """
    count = base.size
    angles, velocities = np.empty(count), np.empty(count)
    impact_times, impact_velocities = np.empty(64), np.empty(64)
    impacts = 0
    series = np.empty(ORDER + 1)
    passed, overturning_time = np.nan, np.nan
    resting = angle == 0.0 and velocity == 0.0
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    if side * angle > critical[here]:
        passed = 0.0
    thresholds = np.array([tan(critical[0]), tan(critical[1])])

    angles[0], velocities[0] = angle, velocity
    for sample in range(count - 1):
        a0 = base[sample]
        change = base[sample + 1] - a0
        elapsed = 0.0
        while elapsed < dt:
            if resting:
                at_start, at_end = a0 + change * (elapsed / dt), base[sample + 1]
                if at_start > thresholds[0] or -at_start > thresholds[1]:
                    side = -1.0 if at_start > 0.0 else 1.0
                elif at_end > thresholds[0]:
                    elapsed, side = max(elapsed, dt * (thresholds[0] - a0) / change), -1.0
                elif -at_end > thresholds[1]:
                    elapsed, side = max(elapsed, dt * (-thresholds[1] - a0) / change), 1.0
                else:
                    break
                resting, here = False, 1 if side > 0.0 else 0
                angle, velocity = 0.0, 0.0
                if elapsed >= dt:
                    break
            now = a0 + change * (elapsed / dt)
            remaining = p[here] * (dt - elapsed)
            step = min(remaining, LONGEST_STEP)
            slope = change / (p[here] * dt)
            _expand(series, critical[here] * side - angle, -velocity / p[here], now, slope)
            # From ψ to the height s θ above the base: without the cancellation of α s − ψ near it.
            series *= -side
            series[0] = side * angle
            before = series[0]
            x = _first_landing(series, step, max(abs(a0), abs(base[sample + 1])), slope)
            stop = min(x, step)
            value, climb, _curve = _value(series, stop)
            angle, velocity = side * value, side * climb * p[here]
            if value > critical[here] and not before > critical[here]:
                passed = dt * sample + elapsed + _passing(series, stop, critical[here]) / p[here]
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
            velocity, angle, side = restitution[here] * velocity, 0.0, -side
            here = 1 - here
            holding = sin(critical[here]) + side * (a0 + change * (elapsed / dt)) * cos(critical[here])
            risen = velocity * velocity / (2.0 * p[here] * p[here])
            if holding >= 0.0 and risen <= rest_angle * critical[here] * holding:
                resting, velocity = True, 0.0
        if not np.isnan(overturning_time):
            angles[sample + 1 :], velocities[sample + 1 :] = side * 0.5 * pi, 0.0
            break
        angles[sample + 1], velocities[sample + 1] = (0.0, 0.0) if resting else (angle, velocity)

    if np.isnan(overturning_time) and not survives_free_rocking(angle, velocity, critical, p, restitution):
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
