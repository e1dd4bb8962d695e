"""
The full equation by Taylor series, and the linearised one where the weight changes.

While the block rocks on side s = sgn θ, u = α − s θ obeys, with x = p t, the base acceleration over gravity
a/g = (l + l' x) sin φ, φ = Ω x + ψ, q = s l, q' = s l', and the weight W = 1 + v/g linear in x,

    u'' = W sin u + (q + q' x) sin φ cos u,

linearised u'' = W u + (q + q' x) sin φ. Sine and cosine of the series of u follow by recurrence, and the series of
q sin φ is known, so that nothing of the motion is sampled. A series has as many terms as rounding asks for over all
that is wanted; where `ORDER` of them do not reach, it ends earlier. Beyond α, outwards and past α + atan max |q|, the
block only gathers speed: it has overturned.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel, kernel_fused
from colonnade.dynamics.plane.closed import Jet, Push

ORDER = 18
"""Most terms of a series; the step is chosen so that the last ones are below rounding."""

RECIPROCAL = 1.0 / np.maximum(np.arange(ORDER + 1), 1)

ROUNDING = 1e-15
"""What the last term of a series may come to at the end of its step, as a fraction of α."""

NEGLIGIBLE = 1e-18
"""In rad: a series ends where two terms in a row are smaller than this over all that is wanted."""


class Series(NamedTuple):
    """Taylor coefficients in x, shape (`ORDER` + 1,): of h, sin u, cos u and q sin φ; whether they are linearised."""

    height: Array
    sine: Array
    cosine: Array
    forcing: Array
    is_linearised: bool


def empty_series(is_linearised: bool = False) -> Series:
    """Return room for the series of one arc after the other."""
    height, sine, cosine, forcing = np.empty((4, ORDER + 1))
    return Series(height, sine, cosine, forcing, is_linearised)


@kernel
def series_arc(
    start: float, rate: float, critical: float, push: Push, wanted: float, work: Series
) -> tuple[int, Jet, float]:
    """Expand h about x = 0; return the number of its terms, its state there, and how far they reach."""
    height, terms, end = work.height, _expand(start, rate, critical, push, wanted, work), wanted
    if terms > ORDER:
        last = max(abs(height[ORDER]), abs(height[ORDER - 1]))
        end = min(wanted, (ROUNDING * critical / last) ** (1.0 / ORDER) if last > 0.0 else 1.0)
    return terms, (start, rate, 2.0 * height[2], 6.0 * height[3], 0.0, 0.0, 0.0, 0.0), end


@kernel
def _expand(start: float, rate: float, critical: float, push: Push, wanted: float, work: Series) -> int:
    """Fill in the coefficients, as many as `wanted` needs, and return how many."""
    height, sine, cosine, forcing, linearised = work
    q, change, weight, lift, ratio, even, odd = push
    angle, now = critical - start, q * even
    # even and odd: k-th Taylor coefficients of sin φ and of its quarter turn; growth: the one before of sin φ.
    for k in range(1, ORDER - 1):
        share, growth = ratio * RECIPROCAL[k], even
        even, odd = odd * share, -even * share
        forcing[k] = q * even + change * growth
    height[0], height[1] = start, rate
    sine[0], cosine[0] = (angle, 1.0) if linearised else (sin(angle), cos(angle))
    power, small = wanted, 0
    for k in range(ORDER - 1):
        product = 0.0
        if k > 0 and linearised:
            sine[k], cosine[k] = -height[k], 0.0
            product = forcing[k]
        elif k > 0:
            falling, rising = 0.0, 0.0
            for j in range(1, k + 1):
                falling += j * height[j] * cosine[k - j]
                rising += j * height[j] * sine[k - j]
                product += forcing[j] * cosine[k - j]
            sine[k], cosine[k] = -falling * RECIPROCAL[k], rising * RECIPROCAL[k]
        product += weight * sine[k] + now * cosine[k]
        if k > 0:
            product += lift * sine[k - 1]
        height[k + 2] = -product * RECIPROCAL[k + 1] * RECIPROCAL[k + 2]
        power *= wanted
        small = small + 1 if abs(height[k + 2]) * power < NEGLIGIBLE else 0
        if small == 2:
            return k + 3
    return ORDER + 1


@kernel_fused
def series_bounds(end: float, terms: int, height: Array) -> tuple[float, float]:
    """Bounds of |h''''| and |h'''''| on [0, end]: the sums of the magnitudes of their terms."""
    fourth, fifth = 0.0, 0.0
    for k in range(terms - 1, 4, -1):
        size = k * (k - 1) * (k - 2) * (k - 3) * abs(height[k])
        fourth = fourth * end + size
        fifth = fifth * end + size * (k - 4)
    return fourth * end + 24.0 * abs(height[4]), fifth


@kernel_fused
def series_jet(x: float, terms: int, height: Array) -> Jet:
    """State after x (Horner)."""
    value, first, second, third = 0.0, 0.0, 0.0, 0.0
    for k in range(terms - 1, -1, -1):
        third = third * x + second
        second = second * x + first
        first = first * x + value
        value = value * x + height[k]
    return value, first, 2.0 * second, 6.0 * third, 0.0, 0.0, 0.0, 0.0
