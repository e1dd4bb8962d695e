"""The two sides of a block as kernels see them: uplift, impacts, coming to rest, samples in which nothing happens."""

from __future__ import annotations

from math import asin, cos, pi, sin, sqrt, tan
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel_fused, kernel_in_place
from colonnade.dynamics.plane.arc import excess_rise
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE, Given, RestitutionLaw, of_sides

Pair = tuple[float, float]
"""Of the side θ < 0 and of θ > 0."""


class Sides(NamedTuple):
    """
    The block on its sides θ < 0 and θ > 0: α (rad), p (rad/s); e at `speeds` as of `restitution_of`.

    After an impact whose next arc, under the base acceleration of that instant, would not rise above `rest_angle` α,
    the block is at rest until the base acceleration uplifts it again.
    """

    critical: Pair
    p: Pair
    restitution: Array
    speeds: Array
    rest_angle: float


def sides_of(block: Block, restitution: Given, rest_angle: float = DEFAULT_REST_ANGLE) -> Sides:
    """
    Put a block, its restitution and its rule of rest into the form that the kernels take; ValueError if e is not
    between 0 and 1.
    """
    if isinstance(restitution, RestitutionLaw):
        speeds, values = restitution.speeds, np.tile(restitution.values, 2)
    else:
        speeds, values = np.zeros(1), np.array(of_sides(block, restitution))
    left, right = block.sides
    critical, p = (left.critical_angle, right.critical_angle), (block.side_p(left), block.side_p(right))
    return Sides(critical, p, values, speeds, rest_angle)


@kernel_in_place
def of_side(pair: Pair, here: int) -> float:
    """Choose by side; compiled, an index that is not constant branches and may raise."""
    return pair[1] if here else pair[0]


@kernel_in_place
def restitution_of(restitution: Array, speeds: Array, here: int, velocity: float) -> float:
    """
    Give e of an impact that ends an arc on side `here` (0 for θ < 0, 1 for θ > 0).

    `restitution`, shape (2 m,), is e at `speeds`, shape (m,), rad/s, on the one side and then on the other; linear
    between them, constant beyond.
    """
    if speeds.size == 1:
        return float(restitution[here])
    speed, first = abs(velocity), here * speeds.size
    above = min(max(int(np.searchsorted(speeds, speed)), 1), speeds.size - 1)
    share = min(max((speed - speeds[above - 1]) / (speeds[above] - speeds[above - 1]), 0.0), 1.0)
    lower, upper = restitution[first + above - 1], restitution[first + above]
    return float(lower + share * (upper - lower))


@kernel_in_place
def rebound(rate: float, here: int, weight: float, pull: float, sides: Sides, linearised: bool) -> tuple[float, bool]:
    """
    Give dh/dx after an impact that ends an arc on side `here` with dh/dx = `rate`, and whether the block then rests.

    `weight` is 1 + v/g with the vertical base acceleration v, and `pull` a/g, at that instant. The block rests if it
    is held down, and its next arc, of the energy (dh/dx)²/2 over m g R, stays below `rest_angle` α.
    """
    there, (_, _, restitution, speeds, rest_angle) = 1 - here, sides
    critical, p = of_side(sides.critical, there), of_side(sides.p, here)
    e = restitution_of(restitution, speeds, here, rate * p)
    leaving = max(0.0, -e * rate * p / of_side(sides.p, there))
    against = (2.0 * there - 1.0) * pull
    holding = weight * critical + against if linearised else weight * sin(critical) + against * cos(critical)
    if holding >= 0.0 and 0.5 * leaving * leaving <= rest_angle * critical * holding:
        return 0.0, True
    return leaving, False


@kernel_in_place
def _hill(lean: float, linearised: bool) -> float:
    """Potential over m g R at lean = α − |θ|; 0 where the centre of mass is above the pole."""
    return -0.5 * lean * lean if linearised else -2.0 * sin(0.5 * lean) ** 2


