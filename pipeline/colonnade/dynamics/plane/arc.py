"""
One arc of a rocking block, in closed form or by Taylor series: to its impact, or as far as it goes.

While the block rocks on side s = sgn θ its height h = s θ obeys, with u = α − h, x = p t from the beginning of an arc,
the base acceleration over gravity a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l', and the weight W = 1 + v/g
linear in x,

    h'' = −W sin u − (q + q' x) sin φ cos u,      linearised h'' = −W u − (q + q' x) sin φ.

By series: sine and cosine of u follow by recurrence, and the series of q sin φ is known, so that nothing of the motion
is sampled. A series has as many terms as rounding asks for over all that is wanted; where `ORDER` of them do not reach,
it ends earlier. Sums whose terms wait for each other take most of its time: two orders are summed at once. Beyond α,
outwards and past α + atan max |q|, the block only gathers speed: it has overturned.

In closed form, for the linearised equation with W = 1:

    h = α + y + w,      w = C cosh x + D sinh x,
    y = (q + q' x) sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)².

With Ω = 0 and φ = π/2 that is the equation between two samples of a record. Nothing is integrated. With
G = (h − α) + h' is G' = G − q sin φ, so that from G > max |q| still to come on, h never returns to 0: overturned.

Between two points of an arc the height is passed over where a bound on its higher derivatives excludes an impact, and
solved for where it shows that there is exactly one; the rest is halved.
"""

from __future__ import annotations

from math import exp, factorial, log
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel_fused

ODD = tuple(1.0 / factorial(2 * k + 1) for k in range(11))
EVEN = tuple(1.0 / factorial(2 * k + 2) for k in range(11))
"""Coefficients of sinh x / x and (cosh x − 1)/x² in x²; of sin and cos with −x²."""

SHORT = 2e-3
"""In x²: up to here four terms leave less than rounding, as in most samples of a record."""

LONGEST_STEP = 1.9
"""In x and in φ: up to here the eleven terms of `ODD` and `EVEN` leave less than rounding."""

Jet = tuple[float, float, float, float, float, float]
"""Height h and its first three derivatives by x; sin φ and cos φ, of a series 0."""


class Push(NamedTuple):
    """What acts on a block at the beginning of an arc: q, q', weight and its change by x, Ω, sin φ, cos φ."""

    q: float
    change: float
    weight: float
    lift: float
    ratio: float
    sine: float
    cosine: float


Wave = tuple[float, float, float, float, float, float, float, float, float, float, float]
"""
An arc: α, Ω; gain, growth and lag of y = (gain + growth x) sin φ + lag cos φ; at x = 0 h, h', sin φ, cos φ, w, y'.
"""


@kernel_fused
def closed_arc(height: float, rate: float, critical: float, push: Push) -> tuple[Wave, Jet]:
    """Begin an arc; return it and its state at the beginning."""
    q, change, _weight, _lift, ratio, sine, cosine = push
    inverse = 1.0 / (1.0 + ratio * ratio)
    gain, growth, lag = q * inverse, change * inverse, 2.0 * change * ratio * inverse * inverse
    free = height - critical - gain * sine - lag * cosine
    forced_rate = (growth - lag * ratio) * sine + gain * ratio * cosine
    wave = critical, ratio, gain, growth, lag, height, rate, sine, cosine, free, forced_rate
    bend, twist = height - critical - q * sine, rate - change * sine - q * ratio * cosine
    return wave, (height, rate, bend, twist, sine, cosine)


@kernel_fused
def excess_rise(z: float) -> tuple[float, float]:
    """Return sinh x / x − 1 and (cosh x − 1)/x² for z = x²; sin x / x − 1 and (1 − cos x)/x² for z = −x²."""
    # Every second term, and those between: two sums that do not wait for each other.
    square, odd, even, odd_between, even_between = z * z, 0.0, 0.0, 0.0, 0.0
    if abs(z) > SHORT:
        for k in range(9, 3, -2):
            odd, even = odd * square + ODD[k], even * square + EVEN[k]
            odd_between, even_between = odd_between * square + ODD[k + 1], even_between * square + EVEN[k + 1]
    for k in range(3, 0, -2):
        odd, even = odd * square + ODD[k], even * square + EVEN[k]
        odd_between, even_between = odd_between * square + ODD[k + 1], even_between * square + EVEN[k + 1]
    return z * (odd + z * odd_between), EVEN[0] + z * (even + z * even_between)


