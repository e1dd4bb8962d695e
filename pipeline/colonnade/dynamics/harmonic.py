"""
The linear model under a harmonic base motion, in closed form over whole arcs.

While the block rocks on side s = sgn θ its height h = s θ obeys, with x = p t and the base acceleration over gravity
a/g = l sin φ, φ = Ω x + ψ, the level l constant or on a ramp, which is linear in x or half a cosine, and q = s l,

    h'' = h − α − q sin φ,      h = α + y + w,      w = C cosh x + D sinh x,
    y = q sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)²                                               where q is linear,
    y = q₀ sin φ/(1 + Ω²) + b/2 [sin(φ + χ)/(1 + (Ω + ν)²) + sin(φ − χ)/(1 + (Ω − ν)²)]    where q = q₀ + b cos χ.

The latter, with χ' = ν, is three sines, taken as (g₀ + g cos χ) sin φ + m sin χ cos φ; only motions with such ramps pay
for them, since for the others the kernels are compiled with None in their place. Nothing is integrated: only impacts
are searched. Between two points h is passed over where a bound on its higher derivatives excludes an impact, and solved
for where it shows that there is exactly one; the rest is halved. With G = (h − α) + h' is G' = G − q sin φ, so that
from G > max |q| still to come on, h never returns to 0: the block has overturned. All kernels of this chain stand in
this file (see `kernel`).
"""

from __future__ import annotations

from math import asin, cos, factorial, pi, sin, sqrt, tan

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.kernel import kernel

Array = NDArray[np.float64]
Codes = NDArray[np.int8]
Triple = tuple[float, float, float]
Piece = tuple[float, float, float, float]
"""Level where a part begins, slope, swing and turn (rad/s): l(τ) = level + slope τ + swing cos(turn τ)."""
Point = tuple[float, float, float, float, float, float]
"""h, h', sin φ, cos φ, w, w'."""
Wave = tuple[float, float, float, float, float]
"""α, Ω, gain, growth and lag of a step, with y = (gain + growth x) sin φ + lag cos φ."""
Swing = tuple[float, float, float, float, float, float, float]
"""What half a cosine adds: ν, b, g and m; sin χ and cos χ where the step begins; a bound of its fourth derivative."""

ODD = tuple(1.0 / factorial(2 * k + 1) for k in range(10))
EVEN = tuple(1.0 / factorial(2 * k + 2) for k in range(10))
"""Coefficients of sinh x / x and (cosh x − 1)/x² in x²; of sin and cos with −x²."""

LONGEST_STEP = 1.25
"""In x and in φ: up to here the ten terms of `ODD` and `EVEN` leave less than rounding."""

NO_ROCKING, ROCKING, OVERTURNED = 0, 1, 2
"""Codes of outcomes."""

SHORTEST_STEP, FRESH = 1e-7, 1e-4
"""In x: what is not told apart; and the beginning of an arc after uplift, where rounding could feign a landing."""


@kernel
def _odd_even(z: float) -> tuple[float, float]:
    """Return sinh x / x and (cosh x − 1)/x² for z = x²; sin x / x and (1 − cos x)/x² for z = −x²."""
    odd, even = ODD[9], EVEN[9]
    odd, even = odd * z + ODD[8], even * z + EVEN[8]
    odd, even = odd * z + ODD[7], even * z + EVEN[7]
    odd, even = odd * z + ODD[6], even * z + EVEN[6]
    odd, even = odd * z + ODD[5], even * z + EVEN[5]
    odd, even = odd * z + ODD[4], even * z + EVEN[4]
    odd, even = odd * z + ODD[3], even * z + EVEN[3]
    odd, even = odd * z + ODD[2], even * z + EVEN[2]
    odd, even = odd * z + ODD[1], even * z + EVEN[1]
    return odd * z + ODD[0], even * z + EVEN[0]


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
def _swing(smooth: bool | None, side: float, p: float, piece: Piece, since: float, ratio: float) -> Swing | None:
    """Set up what half a cosine adds to a step; None where no ramp of the motion is one."""
    if smooth is None:
        return None
    turning, amplitude, angle = piece[3] / p, 0.5 * side * piece[2], piece[3] * since
    above, below = (ratio + turning) ** 2, (ratio - turning) ** 2
    upper, lower = amplitude / (1.0 + above), amplitude / (1.0 + below)
    fourth = abs(upper) * above * above + abs(lower) * below * below
    return turning, 2.0 * amplitude, upper + lower, upper - lower, sin(angle), cos(angle), fourth


