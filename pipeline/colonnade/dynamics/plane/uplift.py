"""When a block at rest uplifts, and to which side."""

from __future__ import annotations

from math import asin, pi, sin, tan

import numpy as np

from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.sides import Pair

Piece = tuple[float, float]
"""Level of a harmonic motion where a part of it begins, and its slope."""

HALVINGS = 60
"""Of an interval: down to rounding."""


@kernel
def level_at(piece: Piece, since: float) -> float:
    """Level at a time since the part began."""
    return piece[0] + piece[1] * since


@kernel
def uplift_threshold(critical: float, linearised: bool) -> float:
    """Return |a/g| above which a block at rest uplifts."""
    return critical if linearised else tan(critical)


@kernel
def level_uplift(start: float, end: float, base: float, rate: float, thresholds: Pair) -> tuple[float, int]:
    """
    Find when in [start, end] a block at rest on a base that moves along x only uplifts, and on which side.

    a/g is base + rate t; it uplifts to θ < 0 (side 0) where that is above the first threshold, to θ > 0 (side 1) where
    −a/g is above the second, both strictly; (inf, 0) where it stays.
    """
    for k in range(2):
        sign = 1.0 - 2.0 * k
        if sign * (base + rate * start) > thresholds[k]:
            return start, k
    for k in range(2):
        sign = 1.0 - 2.0 * k
        if sign * (base + rate * end) > thresholds[k]:
            return max(start, min(end, (sign * thresholds[k] - base) / rate)), k
    return np.inf, 0


@kernel
def sampled_uplift(start: float, end: float, first: Pair, last: Pair) -> tuple[float, int]:
    """
    Find when in [start, end] a block at rest uplifts, and on which side; (inf, 0) where it stays.

    `first` and `last` are the moments about the poles, over m g R cos α, that uplift it to θ < 0 and to θ > 0, at the
    ends of [0, end]; they change linearly.
    """
    instant, chosen = np.inf, 0
    for k in range(2):
        now = first[k] + (last[k] - first[k]) * (start / end)
        if now > 0.0:
            return start, k
        if last[k] > 0.0:
            crossing = max(start, min(end, end * -first[k] / (last[k] - first[k])))
            if crossing < instant:
                instant, chosen = crossing, k
    return instant, chosen


@kernel
def harmonic_uplift(
    start: float, end: float, begin: float, omega: float, phase: float, piece: Piece, negative: float, positive: float
) -> tuple[float, float]:
    """
    Find when in [start, end] a block at rest uplifts, and to which side; (inf, 0) where it stays.

    The base acceleration over gravity is l(t − begin) sin(ω t + phase), l ≥ 0; the block uplifts to θ < 0 where that
    passes `negative`, to θ > 0 where its opposite passes `positive`.
    """
    angle, level = omega * start + phase, level_at(piece, start - begin)
    now = level * sin(angle)
    if now > negative or -now > positive:
        return start, -1.0 if now > 0.0 else 1.0
    if omega == 0.0 or max(level, level_at(piece, end - begin)) <= min(negative, positive):
        return np.inf, 0.0
    if piece[1] == 0.0:
        # A constant level: the sine's own inverse.
        first, second = np.inf, np.inf
        if level > negative:
            first = start + ((asin(negative / level) - angle) % (2.0 * pi)) / omega
        if level > positive:
            second = start + ((pi + asin(positive / level) - angle) % (2.0 * pi)) / omega
        return (min(first, second), -1.0 if first < second else 1.0) if min(first, second) < end else (np.inf, 0.0)
    # On a ramp, half a wave at a time: sin φ > 0 uplifts to θ < 0, sin φ < 0 to θ > 0.
    low = start
    while low < end:
        half = np.floor((omega * low + phase) / pi + 1e-12)
        high = min(end, ((half + 1.0) * pi - phase) / omega)
        side, threshold = (-1.0, negative) if half % 2.0 == 0.0 else (1.0, positive)
        crossing = _first_above(low, high, begin, omega, phase, piece, threshold)
        if crossing < np.inf:
            return crossing, side
        low = high
    return np.inf, 0.0


@kernel
def _first_above(
    low: float, high: float, begin: float, omega: float, phase: float, piece: Piece, threshold: float
) -> float:
    """Find where l |sin φ| first passes a threshold within half a wave; inf where it does not."""
    # The logarithm of l |sin φ| is concave, so that it has one top: where its slope changes its sign.
    top, right = low, high
    for _ in range(HALVINGS):
        middle = 0.5 * (top + right)
        growing = piece[1] + level_at(piece, middle - begin) * omega / tan(omega * middle + phase) > 0.0
        top, right = (middle, right) if growing else (top, middle)
    if not level_at(piece, top - begin) * abs(sin(omega * top + phase)) > threshold:
        return np.inf
    # It rises from the beginning of the half wave to its top.
    bottom = low
    for _ in range(HALVINGS):
        middle = 0.5 * (bottom + top)
        above = level_at(piece, middle - begin) * abs(sin(omega * middle + phase)) > threshold
        bottom, top = (bottom, middle) if above else (middle, top)
    return top
