"""
The full equation by Taylor series, and the linearised one where the weight changes.

While the block rocks on side s = sgn θ, u = α − s θ obeys, with x = p t, the base acceleration over gravity
a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l', and the weight W = 1 + v/g linear in x,

    u'' = W sin u + (q + q' x) sin φ cos u,

linearised u'' = W u + (q + q' x) sin φ. Sine and cosine of the series of u follow by recurrence, and the series of
q sin φ is known, so that nothing of the motion is sampled. A series has as many terms as rounding asks for over all
that is wanted; where `ORDER` of them do not reach, it ends earlier. Beyond α, outwards and past α + atan max |q|, the
block only gathers speed: it has overturned.

The linear equation in closed form: while the block rocks on side s = sgn θ its height h = s θ obeys, with x = p t from
the beginning of an arc and the base acceleration over gravity a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l',

    h'' = h − α − (q + q' x) sin φ,      h = α + y + w,      w = C cosh x + D sinh x,
    y = (q + q' x) sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)².

With Ω = 0 and φ = π/2 that is the equation between two samples of a record. Nothing is integrated: only impacts are
searched. With G = (h − α) + h' is G' = G − q sin φ, so that from G > max |q| still to come on, h never returns to 0:
the block has overturned.
"""

from __future__ import annotations

from math import cos, factorial, sin
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel_fused, kernel_in_place

ODD = tuple(1.0 / factorial(2 * k + 1) for k in range(11))
EVEN = tuple(1.0 / factorial(2 * k + 2) for k in range(11))
"""Coefficients of sinh x / x and (cosh x − 1)/x² in x²; of sin and cos with −x²."""

LONGEST_STEP = 1.9
"""In x and in φ: up to here the eleven terms of `ODD` and `EVEN` leave less than rounding."""

Jet = tuple[float, float, float, float, float, float, float, float]
"""Height h and its first three derivatives by x; |w| and |w'|; sin φ and cos φ: of a series, the last four are 0."""


class Push(NamedTuple):
    """What acts on a block at the beginning of an arc: q, q', weight and its change by x, Ω, sin φ, cos φ."""

    q: float
    change: float
    weight: float
    lift: float
    ratio: float
    sine: float
    cosine: float


class Wave(NamedTuple):
    """
    An arc: α, Ω; gain, growth and lag of y = (gain + growth x) sin φ + lag cos φ; at x = 0 h, h', sin φ, cos φ, w, y'.
    """

    critical: float
    ratio: float
    gain: float
    growth: float
    lag: float
    height: float
    rate: float
    sine: float
    cosine: float
    free: float
    forced_rate: float


@kernel_in_place
def closed_arc(height: float, rate: float, critical: float, push: Push, wanted: float) -> tuple[Wave, Jet, float]:
    """Begin an arc; return it, its state at the beginning, and how far it is followed."""
    q, change, _weight, _lift, ratio, sine, cosine = push
    inverse = 1.0 / (1.0 + ratio * ratio)
    gain, growth, lag = q * inverse, change * inverse, 2.0 * change * ratio * inverse * inverse
    free = height - critical - gain * sine - lag * cosine
    forced_rate = (growth - lag * ratio) * sine + gain * ratio * cosine
    wave = Wave(critical, ratio, gain, growth, lag, height, rate, sine, cosine, free, forced_rate)
    bend, twist = height - critical - q * sine, rate - change * sine - q * ratio * cosine
    start = height, rate, bend, twist, abs(free), abs(rate - forced_rate), sine, cosine
    return wave, start, min(wanted, LONGEST_STEP / max(1.0, ratio))


@kernel_in_place
def closed_bounds(end: float, wave: Wave) -> tuple[float, float]:
    """Bounds of |h''''| and |h'''''| on [0, end] but for what w adds, which a jet has."""
    gain, growth, ratio = wave.gain, wave.growth, wave.ratio
    largest = max(abs(gain), abs(gain + growth * end)) + abs(wave.lag)
    fourth = ratio**3 * (largest * ratio + 4.0 * abs(growth))
    return fourth, ratio * fourth + ratio**4 * abs(growth)


@kernel_fused
def excess_rise(z: float) -> tuple[float, float]:
    """Return sinh x / x − 1 and (cosh x − 1)/x² for z = x²; sin x / x − 1 and (1 − cos x)/x² for z = −x²."""
    # Every second term, and those between: two sums that do not wait for each other.
    square = z * z
    odd, even, odd_between, even_between = ODD[9], EVEN[9], ODD[10], EVEN[10]
    for k in range(7, 0, -2):
        odd, even = odd * square + ODD[k], even * square + EVEN[k]
        odd_between, even_between = odd_between * square + ODD[k + 1], even_between * square + EVEN[k + 1]
    return z * (odd + z * odd_between), EVEN[0] + z * (even + z * even_between)


