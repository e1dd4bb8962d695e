"""The two sides of a block as kernels see them: what uplifts it, what an impact leaves, whether it comes to rest."""

from __future__ import annotations

from math import cos, sin, sqrt, tan
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.restitution_law import RestitutionLaw, restitution_table

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


def sides_of(block: Block, restitution: Pair | RestitutionLaw, rest_angle: float) -> Sides:
    """Put a block, its restitution and its rule of rest into the form that the kernels take."""
    speeds, values = restitution_table(restitution)
    left, right = block.sides
    critical, p = (left.critical_angle, right.critical_angle), (block.side_p(left), block.side_p(right))
    return Sides(critical, p, values, speeds, rest_angle)


@kernel
def of_side(pair: Pair, here: int) -> float:
    """Choose by side; compiled, an index that is not constant branches and may raise."""
    return pair[1] if here else pair[0]


@kernel
def uplift_threshold(critical: float, linearised: bool) -> float:
    """Return |a/g| above which a block at rest uplifts."""
    return critical if linearised else tan(critical)


@kernel
def restitution_of(restitution: Array, speeds: Array, here: int, velocity: float) -> float:
    """
    Give e of an impact that ends an arc on side `here` (0 for θ < 0, 1 for θ > 0).

    `restitution`, shape (2 m,), is e at `speeds`, shape (m,), rad/s, on the one side and then on the other; linear
    between them, constant beyond.
    """
    if speeds.size == 1:
        return float(restitution[here])
    speed, first = abs(velocity), here * speeds.size
    above = int(np.searchsorted(speeds, speed))
    if above == 0 or above == speeds.size:
        return float(restitution[first + min(above, speeds.size - 1)])
    share = (speed - speeds[above - 1]) / (speeds[above] - speeds[above - 1])
    lower, upper = restitution[first + above - 1], restitution[first + above]
    return float(lower + share * (upper - lower))


@kernel
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


@kernel
def _hill(lean: float) -> float:
    """Potential over m g R at lean = α − |θ|; 0 where the centre of mass is above the pole."""
    return -2.0 * sin(0.5 * lean) ** 2


@kernel
def survives_free_rocking(height: float, rate: float, here: int, sides: Sides, linearised: bool) -> bool:
    """
    Tell whether a block that rocks on side `here`, left on a base at rest, comes back to stand.

    `height` is |θ|, `rate` its velocity over p. What is left after one impact decides both sides: every later impact
    only takes energy.
    """
    critical, p, restitution, speeds, _rest_angle = sides
    alpha, other_alpha = of_side(critical, here), of_side(critical, 1 - here)
    p_here, p_there = of_side(p, here), of_side(p, 1 - here)
    if linearised:
        # h − α = C eˣ + D e⁻ˣ: outwards for good if C > 0; else the energy gives the velocity of the impact.
        beyond = height - alpha
        if beyond + rate > 0.0:
            return False
        arriving = p_here * sqrt(max(rate * rate - beyond * beyond + alpha**2, 0.0))
        after = restitution_of(restitution, speeds, here, arriving) * arriving
        return bool(after <= p_there * other_alpha)
    # The energy shows whether the block passes α, outwards, or from beyond it back inwards.
    energy = 0.5 * rate * rate + _hill(alpha - height)
    passed = height > alpha
    if (passed and (rate >= 0.0 or energy <= 0.0)) or (not passed and rate > 0.0 and energy > 0.0):
        return False
    arriving = p_here * sqrt(max(2.0 * (energy - _hill(alpha)), 0.0))
    after = restitution_of(restitution, speeds, here, arriving) * arriving / p_there
    return bool(0.5 * after * after + _hill(other_alpha) <= 0.0)