@kernel_in_place
def survives_free_rocking(height: float, rate: float, here: int, sides: Sides, linearised: bool) -> bool:
    """
    Tell whether a block that rocks on side `here`, left on a base at rest, comes back to stand.

    `height` is |θ|, `rate` its velocity over p. What is left after one impact decides both sides: every later impact
    only takes energy.
    """
    alpha, there = of_side(sides.critical, here), 1 - here
    # The energy shows whether the block passes α, outwards, or from beyond it back inwards.
    energy = 0.5 * rate * rate + _hill(alpha - height, linearised)
    if (height > alpha and (rate >= 0.0 or energy <= 0.0)) or (height <= alpha and rate > 0.0 and energy > 0.0):
        return False
    arriving = of_side(sides.p, here) * sqrt(max(2.0 * (energy - _hill(alpha, linearised)), 0.0))
    leaving = restitution_of(sides.restitution, sides.speeds, here, arriving) * arriving / of_side(sides.p, there)
    return bool(0.5 * leaving * leaving + _hill(of_side(sides.critical, there), linearised) <= 0.0)


HALVINGS = 60
"""Of an interval: down to rounding."""

ABOVE = 1.0 + 1e-14
"""Of a threshold, from which on it is passed: what is above it by rounding alone would hop without end."""


class Part(NamedTuple):
    """
    A part of a base motion: a/g = (level + slope t) sin(ω t + phase), its weight 1 + v/g = weight + lift t.

    t goes from 0 to `length`, s. With ω = 0 and phase = π/2 it is what a record is between two samples.
    """

    length: float
    level: float
    slope: float
    weight: float
    lift: float
    omega: float
    phase: float


@kernel_in_place
def uplift(start: float, part: Part, thresholds: Pair) -> tuple[float, int]:
    """
    Find when from `start` on a block at rest uplifts in a part, and on which side; (inf, 0) where it stays.

    It uplifts to θ < 0 (side 0) where a/g is above the first threshold times the weight, to θ > 0 (side 1) where −a/g
    is above the second, both strictly.
    """
    end, level, slope, weight, lift, omega, phase = part
    now, sine = level + slope * start, sin(omega * start + phase)
    for k in (0, 1) if now * sine > 0.0 else (1, 0):  # first the side to which it is pushed
        sign = (1.0 - 2.0 * k) * sine
        if sign * now > ABOVE * thresholds[k] * (weight + lift * start):
            return start, k
        rise = sign * slope - thresholds[k] * lift
        short = thresholds[k] * weight - sign * level
        if omega == 0.0 and sign * (level + slope * end) > ABOVE * thresholds[k] * (weight + lift * end):
            return max(start, min(end, short / rise)), k
    if omega == 0.0 or max(now, level + slope * end) <= min(thresholds):
        return np.inf, 0
    # Half a wave at a time: sin φ > 0 uplifts to θ < 0, sin φ < 0 to θ > 0.
    low = start
    while low < end:
        half = np.floor((omega * low + phase) / pi + 1e-12)
        side = int(half % 2.0)
        high, crossing = min(end, ((half + 1.0) * pi - phase) / omega), np.inf
        if slope != 0.0:
            crossing = _first_above(low, high, part, thresholds[side])
        elif level > thresholds[side]:
            crossing = (half * pi + asin(thresholds[side] / level) - phase) / omega
        if low <= crossing < end:
            return crossing, side
        low = high
    return np.inf, 0


@kernel_in_place
def _first_above(low: float, high: float, part: Part, threshold: float) -> float:
    """Find where on a ramp l |sin φ| first passes a threshold within half a wave; inf where it does not."""
    _, level, slope, _, _, omega, phase = part
    # The logarithm of l |sin φ| is concave, so that it has one top: where its slope changes its sign.
    top, right = low, high
    for _ in range(HALVINGS):
        middle = 0.5 * (top + right)
        growing = slope + (level + slope * middle) * omega / tan(omega * middle + phase) > 0.0
        top, right = (middle, right) if growing else (top, middle)
    if not (level + slope * top) * abs(sin(omega * top + phase)) > threshold:
        return np.inf
    # It rises from the beginning of the half wave to its top.
    bottom = low
    for _ in range(HALVINGS):
        middle = 0.5 * (bottom + top)
        above = (level + slope * middle) * abs(sin(omega * middle + phase)) > threshold
        bottom, top = (bottom, middle) if above else (middle, top)
    return top