@kernel_fused
def closed_jet(x: float, wave: Wave) -> Jet:
    """State after x, all formed from differences to the beginning, so that short arcs keep their digits."""
    critical, ratio, gain, growth, lag, height, rate, sine, cosine, free, forced_rate = wave
    more, even = excess_rise(x * x)
    excess, rise = x * more, x * x * even
    sinh = x + excess
    # y and y' less what they would be if y' stayed as it is: nothing between two samples of a record.
    sine_rise, cosine_rise, forced, forced_rise, new_gain = 0.0, 0.0, 0.0, 0.0, gain + growth * x
    if ratio > 0.0:
        turn = ratio * x
        more, even = excess_rise(-turn * turn)
        across, back = turn + turn * more, turn * turn * even
        sine_rise, cosine_rise = cosine * across - sine * back, -sine * across - cosine * back
        forced = (growth * sine - forced_rate) * x + lag * cosine_rise + new_gain * sine_rise
        forced_rise = (growth - lag * ratio) * sine_rise + ratio * (growth * x * cosine + new_gain * cosine_rise)
    new_height = height + free * rise + rate * sinh - forced_rate * excess + forced
    new_rate = rate + free * sinh + (rate - forced_rate) * rise + forced_rise
    square, new_sine, new_cosine = 1.0 + ratio * ratio, sine + sine_rise, cosine + cosine_rise
    bend = new_height - critical - new_gain * square * new_sine
    twist = new_rate - square * (growth * new_sine + new_gain * ratio * new_cosine)
    # w and w' are largest at an end of any piece, as w'' = w.
    free_rate = rate - forced_rate
    new_free, new_free_rate = free + free * rise + free_rate * sinh, free_rate + free * sinh + free_rate * rise
    return new_height, new_rate, bend, twist, abs(new_free), abs(new_free_rate), new_sine, new_cosine


ORDER = 22
"""Most terms of a series; the step is chosen so that the last ones are below rounding."""

RECIPROCAL = 1.0 / np.maximum(np.arange(ORDER + 1), 1)

ROUNDING = 1e-15
"""What the last term of a series may come to at the end of its step, as a fraction of α."""

NEGLIGIBLE = 1e-18
"""In rad: a series ends where two terms in a row are smaller than this over all that is wanted."""


class Series(NamedTuple):
    """Taylor coefficients in x, shape (`ORDER` + 1,): of h, k h_k, sin u, cos u, q sin φ; whether they are linear."""

    height: Array
    rising: Array
    sine: Array
    cosine: Array
    forcing: Array
    is_linearised: bool


def empty_series(is_linearised: bool = False) -> Series:
    """Return room for the series of one arc after the other."""
    height, rising, sine, cosine, forcing = np.empty((5, ORDER + 1))
    return Series(height, rising, sine, cosine, forcing, is_linearised)


@kernel_in_place
def series_arc(
    start: float, rate: float, critical: float, push: Push, wanted: float, work: Series
) -> tuple[int, Jet, float]:
    """Expand h about x = 0; return the number of its terms, its state there, and how far they reach."""
    height, terms, end = work.height, _expand(start, rate, critical, push, wanted, work), wanted
    if terms > ORDER:
        last = max(abs(height[ORDER]), abs(height[ORDER - 1]))
        end = min(wanted, (ROUNDING * critical / last) ** (1.0 / ORDER) if last > 0.0 else 1.0)
    return terms, (start, rate, 2.0 * height[2], 6.0 * height[3], 0.0, 0.0, 0.0, 0.0), end


@kernel_in_place
def _expand(start: float, rate: float, critical: float, push: Push, wanted: float, work: Series) -> int:
    """Fill in the coefficients, as many as `wanted` needs, and return how many."""
    height, rising, sine, cosine, forcing, linearised = work
    q, change, weight, lift, ratio, even, odd = push
    angle, now = critical - start, q * even
    # even and odd: k-th Taylor coefficients of sin φ and of its quarter turn; growth: the one before of sin φ.
    for k in range(1, ORDER - 1):
        share, growth = ratio * RECIPROCAL[k], even
        even, odd = odd * share, -even * share
        forcing[k] = q * even + change * growth
    height[0], height[1], rising[1] = start, rate, rate
    sine[0], cosine[0] = (angle, 1.0) if linearised else (sin(angle), cos(angle))
    power, small = wanted, 0
    for k in range(ORDER - 1):
        product = 0.0
        if k > 0 and linearised:
            sine[k], cosine[k] = -height[k], 0.0
            product = forcing[k]
        elif k > 0:
            of_sine, of_cosine = 0.0, 0.0
            for j in range(1, k + 1):
                of_sine += rising[j] * cosine[k - j]
                of_cosine += rising[j] * sine[k - j]
                product += forcing[j] * cosine[k - j]
            sine[k], cosine[k] = -of_sine * RECIPROCAL[k], of_cosine * RECIPROCAL[k]
        product += weight * sine[k] + now * cosine[k]
        if k > 0:
            product += lift * sine[k - 1]
        rising[k + 2] = -product * RECIPROCAL[k + 1]
        height[k + 2] = rising[k + 2] * RECIPROCAL[k + 2]
        power *= wanted
        small = small + 1 if abs(height[k + 2]) * power < NEGLIGIBLE else 0
        if small == 2:
            return k + 3
    return ORDER + 1


@kernel_fused
def series_bounds(end: float, terms: int, height: Array) -> tuple[float, float]:
    """Bounds of |h''''| and |h'''''| on [0, end]: the sums of the magnitudes of their terms."""
    fourth, fifth = 0.0, 0.0
    for k in range(terms - 1, 4, -1):
        size = k * (k - 1) * (k - 2) * (k - 3) * abs(height[k])
        fourth = fourth * end + size
        fifth = fifth * end + size * (k - 4)
    return fourth * end + 24.0 * abs(height[4]), fifth


@kernel_fused
def series_jet(x: float, terms: int, height: Array) -> Jet:
    """State after x (Horner)."""
    value, first, second, third = 0.0, 0.0, 0.0, 0.0
    for k in range(terms - 1, -1, -1):
        third = third * x + second
        second = second * x + first
        first = first * x + value
        value = value * x + height[k]
    return value, first, 2.0 * second, 6.0 * third, 0.0, 0.0, 0.0, 0.0
