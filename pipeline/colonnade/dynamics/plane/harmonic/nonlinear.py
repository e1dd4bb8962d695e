"""
The nonlinear model under a harmonic base motion, by Taylor series with impacts located on the series themselves.

While the block rocks on side s = sgn θ, u = α − s θ obeys, with x = p t and the base acceleration over gravity
a/g = l sin φ, φ = Ω x + ψ, the level l constant or linear in x, and q = s l,

    u'' = sin u + q sin φ cos u.

Sine and cosine of the series of u follow by recurrence, and the series of q sin φ is known, so that nothing of the
motion is sampled. Between two points of a series the height h = α − u is passed over where a bound on its higher
derivatives excludes an impact, and solved for where it shows that there is exactly one; the rest is halved. Beyond α,
outwards and past α + atan max |q|, the block only gathers speed: it has overturned.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.landing import FRESH, SHORTEST_STEP, Jet, verdict

ORDER = 18
"""Terms of a series; the step is chosen so that the last ones are below rounding."""

RECIPROCAL = 1.0 / np.maximum(np.arange(ORDER + 1), 1)

ROUNDING = 1e-15
"""What the last term of a series may come to at the end of its step, as a fraction of α."""


class Series(NamedTuple):
    """Taylor coefficients in x, shape (`ORDER` + 1,): of h, sin u, cos u, q sin φ and u'."""

    height: Array
    sine: Array
    cosine: Array
    forcing: Array
    turn: Array


def empty_series() -> Series:
    """Return room for the series of one arc after the other."""
    return Series(*(np.empty(ORDER + 1) for _ in Series._fields))


@kernel
def _expand(work: Series, critical: float, ratio: float, q: float, change: float, phase: float) -> float:
    """
    Complete the Taylor coefficients of h about x = 0, of which the first two are given; return the step they allow.

    `q` is the level at x = 0, `change` its slope: the forcing is (q + change x) sin φ.
    """
    height, sine, cosine, forcing, turn = work
    angle = critical - height[0]
    sine[0], cosine[0] = sin(angle), cos(angle)
    even, odd, growth = sin(phase), cos(phase), 0.0
    forcing[0] = q * even
    turn[1], turn[2] = -height[1], sine[0] + forcing[0] * cosine[0]
    height[2] = -0.5 * turn[2]
    for k in range(1, ORDER - 1):
        # even: k-th Taylor coefficient of sin φ; growth: the one before.
        share = ratio * RECIPROCAL[k]
        even, odd, growth = odd * share, -even * share, even
        forcing[k] = q * even + change * growth
        rising, falling, product = 0.0, 0.0, forcing[k] * cosine[0]
        for j in range(1, k + 1):
            rising += turn[j] * cosine[k - j]
            falling += turn[j] * sine[k - j]
        sine[k], cosine[k] = rising * RECIPROCAL[k], -falling * RECIPROCAL[k]
        for j in range(1, k + 1):
            product += cosine[j] * forcing[k - j]
        turn[k + 2] = (sine[k] + product) * RECIPROCAL[k + 1]
        height[k + 2] = -turn[k + 2] * RECIPROCAL[k + 2]
    last = max(abs(height[ORDER]), abs(height[ORDER - 1]))
    return (ROUNDING * critical / last) ** (1.0 / ORDER) if last > 0.0 else 1.0


@kernel
def _at(height: Array, x: float) -> Jet:
    """Value and first three derivatives of a series (Horner)."""
    value, first, second, third = 0.0, 0.0, 0.0, 0.0
    for k in range(ORDER, -1, -1):
        third = third * x + second
        second = second * x + first
        first = first * x + value
        value = value * x + height[k]
    return value, first, 2.0 * second, 6.0 * third


@kernel
def _bounds(height: Array, x: float) -> tuple[float, float]:
    """Bounds of |h''''| and |h'''''| on [0, x]: the sums of the magnitudes of their terms."""
    fourth, fifth = 0.0, 0.0
    for k in range(ORDER, 4, -1):
        size = k * (k - 1) * (k - 2) * (k - 3) * abs(height[k])
        fourth = fourth * x + size
        fifth = fifth * x + size * (k - 4)
    return fourth * x + 24.0 * abs(height[4]), fifth


@kernel
def _first_landing(height: Array, end: float) -> tuple[bool, float, Jet]:
    """Find the first x in [0, end] where h falls to 0: whether it does, that x or the end, and the state there."""
    left, start = 0.0, (height[0], height[1], 2.0 * height[2], 6.0 * height[3])
    if height[0] <= 0.0 and height[1] < 0.0:
        return True, 0.0, start
    fresh = height[0] == 0.0 and height[1] == 0.0
    fourth, fifth = _bounds(height, end)
    whole = _at(height, end)
    while left < end:
        width, last = end - left, whole
        while True:
            told = verdict(width, start, last, fourth, fifth)
            if told != 0 or width <= SHORTEST_STEP or (fresh and left + width <= FRESH):
                break
            width *= 0.5
            last = _at(height, left + width)
        right = end if width == end - left else left + width
        if last[0] < 0.0:
            x, last = _landing(height, left, right, last) if width > SHORTEST_STEP else (left, last)
            return True, x, last
        left, start = right, last
    return False, end, start


@kernel
def _landing(height: Array, low: float, high: float, point: Jet) -> tuple[float, Jet]:
    """
    Find the one x in [low, high] where h falls to 0, and the state there; `point` is the state at `high`.

    Steps of fourth order (Householder) inside a shrinking bracket.
    """
    x, tried = high, 0
    while True:
        value, rate, bend, twist = point
        low, high = (x, high) if value > 0.0 else (low, x)
        below = 6.0 * rate * rate * rate - 6.0 * value * rate * bend + value * value * twist
        step = -value * (6.0 * rate * rate - 3.0 * value * bend) / below if below != 0.0 else high - low
        tried += 1
        if not low <= x + step <= high or tried > 8:
            step = 0.5 * (low + high) - x
        if abs(step) <= 1e-5 or tried > 60:
            return x + step, (0.0, rate + step * (bend + 0.5 * step * twist), bend + step * twist, twist)
        x += step
        point = _at(height, x)


@kernel
def _summit(height: Array, high: float) -> float:
    """Largest height in [0, high] of a piece that rises at its start and falls at its end."""
    low, x, largest = 0.0, 0.5 * high, float(height[0])
    for _ in range(60):
        value, rate, bend, _twist = _at(height, x)
        largest = max(largest, value)
        if rate > 0.0:
            low = x
        else:
            high = x
        following = x - rate / bend if bend < 0.0 else low
        if abs(following - x) <= 1e-9 * high:
            break
        x = following if low < following < high else 0.5 * (low + high)
    return largest


@kernel
def series_arc(
    height: float,
    rate: float,
    side: float,
    critical: float,
    p: float,
    omega: float,
    angle: float,
    level: float,
    slope: float,
    remaining: float,
    is_top_wanted: bool,
    work: Series,
) -> tuple[bool, float, float, float, float]:
    """
    Follow an arc by one series: to its end, over all that remains, or up to the impact.

    Parameters and results as for `closed_arc`, but for φ, `angle`, in place of its sine and cosine.
    """
    series = work.height
    series[0], series[1] = height, rate
    q, change, ratio = side * level, side * slope / p, omega / p
    allowed = _expand(work, critical, ratio, q, change, angle)
    landed, x, last = _first_landing(series, min(remaining, allowed))
    is_inside = is_top_wanted and rate >= 0.0 and last[1] < 0.0
    return landed, x, _summit(series, x) if is_inside else last[0], last[0], last[1]