@kernel
def _begin(
    critical: float,
    ratio: float,
    q: float,
    change: float,
    height: float,
    rate: float,
    sine: float,
    cosine: float,
    swing: Swing | None,
) -> tuple[Wave, Point]:
    """Begin a step of h'' = h − α − (q + change x + b cos χ) sin φ at a state: its y, and the state with w and w'."""
    inverse = 1.0 / (1.0 + ratio * ratio)
    gain, growth, lag = q * inverse, change * inverse, 2.0 * change * ratio * inverse * inverse
    free = height - critical - gain * sine - lag * cosine
    free_rate = rate - (growth - lag * ratio) * sine - gain * ratio * cosine
    if swing is not None:
        turning, _b, more, lead, across, along, _fourth = swing
        free -= more * along * sine + lead * across * cosine
        free_rate += (more * turning + lead * ratio) * across * sine - (more * ratio + lead * turning) * along * cosine
    return (critical, ratio, gain, growth, lag), (height, rate, sine, cosine, free, free_rate)


@kernel
def _turned(turn: float, sine: float, cosine: float) -> tuple[float, float]:
    """Return by how much sine and cosine of an angle change where it turns on, at most by `LONGEST_STEP`."""
    odd, even = _odd_even(-turn * turn)
    across, back = turn * odd, turn * turn * even
    return cosine * across - sine * back, -sine * across - cosine * back


@kernel
def _advance(x: float, point: Point, wave: Wave, swing: Swing | None) -> Point:
    """
    State after x, at most `LONGEST_STEP` in x, in φ and in χ.

    All is formed from differences to the point, so that short arcs keep their digits.
    """
    height, _rate, sine, cosine, free, free_rate = point
    _critical, ratio, gain, growth, lag = wave
    odd, even = _odd_even(x * x)
    sinh, rise = x * odd, x * x * even
    sine_rise, cosine_rise = _turned(ratio * x, sine, cosine)
    new_sine, new_cosine = sine + sine_rise, cosine + cosine_rise
    free_rise, new_gain = free * rise + free_rate * sinh, gain + growth * x
    new_free_rate = free_rate + free * sinh + free_rate * rise
    new_height = height + free_rise + gain * sine_rise + growth * x * new_sine + lag * cosine_rise
    new_rate = new_free_rate + (growth - lag * ratio) * new_sine + new_gain * ratio * new_cosine
    if swing is not None:
        turning, _b, more, lead, across, along, _fourth = swing
        across_rise, along_rise = _turned(turning * x, across, along)
        new_height += more * (along * sine_rise + along_rise * new_sine)
        new_height += lead * (across * cosine_rise + across_rise * new_cosine)
        new_rate -= (more * turning + lead * ratio) * (across + across_rise) * new_sine
        new_rate += (more * ratio + lead * turning) * (along + along_rise) * new_cosine
    return new_height, new_rate, new_sine, new_cosine, free + free_rise, new_free_rate


@kernel
def _bends(x: float, point: Point, wave: Wave, swing: Swing | None) -> tuple[float, float]:
    """Second and third derivative of h by x, at the point that is x from the step's beginning."""
    height, rate, sine, cosine, _free, _free_rate = point
    critical, ratio, gain, growth, _lag = wave
    square = 1.0 + ratio * ratio
    q, change = (gain + growth * x) * square, growth * square
    if swing is not None:
        turning, amplitude, _more, _lead, across, along, _fourth = swing
        across_rise, along_rise = _turned(turning * x, across, along)
        q += amplitude * (along + along_rise)
        change -= amplitude * turning * (across + across_rise)
    return height - critical - q * sine, rate - change * sine - q * ratio * cosine


@kernel
def _quickest(wave: Wave, swing: Swing | None) -> float:
    """Return what turns fastest by x: the hyperbolic functions, φ or χ."""
    quickest = max(1.0, wave[1])
    if swing is not None:
        turning, _b, _more, _lead, _across, _along, _fourth = swing
        quickest = max(quickest, turning)
    return quickest


