"""
The nonlinear model under a harmonic base motion, by Taylor series with impacts located on the series themselves.

While the block rocks on side s = sgn θ, u = α − s θ obeys, with x = p t and the base acceleration over gravity
a/g = l sin φ, φ = Ω x + ψ, the level l constant or on a ramp, which is linear or half a cosine, and q = s l,

    u'' = sin u + q sin φ cos u.

Sine and cosine of the series of u follow by recurrence, and the series of q sin φ is known, so that nothing of the
motion is sampled. Between two points of a series the height h = α − u is passed over where a bound on its higher
derivatives excludes an impact, and solved for where it shows that there is exactly one; the rest is halved. Beyond α,
outwards and past α + atan max |q|, the block only gathers speed: it has overturned. All kernels of this chain stand
in this file (see `kernel`); `run` and `column` are called as those of `harmonic`.
"""

from __future__ import annotations

from math import asin, atan, cos, pi, sin, sqrt, tan

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.kernel import kernel

Array = NDArray[np.float64]
Codes = NDArray[np.int8]
Triple = tuple[float, float, float]
Piece = tuple[float, float, float, float]
"""Level where a part begins, slope, swing and turn (rad/s): l(τ) = level + slope τ + swing cos(turn τ)."""
Point = tuple[float, float, float, float]
"""Height and its first three derivatives by x."""

ORDER = 18
"""Terms of a series; the step is chosen so that the last ones are below rounding."""

RECIPROCAL = 1.0 / np.maximum(np.arange(ORDER + 1), 1)

ROUNDING = 1e-15
"""What the last term of a series may come to at the end of its step, as a fraction of α."""

NO_ROCKING, ROCKING, OVERTURNED = 0, 1, 2
"""Codes of outcomes."""

SHORTEST_STEP = 1e-7
"""In x: what happens within is not told apart."""

FRESH = 1e-4
"""In x: the beginning of an arc after uplift, where rounding could feign a landing; it rises 1e-9 α."""


@kernel
def _piece(begins: float, ends: float, duration: float, smooth: bool | None) -> Piece:
    """Envelope of a part between two levels, linear or half a cosine."""
    if smooth is None or begins == ends:
        return begins, (ends - begins) / duration, 0.0, 0.0
    return 0.5 * (begins + ends), 0.0, 0.5 * (begins - ends), pi / duration


@kernel
def _level(piece: Piece, since: float) -> tuple[float, float]:
    """Level and its slope at a time since the part began."""
    level, slope, swing, turn = piece
    if swing == 0.0:
        return level + slope * since, slope
    return level + swing * cos(turn * since), -swing * turn * sin(turn * since)


@kernel
def _swing(
    smooth: bool | None, forcing: Array, side: float, p: float, piece: Piece, since: float, ratio: float, phase: float
) -> None:
    """Set the Taylor coefficients in x of what half a cosine adds to q sin φ: two more sines."""
    for k in range(ORDER - 1):
        forcing[k] = 0.0
    if smooth is not None:
        amplitude, turn = 0.5 * side * piece[2], piece[3]
        for direction in (1.0, -1.0):
            angle, speed = phase + direction * turn * since, ratio + direction * turn / p
            even, odd = amplitude * sin(angle), amplitude * cos(angle)
            forcing[0] += even
            for k in range(1, ORDER - 1):
                share = speed * RECIPROCAL[k]
                even, odd = odd * share, -even * share
                forcing[k] += even


@kernel
def _expand(height: Array, work: Array, critical: float, ratio: float, q: float, change: float, phase: float) -> float:
    """
    Complete the Taylor coefficients of h about x = 0, of which the first two are given; return the step they allow.

    `q` is the level at x = 0, `change` its slope; `work` has rows for the series of sin u, cos u, q sin φ and u'. To
    what the third holds, the series of (q + change x) sin φ is added.
    """
    sine, cosine, forcing, turn = work[0], work[1], work[2], work[3]
    angle = critical - height[0]
    sine[0], cosine[0] = sin(angle), cos(angle)
    even, odd, growth = sin(phase), cos(phase), 0.0
    forcing[0] += q * even
    turn[1], turn[2] = -height[1], sine[0] + forcing[0] * cosine[0]
    height[2] = -0.5 * turn[2]
    for k in range(1, ORDER - 1):
        # even: k-th Taylor coefficient of sin φ; growth: the one before.
        share = ratio * RECIPROCAL[k]
        even, odd, growth = odd * share, -even * share, even
        forcing[k] += q * even + change * growth
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
def _at(height: Array, x: float) -> Point:
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
def _verdict(width: float, start: Point, end: Point, fourth: float, fifth: float) -> int:
    """
    Tell from bounds what happens between two points, the first at h ≥ 0.

    Returns 1 where there is no impact, −1 where h falls to 0 exactly once, 0 where the bounds cannot tell.
    """
    eighth = 0.125 * width * width
    # A function lies above the lower of its ends less width²/8 of what its second derivative is at most.
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