@kernel_fused
def turned(sine: float, cosine: float, turn: float) -> tuple[float, float]:
    """Give what a sine and its cosine rise by over a turn of at most `LONGEST_STEP`."""
    more, even = excess_rise(-turn * turn)
    across, back = turn + turn * more, turn * turn * even
    return cosine * across - sine * back, -sine * across - cosine * back


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
        sine_rise, cosine_rise = turned(sine, cosine, ratio * x)
        forced = (growth * sine - forced_rate) * x + lag * cosine_rise + new_gain * sine_rise
        forced_rise = (growth - lag * ratio) * sine_rise + ratio * (growth * x * cosine + new_gain * cosine_rise)
    new_height = height + free * rise + rate * sinh - forced_rate * excess + forced
    new_rate = rate + free * sinh + (rate - forced_rate) * rise + forced_rise
    square, new_sine, new_cosine = 1.0 + ratio * ratio, sine + sine_rise, cosine + cosine_rise
    bend = new_height - critical - new_gain * square * new_sine
    twist = new_rate - square * (growth * new_sine + new_gain * ratio * new_cosine)
    return new_height, new_rate, bend, twist, new_sine, new_cosine


ORDER = 21
"""Of a series at most, odd, as terms come in pairs; the step is chosen so that the last ones are below rounding."""

RECIPROCAL = 1.0 / np.maximum(np.arange(ORDER + 1), 1)

ROUNDING = 1e-15
"""What the last term of a series may come to at the end of its step, as a fraction of α."""

NEGLIGIBLE = 1e-18
"""In rad: a series ends where two terms in a row are smaller than this over all that is wanted."""


class Series(NamedTuple):
    """Taylor coefficients in x, shape (`ORDER` + 1,): of h, k h_k, sin u, cos u, q sin φ; whether sin u is u."""

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


@kernel_fused
def series_arc(
    start: float, rate: float, critical: float, push: Push, wanted: float, work: Series
) -> tuple[int, Jet, float]:
    """Expand h about x = 0; return the number of its terms, its state there, and how far they reach."""
    height, terms, end = work.height, _expand(start, rate, critical, push, wanted, work), wanted
    if terms > ORDER:
        last = max(abs(height[ORDER]), abs(height[ORDER - 1]))
        end = min(wanted, exp(log(ROUNDING * critical / last) / ORDER) if last > 0.0 else 1.0)
    return terms, (start, rate, 2.0 * height[2], 6.0 * height[3], 0.0, 0.0), end


Three = tuple[float, float, float]


@kernel_fused
def _order(k: int, sums: Three, before: Three, rate: float, now: float, pull: float, push: Push) -> Three:
    """Sine and cosine of u of order k, and the next but one of k h_k, by what all but the order before add to sums."""
    sine, cosine, curving = before
    turn, back, bend = sums
    bend += push.lift * sine + pull * cosine
    sine, cosine = -RECIPROCAL[k] * (turn + rate * cosine), curving * RECIPROCAL[k] * (back + rate * sine)
    return sine, cosine, -RECIPROCAL[k + 1] * (bend + (push.weight * sine + now * cosine))


@kernel_fused
def _expand(start: float, rate: float, critical: float, push: Push, wanted: float, work: Series) -> int:
    """Fill in the coefficients, two at a time and as many as `wanted` needs, and return how many."""
    height, rising, sines, cosines, forcing, linearised = work
    q, change, weight, _lift, ratio, even, odd = push
    # Linearised, u takes the place of its sine and 1 that of its cosine.
    angle, now, curving = critical - start, q * even, 0.0 if linearised else 1.0
    excess, rise = excess_rise(-angle * angle)
    first, unit = angle + curving * angle * excess, 1.0 - curving * angle * angle * rise
    # even and odd: Taylor coefficients of sin φ and of its quarter turn.
    pull, even, odd = ratio * q * odd + change * even, ratio * odd, -ratio * even
    sine, cosine, latest = _order(1, (0.0, 0.0, 0.0), (first, unit, curving), rate, now, pull, push)
    before = -(weight * first + now * unit)
    height[0], height[1], height[2], height[3] = start, rate, 0.5 * before, latest * RECIPROCAL[3]
    rising[2], rising[3] = before, latest
    sines[0], sines[1], cosines[0], cosines[1], forcing[1] = first, sine, unit, cosine, pull
    power = wanted * wanted
    for k in range(2, ORDER - 1, 2):
        for i in range(k, k + 2):
            share = ratio * RECIPROCAL[i]
            forcing[i], even, odd = q * odd * share + change * even, odd * share, -even * share
        # Two orders share what they read. What was found last is not read: it would have to be written first.
        turn, back, bend, next_turn, next_back, next_bend = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        s, c = sines[1], cosines[1]
        for j in range(0 if linearised else k - 1, 1, -1):
            turn, back, bend = turn + rising[j] * c, back + rising[j] * s, bend + forcing[j] * c
            s, c = sines[k + 1 - j], cosines[k + 1 - j]
            next_turn, next_back = next_turn + rising[j] * c, next_back + rising[j] * s
            next_bend += forcing[j] * c
        s, c = sines[1], cosines[1]
        sums = turn + before * unit, back + before * first, bend + forcing[k] * unit
        sine, cosine, rise = _order(k, sums, (sine, cosine, curving), rate, now, pull, push)
        next_turn, next_back = next_turn + before * c + latest * unit, next_back + before * s + latest * first
        sums = next_turn, next_back, next_bend + forcing[k] * c + forcing[k + 1] * unit
        before = rise
        sines[k], cosines[k] = sine, cosine
        sine, cosine, latest = _order(k + 1, sums, (sine, cosine, curving), rate, now, pull, push)
        sines[k + 1], cosines[k + 1], rising[k + 2], rising[k + 3] = sine, cosine, rise, latest
        height[k + 2], height[k + 3] = rise * RECIPROCAL[k + 2], latest * RECIPROCAL[k + 3]
        power *= wanted * wanted
        if max(abs(height[k + 2]), abs(height[k + 3]) * wanted) * power < NEGLIGIBLE:
            return k + 4
    return ORDER + 1