@kernel
def _verdict(x: float, start: Point, end: Point, wave: Wave, swing: Swing | None) -> int:
    """
    Tell from bounds what happens between two points, the first at h ≥ 0.

    Returns 1 where there is no impact, −1 where h falls to 0 exactly once, 0 where the bounds cannot tell.
    """
    bend, twist = _bends(0.0, start, wave, swing)
    end_bend, end_twist = _bends(x, end, wave, swing)
    # w and w' are largest at an end, as w'' = w.
    _critical, ratio, gain, growth, lag = wave
    wavy = ratio**3 * (max(abs(gain), abs(gain + growth * x)) * ratio + 4.0 * abs(growth) + abs(lag) * ratio)
    fourth = max(abs(start[4]), abs(end[4])) + wavy
    fifth = max(abs(start[5]), abs(end[5])) + ratio * wavy + ratio**4 * abs(growth)
    if swing is not None:
        turning, _b, _more, _lead, _across, _along, added = swing
        fourth += added
        fifth += (ratio + turning) * added
    eighth = 0.125 * x * x
    # A function lies above the lower of its ends less x²/8 of what its second derivative is at most.
    most = max(bend, end_bend) + eighth * fourth
    if end[0] < 0.0:
        steepest = max(abs(twist), abs(end_twist)) + eighth * fifth
        return -1 if most < 0.0 or max(start[1], end[1]) + eighth * steepest < 0.0 else 0
    if most <= 0.0 or min(start[0], end[0]) > eighth * most:
        return 1
    # From the start: h ≥ h0 + h0' x + h0'' x²/2 + L x³/6 with L ≤ h''' throughout.
    if start[1] < 0.0:
        return 0
    least = min(twist, end_twist) - eighth * fifth
    if least > 0.0 and (bend >= 0.0 or (start[0] == 0.0 and start[1] == 0.0 and bend > -1e-9)):
        return 1
    return 1 if start[1] + 0.5 * bend * x + min(least, 0.0) * x * x / 6.0 > 0.0 else 0


@kernel
def _landing(high: float, start: Point, end: Point, wave: Wave, swing: Swing | None) -> tuple[float, Point]:
    """
    Find the one x in [0, high] where h falls to 0, and the state there.

    Steps of fourth order (Householder) inside a shrinking bracket, from the nearer end that falls.
    """
    low, x, point, tried = 0.0, high, end, 0
    if 0.0 < start[0] < -end[0] and start[1] < 0.0:
        x, point = 0.0, start
    while True:
        height, rate, sine, cosine, _free, _free_rate = point
        bend, twist = _bends(x, point, wave, swing)
        low, high = (x, high) if height > 0.0 else (low, x)
        below = 6.0 * rate**3 - 6.0 * height * rate * bend + height * height * twist
        step = -height * (6.0 * rate * rate - 3.0 * height * bend) / below if below != 0.0 else high - low
        tried += 1
        if not low <= x + step <= high or tried > 8:
            step = 0.5 * (low + high) - x
        if abs(step) * (1.0 + _quickest(wave, swing)) <= 1e-5 or tried > 60:
            turn = wave[1] * step
            arriving = rate + step * (bend + 0.5 * step * twist)
            sine_there = sine + turn * (cosine - 0.5 * turn * sine)
            cosine_there = cosine - turn * (sine + 0.5 * turn * cosine)
            return x + step, (0.0, arriving, sine_there, cosine_there, 0.0, 0.0)
        x += step
        point = _advance(x, start, wave, swing)


