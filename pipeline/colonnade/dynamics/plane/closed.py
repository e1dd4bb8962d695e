"""
The linear equation in closed form.

While the block rocks on side s = sgn θ its height h = s θ obeys, with x = p t from the beginning of an arc and the base
acceleration over gravity a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l',

    h'' = h − α − (q + q' x) sin φ,      h = α + y + w,      w = C cosh x + D sinh x,
    y = (q + q' x) sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)².

With Ω = 0 and φ = π/2 that is the equation between two samples of a record. Nothing is integrated: only impacts are
searched. With G = (h − α) + h' is G' = G − q sin φ, so that from G > max |q| still to come on, h never returns to 0:
the block has overturned.
"""

from __future__ import annotations

from math import factorial
from typing import NamedTuple

from colonnade.dynamics.kernel import kernel, kernel_fused

ODD = tuple(1.0 / factorial(2 * k + 1) for k in range(10))
EVEN = tuple(1.0 / factorial(2 * k + 2) for k in range(10))
"""Coefficients of sinh x / x and (cosh x − 1)/x² in x²; of sin and cos with −x²."""

LONGEST_STEP = 1.25
"""In x and in φ: up to here the ten terms of `ODD` and `EVEN` leave less than rounding."""

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


@kernel
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


@kernel
def closed_bounds(end: float, wave: Wave) -> tuple[float, float]:
    """Bounds of |h''''| and |h'''''| on [0, end] but for what w adds, which a jet has."""
    gain, growth, ratio = wave.gain, wave.growth, wave.ratio
    largest = max(abs(gain), abs(gain + growth * end)) + abs(wave.lag)
    fourth = ratio**3 * (largest * ratio + 4.0 * abs(growth))
    return fourth, ratio * fourth + ratio**4 * abs(growth)


@kernel_fused
def _excess_rise(z: float) -> tuple[float, float]:
    """Return sinh x / x − 1 and (cosh x − 1)/x² for z = x²; sin x / x − 1 and (1 − cos x)/x² for z = −x²."""
    odd, even = ODD[9], EVEN[9]
    odd, even = odd * z + ODD[8], even * z + EVEN[8]
    odd, even = odd * z + ODD[7], even * z + EVEN[7]
    odd, even = odd * z + ODD[6], even * z + EVEN[6]
    odd, even = odd * z + ODD[5], even * z + EVEN[5]
    odd, even = odd * z + ODD[4], even * z + EVEN[4]
    odd, even = odd * z + ODD[3], even * z + EVEN[3]
    odd, even = odd * z + ODD[2], even * z + EVEN[2]
    odd, even = odd * z + ODD[1], even * z + EVEN[1]
    return odd * z, even * z + EVEN[0]


@kernel_fused
def closed_jet(x: float, wave: Wave) -> Jet:
    """State after x, all formed from differences to the beginning, so that short arcs keep their digits."""
    critical, ratio, gain, growth, lag, height, rate, sine, cosine, free, forced_rate = wave
    more, even = _excess_rise(x * x)
    excess, rise = x * more, x * x * even
    sinh = x + excess
    # y and y' less what they would be if y' stayed as it is: nothing between two samples of a record.
    sine_rise, cosine_rise, forced, forced_rise = 0.0, 0.0, 0.0, 0.0
    if ratio > 0.0:
        turn = ratio * x
        more, even = _excess_rise(-turn * turn)
        across, back = turn + turn * more, turn * turn * even
        sine_rise, cosine_rise = cosine * across - sine * back, -sine * across - cosine * back
        forced = gain * sine_rise + growth * x * (sine + sine_rise) + lag * cosine_rise - forced_rate * x
        forced_rise = (growth - lag * ratio) * sine_rise + ratio * (
            gain * cosine_rise + growth * x * (cosine + cosine_rise)
        )
    new_height = height + free * rise + rate * sinh - forced_rate * excess + forced
    new_rate = rate + free * sinh + (rate - forced_rate) * rise + forced_rise
    square, new_gain = 1.0 + ratio * ratio, gain + growth * x
    new_sine, new_cosine = sine + sine_rise, cosine + cosine_rise
    bend = new_height - critical - new_gain * square * new_sine
    twist = new_rate - square * (growth * new_sine + new_gain * ratio * new_cosine)
    # w and w' are largest at an end of any piece, as w'' = w.
    free_rate = rate - forced_rate
    new_free, new_free_rate = free + free * rise + free_rate * sinh, free_rate + free * sinh + free_rate * rise
    return new_height, new_rate, bend, twist, abs(new_free), abs(new_free_rate), new_sine, new_cosine