LONGEST_SAMPLE = 0.5
"""In x = p t: the bounds of longer samples exclude too few impacts for whole samples to be tried."""


class WholeSample(NamedTuple):
    """
    What it takes to pass over whole samples on one side.

    Attributes
    ----------
    side, p, step, critical : float
        ±1, p (rad/s), p dt and α.
    growing, decaying : tuple of float
        Of (θ + ω/p)/2 and (θ − ω/p)/2, on this side: the factor over a sample, and what α and a/g at its start and end
        take off.
    bounds : tuple of float
        What excludes an impact inside a sample, see `pass_over`.
    """

    side: float
    p: float
    step: float
    critical: float
    growing: tuple[float, float, float, float]
    decaying: tuple[float, float, float, float]
    bounds: tuple[float, float]


@kernel_in_place
def whole_sample(side: float, critical: float, p: float, dt: float, largest: float) -> WholeSample:
    """Prepare one side for samples of the length `dt` under a motion of at most `largest` a/g."""
    step = p * dt
    more, even = excess_rise(step * step)
    rise, mean_rate = step * step * even, step * even
    s, half, turn, limit, most = step + step * more, 0.5 * critical, 0.5 * side, 0.25 * step**2, critical + largest
    growing = 1.0 + rise + s, half * (rise + s), turn * (rise - more + s - mean_rate), turn * (more + mean_rate)
    decaying = 1.0 + rise - s, half * (rise - s), turn * (rise - more - s + mean_rate), turn * (more - mean_rate)
    return WholeSample(side, p, step, critical, growing, decaying, (limit * (most + critical), 0.5 * step * most))


@kernel_fused
def pass_over(angles: Array, velocities: Array, base: Array, sample: int, whole: WholeSample) -> int:
    """
    Propagate sample by sample for as long as no impact can hide inside one and |θ| ≤ α; return where that ends.

    A chord is above a curve by at most x²/8 times its largest second derivative: where both ends are higher than
    that, there is no impact between them; nor where it leaves the one end, or comes to the other, faster than
    (α + largest) x/2.
    """
    side, p, _step, critical, up, down, (low, quick) = whole
    (growth, held_up, now_up, then_up), (decay, held_down, now_down, then_down) = up, down
    height, climb = side * angles[sample], side * velocities[sample] / p
    growing, decaying, back = 0.5 * (height + climb), 0.5 * (height - climb), side * p
    # From 0 on: an index that could be negative costs a comparison each time.
    heights, climbs, pushes = angles[sample:], velocities[sample:], base[sample:]
    for k in range(pushes.size - 1):
        now, then = pushes[k], pushes[k + 1]
        # Each waits for the last sample with one product and sum only.
        growing = growth * growing - (held_up + now_up * now + then_up * then)
        decaying = decay * decaying - (held_down + now_down * now + then_down * then)
        end, end_climb = growing + decaying, growing - decaying
        if end > critical or not (min(height, end) > low or (end >= 0.0 and (climb > quick or end_climb < -quick))):
            return sample + k
        height, climb = end, end_climb
        heights[k + 1], climbs[k + 1] = side * height, back * climb
    return int(base.size - 1)


@kernel_in_place
def stay(base: Array, sample: int, thresholds: Pair) -> int:
    """Last sample up to which a block at rest at `sample` stays so."""
    for following in range(sample, base.size):
        if not -thresholds[1] <= base[following] <= thresholds[0]:
            return max(sample, following - 1)
    return int(base.size - 1)
