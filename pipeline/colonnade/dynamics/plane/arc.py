"""
One arc of a rocking block, in closed form or by Taylor series: to its impact, or as far as it goes.

While the block rocks on side s = sgn θ its height h = s θ obeys, with u = α − h, x = p t from the beginning of an arc,
the base acceleration over gravity a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l', and the weight W = 1 + v/g
linear in x,

    h'' = −W sin u − (q + q' x) sin φ cos u,      linearised h'' = −W u − (q + q' x) sin φ.

By series: sine and cosine of u follow by recurrence, and the series of q sin φ is known, so that nothing of the motion
is sampled. A series has as many terms as rounding asks for over all that is wanted; where `ORDER` of them do not reach,
it ends earlier. Beyond α, outwards and past α + atan max |q|, the block only gathers speed: it has overturned.

In closed form, for the linearised equation with W = 1:

    h = α + y + w,      w = C cosh x + D sinh x,
    y = (q + q' x) sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)².

With Ω = 0 and φ = π/2 that is the equation between two samples of a record. Nothing is integrated. With
G = (h − α) + h' is G' = G − q sin φ, so that from G > max |q| still to come on, h never returns to 0: overturned.

Between two points of an arc the height is passed over where a bound on its higher derivatives excludes an impact, and
solved for where it shows that there is exactly one; the rest is halved.
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


SHORTEST_STEP = 1e-7
"""In x: events closer than this are not separated."""

FRESH = 1e-4
"""In x: the beginning of an arc after uplift, where rounding could feign a landing; it rises 1e-9 α."""

LANDING, SUMMIT, PASSING = np.int64(0), np.int64(1), np.int64(-1)
"""
What is searched on an arc: where h falls to 0, where it is largest, where it passes α outwards.

