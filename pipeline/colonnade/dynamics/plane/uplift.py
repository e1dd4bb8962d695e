"""When a block at rest uplifts, and to which side."""

from __future__ import annotations

from math import asin, pi, sin, tan
from typing import NamedTuple

import numpy as np

from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.sides import Pair

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


@kernel
def uplift(start: float, part: Part, thresholds: Pair) -> tuple[float, int]:
    """
    Find when from `start` on a block at rest uplifts in a part, and on which side; (inf, 0) where it stays.

    It uplifts to θ < 0 (side 0) where a/g is above the first threshold times the weight, to θ > 0 (side 1) where −a/g
    is above the second, both strictly.
    """
    end, level, slope, weight, lift, omega, phase = part
    now, sine = level + slope * start, sin(omega * start + phase)
    for k in range(2):
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


@kernel
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
