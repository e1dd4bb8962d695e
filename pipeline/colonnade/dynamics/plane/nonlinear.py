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

from math import cos, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.step import Interval, Step

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


class BySeries(NamedTuple):
    """
    What the solution by series needs beyond the closed form.

    Attributes
    ----------
    vertical : ndarray, shape (n,)
        Vertical acceleration of the base over gravity, above −1.
    is_linearised : bool
        Whether the linearised equation is solved.
    work : ndarray, shape (3, `ORDER` + 1)
        Room for the series of one step after the other.
    """

    vertical: Array
    is_linearised: bool
    work: Array


def by_series(vertical: Array, is_linearised: bool) -> BySeries:
    """Prepare the solution by series; arguments as for `BySeries`."""
    return BySeries(vertical, is_linearised, np.empty((3, ORDER + 1)))


@kernel
def series_step(
    interval: Interval,
    elapsed: float,
    angle: float,
    velocity: float,
    side: float,
    critical: float,
    p: float,
    series: BySeries,
) -> Step:
    """
    Follow an arc by one series: to its impact, to the end of the interval or as far as the series goes.

    Parameters as for `closed_step`, and `series`.
    """
    dt, a0, u0, u1 = interval.length, interval.base, interval.weight, interval.next_weight
    change = interval.next_base - a0
    bound = LARGEST_SINE * max(abs(u0), abs(u1)) + max(abs(a0), abs(interval.next_base))

    # The series of ψ = α s − θ over a step on which it converges quickly.
    remaining, scaled = p * (dt - elapsed), side * velocity / p
    step = min(remaining, LONGEST_STEP / max(1.0, abs(velocity) / p, 0.5 * sqrt(bound)))
    slope, lift_slope = change / (p * dt), (u1 - u0) / (p * dt)
    now, lift = a0 + change * (elapsed / dt), u0 + (u1 - u0) * (elapsed / dt)
    terms = _expand(
        series.work,
        critical * side - angle,
        -side * scaled,
        now,
        slope,
        lift,
        lift_slope,
        step,
        series.is_linearised,
    )
    # From ψ to the height s θ above the base: without the cancellation of α s − ψ near it.
    height = series.work[0, :terms]
    height *= -side
    height[0] = side * angle
    before = height[0]

    # To the impact, or to the end of the step.
    x = _first_landing(height, step, bound, abs(slope) + LARGEST_SINE * abs(lift_slope))
    stop = min(x, step)
    value, climb, _curve = _value(height, stop)
    if x <= step:
        return Step(True, elapsed + x / p, 0.0, side * climb * p, np.nan, False)
    passed = np.nan
    if value > critical and not before > critical:
        passed = interval.begin + elapsed + _passing(height, stop, critical) / p
    reached = dt if step == remaining else elapsed + step / p
    return Step(False, reached, side * value, side * climb * p, passed, value >= 0.5 * pi)


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
