"""After an impact: the restitution, whether the block rests, and whether it would come to rest by itself."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.sides import Sides, of_side


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
def holding_moment(critical: float, weight: float, pull: float, linearised: bool) -> float:
    """
    Moment about the pole, over m g R, that holds a block down at θ = 0.

    `weight` is 1 + v/g with the vertical base acceleration v, `pull` is s a/g on side s.
    """
    return weight * critical + pull if linearised else weight * sin(critical) + pull * cos(critical)


@kernel
def comes_to_rest(risen: float, critical: float, holding: float, rest_angle: float) -> bool:
    """Tell whether the next arc, which starts with the energy `risen` over m g R, stays below `rest_angle` α."""
    return holding >= 0.0 and risen <= rest_angle * critical * holding


@kernel
def rebound(
    velocity: float, here: int, weight: float, pull: float, sides: Sides, linearised: bool
) -> tuple[float, bool]:
    """
    Give the angular velocity (rad/s) after an impact that ends an arc on side `here`, and whether the block then rests.

    `weight` is 1 + v/g and `pull` a/g of the base at that instant.
    """
    there, (_, _, restitution, speeds, rest_angle) = 1 - here, sides
    critical, p = of_side(sides.critical, there), of_side(sides.p, there)
    leaving = restitution_of(restitution, speeds, here, velocity) * velocity
    holding = holding_moment(critical, weight, (2.0 * there - 1.0) * pull, linearised)
    risen = leaving * leaving / (2.0 * p * p)
    if comes_to_rest(risen, critical, holding, rest_angle):
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