@kernel
def _first_landing(height: Array, end: float) -> tuple[bool, float, Point]:
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
            verdict = _verdict(width, start, last, fourth, fifth)
            if verdict != 0 or width <= SHORTEST_STEP or (fresh and left + width <= FRESH):
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
def _landing(height: Array, low: float, high: float, point: Point) -> tuple[float, Point]:
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
def _uplift(
    start: float, end: float, begin: float, omega: float, phase: float, piece: Piece, negative: float, positive: float
) -> tuple[float, float]:
    """
    Find when in [start, end] a block at rest uplifts, and to which side; (inf, 0) where it stays.

    The base acceleration over gravity is l(t − begin) sin(ω t + phase), l ≥ 0; the block uplifts to θ < 0 where that
    passes `negative`, to θ > 0 where its opposite passes `positive`.
    """
    angle, level = omega * start + phase, _level(piece, start - begin)[0]
    now = level * sin(angle)
    if now > negative or -now > positive:
        return start, -1.0 if now > 0.0 else 1.0
    if omega == 0.0 or max(level, _level(piece, end - begin)[0]) <= min(negative, positive):
        return np.inf, 0.0
    if piece[1] == 0.0 and piece[2] == 0.0:
        first, second = np.inf, np.inf
        if level > negative:
            first = start + ((asin(negative / level) - angle) % (2.0 * pi)) / omega
        if level > positive:
            second = start + ((pi + asin(positive / level) - angle) % (2.0 * pi)) / omega
        return (min(first, second), -1.0 if first < second else 1.0) if min(first, second) < end else (np.inf, 0.0)
    # On a ramp, half a wave at a time: the logarithm of l |sin φ| is concave there, so that it has one top.
    low = start
    while low < end:
        half = np.floor((omega * low + phase) / pi + 1e-12)
        high = min(end, ((half + 1.0) * pi - phase) / omega)
        side, threshold = (-1.0, negative) if half % 2.0 == 0.0 else (1.0, positive)
        bottom, top, right = low, low, high
        for _ in range(60):
            middle = 0.5 * (top + right)
            level, slope = _level(piece, middle - begin)
            growing = slope + level * omega / tan(omega * middle + phase) > 0.0
            top, right = (middle, right) if growing else (top, middle)
        if _level(piece, top - begin)[0] * abs(sin(omega * top + phase)) > threshold:
            for _ in range(60):
                middle = 0.5 * (bottom + top)
                above = _level(piece, middle - begin)[0] * abs(sin(omega * middle + phase)) > threshold
                bottom, top = (bottom, middle) if above else (middle, top)
            return top, side
        low = high
    return np.inf, 0.0


@kernel
def _restitution(sides: Array, law: Array, here: int, speed: float) -> float:
    """Give e of an impact that ends an arc on side `here`: of the side, or at its |ω| (rad/s) where there is a law."""
    size = law.shape[1]
    if size == 0:
        return float(sides[2, here])
    low, high = -1, size
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if law[0, middle] <= speed else (low, middle)
    if low < 0 or high == size:
        return float(law[1, max(0, low)])
    share = (speed - law[0, low]) / (law[0, high] - law[0, low])
    return float(law[1, low] + share * (law[1, high] - law[1, low]))


