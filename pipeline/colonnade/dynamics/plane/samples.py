"""The linear equation over whole samples of a record in which nothing happens: most of them, passed over at once."""

from __future__ import annotations

from math import sinh
from typing import NamedTuple

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.sides import Pair

LONGEST_SAMPLE = 0.5
"""In x = p t: the bounds of longer samples exclude too few impacts for whole samples to be tried."""


class WholeSample(NamedTuple):
    """
    What it takes to pass over whole samples on one side.

    Attributes
    ----------
    side, p, step, critical : float
        ±1, p (rad/s), p dt and α.
    factors : tuple of float
        Coefficients of θ and ω/p over a sample, and of what α and a/g at its start and end take off each.
    bounds : tuple of float
        What excludes an impact inside a sample, see `_march`.
    """

    side: float
    p: float
    step: float
    critical: float
    factors: tuple[float, float, float, float, float, float, float, float]
    bounds: tuple[float, float, float]


@kernel
def whole_sample(side: float, critical: float, p: float, dt: float, largest: float) -> WholeSample:
    """Prepare one side for samples of the length `dt` under a motion of at most `largest` a/g."""
    step = p * dt
    # cosh x − 1, and sinh x − x without the cancellation at small x.
    rise, q = 2.0 * sinh(0.5 * step) ** 2, step * step
    excess = sinh(step) - step
    if step < 0.3:
        excess = step * q * (1 / 6 + q * (1 / 120 + q * (1 / 5040 + q * (1 / 362880 + q / 39916800))))
    c, s, mean, mean_rate = 1.0 + rise, step + excess, excess / step, rise / step
    factors = c, s, rise * critical, s * critical, rise - mean, s - mean_rate, mean, mean_rate
    limit, most = 0.25 * step**2, critical + largest
    return WholeSample(side, p, step, critical, factors, (limit, limit * most, 0.5 * step * most))


@kernel
def undisturbed(
    angles: Array,
    velocities: Array,
    base: Array,
    sample: int,
    is_resting: bool,
    thresholds: Pair,
    whole: WholeSample,
) -> int:
    """Pass over the samples in which nothing happens, filling in their state; return the last that is reached."""
    if is_resting:
        return _still(base, sample, thresholds)
    if whole.step >= LONGEST_SAMPLE:
        return sample
    return _march(angles, velocities, base, sample, whole)


@kernel
def _march(angles: Array, velocities: Array, base: Array, sample: int, whole: WholeSample) -> int:
    """
    Propagate sample by sample for as long as no impact can hide inside one and |θ| ≤ α; return where that ends.

    A chord is above a curve by at most x²/8 times its largest second derivative: where both ends are higher than
    that, there is no impact between them; nor where it leaves the one end, or comes to the other, faster than
    (α + largest) x/2.
    """
    side, p, _step, critical, factors, bounds = whole
    c, s, held, held_rate, now, now_rate, then, then_rate = factors
    limit, floor, quick = bounds
    height, climb = side * angles[sample], side * velocities[sample] / p
    back = side * p
    while sample < base.size - 1:
        push, following = side * base[sample], side * base[sample + 1]
        end = c * height + s * climb - (held + now * push + then * following)
        end_climb = s * height + c * climb - (held_rate + now_rate * push + then_rate * following)
        clear = climb > quick or min(height, end) > floor + limit * max(height, end) or end_climb < -quick
        if end > critical or end < 0.0 or not clear:
            return sample
        height, climb = end, end_climb
        sample += 1
        angles[sample], velocities[sample] = side * height, back * climb
    return sample


@kernel
def _still(base: Array, sample: int, thresholds: Pair) -> int:
    """Last sample up to which a block at rest at `sample` stays so."""
    negative, positive = thresholds
    for following in range(sample, base.size):
        if not -positive <= base[following] <= negative:
            return max(sample, following - 1)
    return int(base.size - 1)
