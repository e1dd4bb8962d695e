"""
The linear model under a harmonic base motion, in closed form over whole arcs.

While the block rocks on side s = sgn θ its height h = s θ obeys, with x = p t and the base acceleration over gravity
a/g = l sin φ, φ = Ω x + ψ, the level l constant or linear in x, and q = s l,

    h'' = h − α − q sin φ,      h = α + y + w,      w = C cosh x + D sinh x,
    y = q sin φ/(1 + Ω²) + 2 q' Ω cos φ/(1 + Ω²)².

Nothing is integrated: only impacts are searched. Between two points h is passed over where a bound on its higher
derivatives excludes an impact, and solved for where it shows that there is exactly one; the rest is halved. With
G = (h − α) + h' is G' = G − q sin φ, so that from G > max |q| still to come on, h never returns to 0: the block has
overturned.
"""

from __future__ import annotations

from math import factorial

from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.landing import FRESH, SHORTEST_STEP, verdict

State = tuple[float, float, float, float]
"""h, h', sin φ, cos φ."""
Point = tuple[float, float, float, float, float, float]
"""h, h', sin φ, cos φ, w, w'."""
Wave = tuple[float, float, float, float, float]
"""α, Ω, gain, growth and lag of a step, with y = (gain + growth x) sin φ + lag cos φ."""

ODD = tuple(1.0 / factorial(2 * k + 1) for k in range(10))
EVEN = tuple(1.0 / factorial(2 * k + 2) for k in range(10))
"""Coefficients of sinh x / x and (cosh x − 1)/x² in x²; of sin and cos with −x²."""

LONGEST_STEP = 1.25
"""In x and in φ: up to here the ten terms of `ODD` and `EVEN` leave less than rounding."""


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
def _begin(
    critical: float,
    ratio: float,
    q: float,
    change: float,
    height: float,
    rate: float,
    sine: float,
    cosine: float,
) -> tuple[Wave, Point]:
    """Begin a step of h'' = h − α − (q + change x) sin φ at a state: its y, and the state with w and w'."""
    inverse = 1.0 / (1.0 + ratio * ratio)
    gain, growth, lag = q * inverse, change * inverse, 2.0 * change * ratio * inverse * inverse
    free = height - critical - gain * sine - lag * cosine
    free_rate = rate - (growth - lag * ratio) * sine - gain * ratio * cosine
    return (critical, ratio, gain, growth, lag), (height, rate, sine, cosine, free, free_rate)


@kernel
def _turned(turn: float, sine: float, cosine: float) -> tuple[float, float]:
    """Return by how much sine and cosine of an angle change where it turns on, at most by `LONGEST_STEP`."""
    odd, even = _odd_even(-turn * turn)
    across, back = turn * odd, turn * turn * even
    return cosine * across - sine * back, -sine * across - cosine * back


@kernel
def _advance(x: float, point: Point, wave: Wave) -> Point:
    """
    State after x, at most `LONGEST_STEP` in x and in φ.

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
    return new_height, new_rate, new_sine, new_cosine, free + free_rise, new_free_rate


@kernel
def _bends(x: float, point: Point, wave: Wave) -> tuple[float, float]:
    """Second and third derivative of h by x, at the point that is x from the step's beginning."""
    height, rate, sine, cosine, _free, _free_rate = point
    critical, ratio, gain, growth, _lag = wave
    square = 1.0 + ratio * ratio
    q, change = (gain + growth * x) * square, growth * square
    return height - critical - q * sine, rate - change * sine - q * ratio * cosine


@kernel
def _verdict(x: float, start: Point, end: Point, wave: Wave) -> int:
    """Tell what happens between two points, see `landing.verdict`."""
    bend, twist = _bends(0.0, start, wave)
    end_bend, end_twist = _bends(x, end, wave)
    # w and w' are largest at an end, as w'' = w.
    _critical, ratio, gain, growth, lag = wave
    wavy = ratio**3 * (max(abs(gain), abs(gain + growth * x)) * ratio + 4.0 * abs(growth) + abs(lag) * ratio)
    fourth = max(abs(start[4]), abs(end[4])) + wavy
    fifth = max(abs(start[5]), abs(end[5])) + ratio * wavy + ratio**4 * abs(growth)
    return verdict(x, (start[0], start[1], bend, twist), (end[0], end[1], end_bend, end_twist), fourth, fifth)