LARGEST_SINE = 1.6
"""What multiplies the weight is at most sin u ≤ 1, or |u| ≤ π/2 in the linearised equation up to where a block lies."""


@kernel_fused
def _bounds(end: float, rate: float, push: Push, is_curved: bool) -> tuple[float, float]:
    """Bounds of the fourth and fifth derivative of h on [0, end], by the derivatives of what acts and those of u."""
    q, change, weight, lift, ratio, _sine, _cosine = push
    largest = abs(q) + abs(change) * end
    second = LARGEST_SINE * (weight + abs(lift) * end) + largest
    first = abs(rate) + second * end
    once = LARGEST_SINE * abs(lift) + abs(change) + largest * ratio
    twice = ratio * (2.0 * abs(change) + largest * ratio)
    thrice = ratio * ratio * (3.0 * abs(change) + largest * ratio)
    square = first * first if is_curved else 0.0
    bent, third = square + second, first * (square + (3.0 * second if is_curved else 0.0)) + second * first + once
    return second * bent + 2.0 * once * first + twice, second * third + 3.0 * (once * bent + twice * first) + thrice


@kernel_fused
def series_jet(x: float, terms: int, height: Array) -> Jet:
    """State after x (Horner), even and odd terms apart: two sums that do not wait for each other."""
    square = x * x
    even, even_1, even_2, even_3, odd, odd_1, odd_2, odd_3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(terms - 2, -1, -2):
        even_3, odd_3 = even_3 * square + even_2, odd_3 * square + odd_2
        even_2, odd_2 = even_2 * square + even_1, odd_2 * square + odd_1
        even_1, odd_1 = even_1 * square + even, odd_1 * square + odd
        even, odd = even * square + height[k], odd * square + height[k + 1]
    second, third = even_2 + x * odd_2, even_3 + x * odd_3
    rate = odd + 2.0 * x * (even_1 + x * odd_1)
    bend = 2.0 * (even_1 + x * (3.0 * odd_1 + 4.0 * x * second))
    twist = 6.0 * odd_1 + 24.0 * x * (second + x * (odd_2 + 2.0 * x * third))
    return even + x * odd, rate, bend, twist, 0.0, 0.0


SHORTEST_STEP = 1e-7
"""In x: events closer than this are not separated."""

FRESH = 1e-4
"""In x: the beginning of an arc after uplift, where rounding could feign a landing; it rises 1e-9 α."""

LANDING, SUMMIT, PASSING = np.int64(0), np.int64(1), np.int64(-1)
"""
What is searched on an arc: where h falls to 0, where it is largest, where it passes α outwards.

Of Python's own numbers numba would compile the search once for each.
"""

Arc = tuple[Wave, int]
"""In closed form, or the number of terms of its series."""

NO_WAVE: Wave = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel_fused
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