@kernel
def _summit(high: float, start: Point, wave: Wave, swing: Swing | None) -> float:
    """Largest height in [0, high] of a piece that rises at its start and falls at its end."""
    low, x, height = 0.0, 0.5 * high, start[0]
    for _ in range(60):
        point = _advance(x, start, wave, swing)
        bend, height = _bends(x, point, wave, swing)[0], max(height, point[0])
        low, high = (x, high) if point[1] > 0.0 else (low, x)
        following = x - point[1] / bend if bend < 0.0 else low
        if abs(following - x) <= 1e-9 * high:
            break
        x = following if low < following < high else 0.5 * (low + high)
    return height


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
    """
    Run the block from rest under a/g = l(t) sin(ω t + ψ), l rising to `level`, constant, and falling to 0.

    Parameters
    ----------
    forcing : tuple of float
        ω, rad/s; ψ, rad; largest a/g.
    edges : ndarray, shape (3,)
        s: end of the rise, of the constant level and of the fall; equal ones leave a part out.
    smooth : True or None
        Rise and fall are half a cosine; linear with None.
    sides : ndarray, shape (3, 2)
        α (rad), p (rad/s) and e on the sides θ < 0 and θ > 0, as in `linear.propagate`.
    law : ndarray, shape (2, m)
        |ω| (rad/s) before an impact, rising, and e there, linear between them; without any, e is that of `sides`.
    rest_angle : float
        Rest rule of `linear.propagate`, as a fraction of α.
    watch : tuple of float
        Time (s) from which peaks count, |θ|/α above which they need not be exact, and interval of samples (s).
    samples : ndarray, shape (n, 2)
        Filled with θ (rad) and ω (rad/s) from time 0 on; a block past return lies at ±π/2 in the end.
    impacts : ndarray, shape (m, 2)
        Filled with time (s) and angular velocity before (rad/s) of the first m impacts.

    Returns
    -------
    overturned : bool
        Left to itself where the motion ends.
    peak, count : float, int
        Largest |θ|/α under the motion up to overturning, where `watch` counts it; number of impacts.
    """
    (omega, phase, level), (watched, floor, interval) = forcing, watch
    critical, p = sides[0], sides[1]
    count, taken, peak, begin, reached = 0, 0, 0.0, 0.0, 0.0
    overturned, resting, side, here = False, True, 1.0, 1
    height, rate, sine, cosine = 0.0, 0.0, 0.0, 1.0
    samples[:] = 0.0
    for part in range(3):
        end = edges[part]
        beginning = level if part == 1 else reached
        reached = level if part < 2 else 0.0
        if end <= begin:
            continue
        piece, now = _piece(beginning, reached, end - begin, smooth), begin
        sine, cosine = sin(omega * now + phase), cos(omega * now + phase)
        while now < end:
            if resting:
                now, side = _uplift(now, end, begin, omega, phase, piece, critical[0], critical[1])
                while taken < samples.shape[0] and taken * interval <= min(now, end):
                    taken += 1
                if side == 0.0:
                    break
                resting, here = False, 1 if side > 0.0 else 0
                height, rate = 0.0, 0.0
                sine, cosine = sin(omega * now + phase), cos(omega * now + phase)
            stop = min(end, taken * interval) if taken < samples.shape[0] else end
            since, ratio = now - begin, omega / p[here]
            q, change = side * (piece[0] + piece[1] * since), side * piece[1] / p[here]
            swing = _swing(smooth, side, p[here], piece, since, ratio)
            wave, point = _begin(critical[here], ratio, q, change, height, rate, sine, cosine, swing)

            # One step: as far as bounds tell what happens, to the stop or to the impact.
            remaining = p[here] * (stop - now)
            landed, last = height <= 0.0 and rate < 0.0, point
            x = 0.0 if landed else min(remaining, LONGEST_STEP / _quickest(wave, swing))
            while not landed:
                last = _advance(x, point, wave, swing)
                verdict = _verdict(x, point, last, wave, swing)
                if verdict != 0 or x <= SHORTEST_STEP or (x <= FRESH and height == 0.0 and rate == 0.0):
                    landed = last[0] < 0.0
                    break
                x *= 0.5
            if landed and x > SHORTEST_STEP:
                x, last = _landing(x, point, last, wave, swing)
            if now >= watched and not overturned:
                inside = point[1] >= 0.0 and last[1] < 0.0 and peak <= floor
                peak = max(peak, (_summit(x, point, wave, swing) if inside else last[0]) / critical[here])
            now = stop if x == remaining else now + x / p[here]
            height, rate, sine, cosine = last[0], last[1], last[2], last[3]

            if not landed:
                if height - critical[here] + rate > (level if part < 2 else _level(piece, since)[0]):
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
            holding = critical[here] + side * _level(piece, now - begin)[0] * sine
            if holding >= 0.0 and 0.5 * rate * rate <= rest_angle * critical[here] * holding:
                resting = True
        begin = end
    if resting or overturned:
        return overturned, peak, count

    # Left to itself: by w to the top, or by its energy to the first impact, after which e decides.
    beyond = height - critical[here]
    if beyond + rate > 0.0:
        return True, peak, count
    arriving = p[here] * sqrt(max(rate * rate - beyond * beyond + critical[here] ** 2, 0.0))
    there = 1 - here
    return _restitution(sides, law, here, arriving) * arriving > p[there] * critical[there], peak, count


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
    """Codes of the outcomes under many levels; the block has not rocked where |θ|/α stays at or below `no_rocking`."""
    outcomes = np.empty(levels.size, dtype=np.int8)
    none, watch = np.empty((0, 2)), (0.0, no_rocking, 1.0)
    for index in range(levels.size):
        forcing = (omega, phase, levels[index])
        overturned, peak, _count = run(forcing, edges, smooth, sides, law, rest_angle, watch, none, none)
        outcomes[index] = OVERTURNED if overturned else ROCKING if peak > no_rocking else NO_ROCKING
    return outcomes