@kernel
def _landing(high: float, start: Point, end: Point, wave: Wave) -> tuple[float, Point]:
    """
    Find the one x in [0, high] where h falls to 0, and the state there.

    Steps of fourth order (Householder) inside a shrinking bracket, from the nearer end that falls.
    """
    low, x, point, tried = 0.0, high, end, 0
    if 0.0 < start[0] < -end[0] and start[1] < 0.0:
        x, point = 0.0, start
    while True:
        height, rate, sine, cosine, _free, _free_rate = point
        bend, twist = _bends(x, point, wave)
        low, high = (x, high) if height > 0.0 else (low, x)
        below = 6.0 * rate**3 - 6.0 * height * rate * bend + height * height * twist
        step = -height * (6.0 * rate * rate - 3.0 * height * bend) / below if below != 0.0 else high - low
        tried += 1
        if not low <= x + step <= high or tried > 8:
            step = 0.5 * (low + high) - x
        if abs(step) * (1.0 + max(1.0, wave[1])) <= 1e-5 or tried > 60:
            turn = wave[1] * step
            arriving = rate + step * (bend + 0.5 * step * twist)
            sine_there = sine + turn * (cosine - 0.5 * turn * sine)
            cosine_there = cosine - turn * (sine + 0.5 * turn * cosine)
            return x + step, (0.0, arriving, sine_there, cosine_there, 0.0, 0.0)
        x += step
        point = _advance(x, start, wave)


@kernel
def _summit(high: float, start: Point, wave: Wave) -> float:
    """Largest height in [0, high] of a piece that rises at its start and falls at its end."""
    low, x, height = 0.0, 0.5 * high, start[0]
    for _ in range(60):
        point = _advance(x, start, wave)
        bend, height = _bends(x, point, wave)[0], max(height, point[0])
        low, high = (x, high) if point[1] > 0.0 else (low, x)
        following = x - point[1] / bend if bend < 0.0 else low
        if abs(following - x) <= 1e-9 * high:
            break
        x = following if low < following < high else 0.5 * (low + high)
    return height


@kernel
def closed_arc(
    state: State,
    side: float,
    critical: float,
    p: float,
    omega: float,
    level: float,
    slope: float,
    remaining: float,
    is_top_wanted: bool,
) -> tuple[bool, float, float, State]:
    """
    Follow an arc as far as bounds tell what happens: a step, all that remains, or up to the impact.

    Parameters
    ----------
    state : tuple of float
        h, h', sin φ, cos φ.
    side : float
        ±1.
    critical, p, omega : float
        rad; rad/s.
    level, slope : float
        l at the beginning, and its change, 1/s.
    remaining : float
        In x, at most.
    is_top_wanted : bool
        Whether the top of the arc counts if it is inside the step.

    Returns
    -------
    landed, x, top, state
        Whether the step ends in an impact; its length; the largest height at its end or, if wanted, inside; the state.
    """
    height, rate, sine, cosine = state
    q, change, ratio = side * level, side * slope / p, omega / p
    wave, point = _begin(critical, ratio, q, change, height, rate, sine, cosine)
    landed, last = height <= 0.0 and rate < 0.0, point
    x = 0.0 if landed else min(remaining, LONGEST_STEP / max(1.0, ratio))
    while not landed:
        last = _advance(x, point, wave)
        told = _verdict(x, point, last, wave)
        if told != 0 or x <= SHORTEST_STEP or (x <= FRESH and height == 0.0 and rate == 0.0):
            landed = last[0] < 0.0
            break
        x *= 0.5
    if landed and x > SHORTEST_STEP:
        x, last = _landing(x, point, last, wave)
    is_inside = is_top_wanted and point[1] >= 0.0 and last[1] < 0.0
    top = _summit(x, point, wave) if is_inside else last[0]
    return landed, x, top, (last[0], last[1], last[2], last[3])