@kernel
def run(
    forcing: Triple,
    edges: Array,
    smooth: bool | None,
    sides: Array,
    law: Array,
    rest_angle: float,
    watch: Triple,
    samples: Array,
    impacts: Array,
) -> tuple[bool, float, int]:
    """Run the block from rest; arguments and results as for `harmonic.run`."""
    critical, p = sides[0], sides[1]
    omega, phase, level = forcing
    watched, floor, interval = watch
    count, taken, peak, begin, reached = 0, 0, 0.0, 0.0, 0.0
    overturned, resting, side, here = False, True, 1.0, 1
    height, rate = 0.0, 0.0
    thresholds = (tan(critical[0]), tan(critical[1]))
    series, work = np.empty(ORDER + 1), np.empty((4, ORDER + 1))
    samples[:] = 0.0
    for part in range(3):
        end = edges[part]
        beginning = level if part == 1 else reached
        reached = level if part < 2 else 0.0
        if end <= begin:
            continue
        piece, now = _piece(beginning, reached, end - begin, smooth), begin
        while now < end:
            if resting:
                now, side = _uplift(now, end, begin, omega, phase, piece, thresholds[0], thresholds[1])
                while taken < samples.shape[0] and taken * interval <= min(now, end):
                    taken += 1
                if side == 0.0:
                    break
                resting, here = False, 1 if side > 0.0 else 0
                height, rate = 0.0, 0.0
            stop = min(end, taken * interval) if taken < samples.shape[0] else end
            since = now - begin

            # One series: to its end, to the stop or to the impact.
            series[0], series[1] = height, rate
            q, change = side * (piece[0] + piece[1] * since), side * piece[1] / p[here]
            ratio, angle = omega / p[here], omega * now + phase
            _swing(smooth, work[2], side, p[here], piece, since, ratio, angle)
            allowed = _expand(series, work, critical[here], ratio, q, change, angle)
            remaining = p[here] * (stop - now)
            landed, x, last = _first_landing(series, min(remaining, allowed))
            before, height, rate = rate, last[0], last[1]
            if now >= watched and not overturned:
                summit = height
                if before >= 0.0 and rate < 0.0 and peak <= floor:
                    summit = _summit(series, x)
                peak = max(peak, summit / critical[here])
            now = stop if x == remaining else now + x / p[here]

            if not landed:
                if height - critical[here] > atan(level if part < 2 else _level(piece, since)[0]) and rate > 0.0:
                    overturned = True
                    if taken >= samples.shape[0]:
                        return True, peak, count
                if overturned and height >= 0.5 * pi:
                    samples[taken:, 0] = side * 0.5 * pi
                    return True, peak, count
                if taken < samples.shape[0] and now >= taken * interval:
                    samples[taken, 0], samples[taken, 1] = side * height, side * rate * p[here]
                    taken += 1
                continue
            if count < impacts.shape[0]:
                impacts[count, 0], impacts[count, 1] = now, side * rate * p[here]
            count += 1
            there = 1 - here
            e = _restitution(sides, law, here, -rate * p[here])
            height, rate = 0.0, max(0.0, -e * rate * p[here] / p[there])
            side, here = -side, there
            base = _level(piece, now - begin)[0] * sin(omega * now + phase)
            holding = sin(critical[here]) + side * base * cos(critical[here])
            if holding >= 0.0 and 0.5 * rate * rate <= rest_angle * critical[here] * holding:
                resting = True
        begin = end
    if resting or overturned:
        return overturned, peak, count

    # Left to itself: its energy tells whether it passes α, and what is left of it after the first impact.
    energy = 0.5 * rate * rate + cos(critical[here] - height)
    beyond = height > critical[here]
    if (beyond and (rate >= 0.0 or energy <= 1.0)) or (not beyond and rate > 0.0 and energy > 1.0):
        return True, peak, count
    there = 1 - here
    arriving = sqrt(max(2.0 * (energy - cos(critical[here])), 0.0)) * p[here]
    after = _restitution(sides, law, here, arriving) * arriving / p[there]
    return 0.5 * after * after + cos(critical[there]) > 1.0, peak, count


@kernel
def column(
    omega: float,
    phase: float,
    levels: Array,
    edges: Array,
    smooth: bool | None,
    sides: Array,
    law: Array,
    rest_angle: float,
    no_rocking: float,
) -> Codes:
    """Codes of the outcomes under many levels, as for `harmonic.column`."""
    outcomes = np.empty(levels.size, dtype=np.int8)
    none, watch = np.empty((0, 2)), (0.0, no_rocking, 1.0)
    for index in range(levels.size):
        forcing = (omega, phase, levels[index])
        overturned, peak, _count = run(forcing, edges, smooth, sides, law, rest_angle, watch, none, none)
        outcomes[index] = OVERTURNED if overturned else ROCKING if peak > no_rocking else NO_ROCKING
    return outcomes