Of Python's own numbers numba would compile the search once for each.
"""

LARGEST_SINE = 1.6
"""What multiplies the weight is at most sin u ≤ 1, or |u| ≤ π/2 in the linearised equation up to where a block lies."""

Arc = tuple[Wave, int]
"""In closed form, or the number of terms of its series."""

NO_WAVE = Wave(*[0.0] * len(Wave._fields))


@kernel_in_place
def verdict(width: float, start: Jet, end: Jet, fourth: float, fifth: float) -> int:
    """
    Tell what happens between two points, the first at h ≥ 0; the bounds are those of |h''''| and |h'''''| in between.

    Returns 1 where there is no impact, −1 where h falls to 0 exactly once, 0 where the bounds do not decide.
    """
    eighth = 0.125 * width * width
    # A function is above the lower of its ends less width²/8 of what its second derivative is at most.
    most = max(start[2], end[2]) + eighth * fourth
    if end[0] < 0.0:
        steepest = max(abs(start[3]), abs(end[3])) + eighth * fifth
        return -1 if most < 0.0 or max(start[1], end[1]) + eighth * steepest < 0.0 else 0
    if most <= 0.0 or min(start[0], end[0]) > eighth * most:
        return 1
    # From the start: h ≥ h0 + h0' x + h0'' x²/2 + L x³/6 with L ≤ h''' throughout.
    if start[1] < 0.0:
        return 0
    least = min(start[3], end[3]) - eighth * fifth
    if least > 0.0 and (start[2] >= 0.0 or (start[0] == 0.0 and start[1] == 0.0 and start[2] > -1e-9)):
        return 1
    return 1 if start[1] + 0.5 * start[2] * width + min(least, 0.0) * width * width / 6.0 > 0.0 else 0


@kernel_in_place
def follow(
    height: float, rate: float, critical: float, push: Push, remaining: float, is_top_wanted: bool, work: Series | None
) -> tuple[bool, float, float, float, float, float, float, float]:
    """
    Follow an arc from h (rad) and h' = dh/dx: to its end, over all that remains (in x), or up to the impact; in closed
    form without `work`.

    Returns whether the step ends in an impact; its length in x; h and h' at its end; the largest height at its end or,
    if wanted, inside; where in x it passes α outwards, NaN if it is not above α at the end, or was before; in closed
    form, sin φ and cos φ at its end.
    """
    wave, terms = NO_WAVE, 0
    if work is None:
        wave, start, end = closed_arc(height, rate, critical, push, remaining)
    else:
        terms, start, end = series_arc(height, rate, critical, push, remaining, work)
    arc = wave, terms
    last = _jet(end, arc, work)
    landed, x, top = False, end, last[0]
    # A chord is above a curve by at most x²/8 times the largest second derivative: most steps of a record need no more.
    largest = LARGEST_SINE * (push.weight + abs(push.lift) * end) + abs(push.q) + abs(push.change) * end
    if work is None or is_top_wanted or not min(start[0], last[0]) > 0.125 * largest * end * end:
        landed, x, last, top = _to_landing(start, end, last, is_top_wanted, arc, work)
    passing = np.nan
    if last[0] > critical and not height > critical:
        passing = _root(0.0, x, start, last, PASSING, critical, arc, work)[0]
    return landed, x, last[0], last[1], top, passing, last[6], last[7]


@kernel_in_place
def _jet(x: float, arc: Arc, work: Series | None) -> Jet:
    if work is None:
        return closed_jet(x, arc[0])
    return series_jet(x, arc[1], work.height)


@kernel_in_place
def _bounds(end: float, arc: Arc, work: Series | None) -> tuple[float, float]:
    if work is None:
        return closed_bounds(end, arc[0])
    return series_bounds(end, arc[1], work.height)


@kernel_in_place
def _to_landing(
    start: Jet, end: float, whole: Jet, is_top_wanted: bool, arc: Arc, work: Series | None
) -> tuple[bool, float, Jet, float]:
    """Find the first x in [0, end] where h falls to 0: whether it does, that x or the end, the state, and the top."""
    if start[0] <= 0.0 and start[1] < 0.0:
        return True, 0.0, start, start[0]
    fresh, left, top = start[0] == 0.0 and start[1] == 0.0, 0.0, 0.0
    fourth, fifth = _bounds(end, arc, work)
    while left < end:
        width, last = end - left, whole
        while True:
            told = verdict(width, start, last, fourth + max(start[4], last[4]), fifth + max(start[5], last[5]))
            if told != 0 or width <= SHORTEST_STEP or (fresh and left + width <= FRESH):
                break
            width *= 0.5
            last = _jet(left + width, arc, work)
        right = end if width == end - left else left + width
        landed = last[0] < 0.0
        if landed:
            if start[0] > 0.0 or width > SHORTEST_STEP:
                right, last = _root(left, right, start, last, LANDING, 0.0, arc, work)
            last = (0.0, last[1], last[2], last[3], last[4], last[5], last[6], last[7])
        top = max(top, last[0])
        if is_top_wanted and start[1] >= 0.0 and last[1] < 0.0:
            top = max(top, _root(left, right, start, last, SUMMIT, 0.0, arc, work)[1][0])
        if landed:
            return True, right, last, top
        left, start = right, last
    return False, end, start, top


@kernel_in_place
def _root(
    low: float, high: float, first: Jet, last: Jet, kind: np.int64, target: float, arc: Arc, work: Series | None
) -> tuple[float, Jet]:
    """
    Find the one x in [low, high] where what is searched is, and the state there.

    Steps of fourth order (Householder) inside a shrinking bracket, from the nearer end that falls.
    """
    x, jet, tried = high, last, 0
    if 0.0 < _searched(first, kind, target)[0] < -_searched(last, kind, target)[0] and (
        _searched(first, kind, target)[1] < 0.0
    ):
        x, jet = low, first
    while True:
        value, slope, bend, twist = _searched(jet, kind, target)
        low, high = (x, high) if value > 0.0 else (low, x)
        below = 6.0 * slope * slope * slope - 6.0 * value * slope * bend + value * value * twist
        step = -value * (6.0 * slope * slope - 3.0 * value * bend) / below if below != 0.0 else high - low
        tried += 1
        if not low <= x + step <= high or tried > 8:
            step = 0.5 * (low + high) - x
        # Where it comes down almost without speed, steps shrink slowly: the slope must hold over the last one.
        is_last = abs(step) * (1.0 + arc[0].ratio) <= 1e-5 and abs(step * bend) <= 1e-2 * abs(slope)
        if is_last or tried > 60:
            h, rate, bend, twist, fourth, fifth, sine, cosine = jet
            turn = arc[0].ratio * step
            there = (
                h + step * (rate + 0.5 * step * bend),
                rate + step * (bend + 0.5 * step * twist),
                bend + step * twist,
            )
            sine, cosine = sine + turn * (cosine - 0.5 * turn * sine), cosine - turn * (sine + 0.5 * turn * cosine)
            return x + step, (*there, twist, fourth, fifth, sine, cosine)
        x += step
        jet = _jet(x, arc, work)


@kernel_in_place
def _searched(jet: Jet, kind: np.int64, target: float) -> tuple[float, float, float, float]:
    """Give what falls through 0 where something is, and its derivatives as far as they are known."""
    if kind == SUMMIT:
        return jet[1], jet[2], jet[3], 0.0
    sign = 1.0 if kind == LANDING else -1.0
    return sign * (jet[0] - target), sign * jet[1], sign * jet[2], sign * jet[3]