@kernel_fused
def follow(
    height: float, rate: float, critical: float, push: Push, remaining: float, is_top_wanted: bool, work: Series | None
) -> tuple[bool, float, float, float, float, float, float, float]:
    """
    Follow an arc from h (rad) and h' = dh/dx: to its end, over all that remains (in x), or up to the impact; in closed
    form without `work`.

    Returns whether the step ends in an impact; its length in x; h and h' at its end; the largest height at its end or,
    if wanted, inside; where in x it passes α outwards, NaN if it is not above α at the end, or was before; sin φ and
    cos φ at its end.
    """
    wave, terms, end = NO_WAVE, 0, min(remaining, LONGEST_STEP / max(1.0, push.ratio))
    if work is None:
        wave, start = closed_arc(height, rate, critical, push)
    else:
        terms, start, end = series_arc(height, rate, critical, push, end, work)
    arc = wave, terms
    last = _jet(end, arc, work)
    landed, x, top = False, end, last[0]
    # A chord is above a curve by at most x²/8 times the largest second derivative: most steps of a record need no more.
    largest = LARGEST_SINE * (push.weight + abs(push.lift) * end) + abs(push.q) + abs(push.change) * end
    if work is None or is_top_wanted or not min(start[0], last[0]) > 0.125 * largest * end * end:
        landed, x, last, top = _to_landing(start, end, last, is_top_wanted, arc, push, work)
    passing = np.nan
    if last[0] > critical and not height > critical:
        passing = _root(0.0, x, start, last, PASSING, critical, arc, work)[0]
    sine, cosine = last[4], last[5]
    if work is not None:
        sine_rise, cosine_rise = turned(push.sine, push.cosine, push.ratio * x)
        sine, cosine = push.sine + sine_rise, push.cosine + cosine_rise
    return landed, x, last[0], last[1], top, passing, sine, cosine


@kernel_fused
def _jet(x: float, arc: Arc, work: Series | None) -> Jet:
    if work is None:
        return closed_jet(x, arc[0])
    return series_jet(x, arc[1], work.height)


@kernel_fused
def _to_landing(
    start: Jet, end: float, whole: Jet, is_top_wanted: bool, arc: Arc, push: Push, work: Series | None
) -> tuple[bool, float, Jet, float]:
    """Find the first x in [0, end] where h falls to 0: whether it does, that x or the end, the state, and the top."""
    if start[0] <= 0.0 and start[1] < 0.0:
        return True, 0.0, start, start[0]
    fresh, left, top = start[0] == 0.0 and start[1] == 0.0, 0.0, 0.0
    fourth, fifth = _bounds(end, start[1], push, work is not None)
    while left < end:
        width, last = end - left, whole
        while True:
            told = verdict(width, start, last, fourth, fifth)
            if told != 0 or width <= SHORTEST_STEP or (fresh and left + width <= FRESH):
                break
            width *= 0.5
            last = _jet(left + width, arc, work)
        right = end if width == end - left else left + width
        landed = last[0] < 0.0
        if landed:
            if start[0] > 0.0 or width > SHORTEST_STEP:
                right, last = _root(left, right, start, last, LANDING, 0.0, arc, work)
            last = (0.0, last[1], last[2], last[3], last[4], last[5])
        top = max(top, last[0])
        if is_top_wanted and start[1] >= 0.0 and last[1] < 0.0:
            top = max(top, _root(left, right, start, last, SUMMIT, 0.0, arc, work)[1][0])
        if landed:
            return True, right, last, top
        left, start = right, last
    return False, end, start, top


@kernel_fused
def _root(
    low: float, high: float, first: Jet, last: Jet, kind: np.int64, target: float, arc: Arc, work: Series | None
) -> tuple[float, Jet]:
    """
    Find the one x in [low, high] where what is searched is, and the state there.

    Steps of fourth order (Householder) inside a shrinking bracket, from the nearer end that falls.
    """
    x, jet, tried, ratio = high, last, 0, arc[0][1]
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
        is_last = abs(step) * (1.0 + ratio) <= 1e-5 and abs(step * bend) <= 1e-2 * abs(slope)
        if is_last or tried > 60:
            h, rate, bend, twist, sine, cosine = jet
            turn = ratio * step
            rise, bent = step * (rate + 0.5 * step * bend), step * (bend + 0.5 * step * twist)
            sine, cosine = sine + turn * (cosine - 0.5 * turn * sine), cosine - turn * (sine + 0.5 * turn * cosine)
            return x + step, (h + rise, rate + bent, bend + step * twist, twist, sine, cosine)
        x += step
        jet = _jet(x, arc, work)


@kernel_fused
def _searched(jet: Jet, kind: np.int64, target: float) -> tuple[float, float, float, float]:
    """Give what falls through 0 where something is, and its derivatives as far as they are known."""
    if kind == SUMMIT:
        return jet[1], jet[2], jet[3], 0.0
    sign = 1.0 if kind == LANDING else -1.0
    return sign * (jet[0] - target), sign * jet[1], sign * jet[2], sign * jet[3]
