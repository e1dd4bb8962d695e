"""The largest pulse of a velocity by Daubechies' wavelet of order 4, after Baker (2007)."""

from __future__ import annotations

from functools import cache
from math import ceil, exp, sqrt
from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array

SCALING = (
    0.23037781330885523,
    0.7148465705525415,
    0.6308807679295904,
    -0.02798376941698385,
    -0.18703481171888114,
    0.030841381835986965,
    0.032883011666982945,
    -0.010597401784997278,
)
"""Scaling filter of four vanishing moments, of sum √2 (Daubechies 1988, table 1)."""

SUPPORT = len(SCALING) - 1
"""Length of the wavelet at scale 1 s, s."""

CENTRE_FREQUENCY = 5 / 7
"""Hz, of the wavelet at scale 1 s: five waves on its support, by the largest term of its Fourier series there."""

SHORTEST, LONGEST = 0.25, 15.0
"""Periods of pulses that are looked for, s (Baker 2007)."""

SCALES = 60
"""Periods of the first search, in equal ratios; a second one of as many lies between the neighbours of its best."""

WAVELETS = 10
"""Wavelets of one period that make up a pulse (Baker 2007)."""

SHIFT = 0.4
"""How far from the first the others may lie, in scales."""


class Pulse(NamedTuple):
    """
    The largest pulse of a velocity.

    Attributes
    ----------
    period : float
        s; NaN of a motion at rest.
    indicator : float
        Between 0 and 1; NaN of a motion at rest.
    velocity : ndarray, shape (n,)
        m/s, of the pulse at the samples of the motion.
    """

    period: float
    indicator: float
    velocity: Array


def largest_pulse(velocity: Array, interval: float) -> Pulse:
    """
    Extract the largest pulse of a velocity.

    Parameters
    ----------
    velocity : ndarray, shape (n,)
        m/s.
    interval : float
        s.

    Returns
    -------
    pulse : Pulse
        Of a period between `SHORTEST`, or eight samples, and `LONGEST`, or the length of the record.

    Notes
    -----
    Baker (2007): the largest coefficient of the continuous wavelet transform of the velocity gives period and place
    of the pulse. Ten wavelets of this period near it, one after the other from what is left, make up the pulse. With r
    the PGV and E the energy of the residual over those of the motion, the indicator is
    1 / (1 + exp(−23.3 + 14.6 r + 20.5 E)); above 0.85 the motion is called pulse-like, below 0.15 not. Baker asks in
    addition for a PGV of 0.3 m/s and an early pulse, which the indicator does not.
    """
    peak = float(np.abs(velocity).max(initial=0.0))
    shortest, longest = max(SHORTEST, 8 * interval), min(LONGEST, velocity.size * interval)
    if peak == 0.0 or shortest >= longest:
        return Pulse(float("nan"), float("nan"), np.zeros_like(velocity))
    scales = np.geomspace(shortest, longest, SCALES) * CENTRE_FREQUENCY
    best = _best(velocity, interval, scales)
    step = scales[1] / scales[0]
    finer = np.clip(scales[best] * step ** np.linspace(-1, 1, SCALES), scales[0], scales[-1])
    scale = float(finer[_best(velocity, interval, finer)])
    found = _sum_of_wavelets(velocity, interval, scale)
    residual = velocity - found
    share = float(np.abs(residual).max()) / peak
    energy = float(np.sum(residual**2) / np.sum(velocity**2))
    exponent = min(-23.3 + 14.6 * share + 20.5 * energy, 700.0)
    return Pulse(scale / CENTRE_FREQUENCY, 1 / (1 + exp(exponent)), found)


def _best(velocity: Array, interval: float, scales: Array) -> int:
    """Index of the scale with the largest coefficient."""
    return int(np.argmax([np.abs(_transform(velocity, interval, scale)[0]).max() for scale in scales.tolist()]))


def _sum_of_wavelets(velocity: Array, interval: float, scale: float) -> Array:
    """Sum the wavelets of one scale that are taken from a velocity one by one, near the largest."""
    residual, first = velocity.copy(), -1
    reach = ceil(SHIFT * scale / interval)
    for _ in range(WAVELETS):
        coefficients, atom = _transform(residual, interval, scale)
        near = slice(max(0, first - reach), first + reach + 1) if first >= 0 else slice(None)
        place = int(np.argmax(np.abs(coefficients[near]))) + (near.start or 0)
        first = place if first < 0 else first
        begin = place - (atom.size - 1)
        inside = slice(max(0, begin), min(velocity.size, place + 1))
        residual[inside] -= coefficients[place] * atom[inside.start - begin : inside.stop - begin]
    return np.asarray(velocity - residual)


def _transform(velocity: Array, interval: float, scale: float) -> tuple[Array, Array]:
    """
    Give the coefficients of a velocity at one scale, shape (n + m − 1,), and the wavelet, shape (m,).

    The wavelet is sampled as the motion and of unit norm; the coefficient k belongs to the one whose last sample lies
    at sample k.
    """
    time, values = _daubechies()
    atom = np.interp(np.arange(ceil(SUPPORT * scale / interval) + 1) * (interval / scale), time, values, right=0.0)
    atom /= sqrt(float(atom @ atom))
    return np.asarray(scipy.signal.fftconvolve(velocity, atom[::-1])), atom


@cache
def _daubechies(levels: int = 9) -> tuple[Array, Array]:
    """Give the wavelet at scale 1 s at dyadic times, by the equation of its scaling function, level by level."""
    low = np.array(SCALING) * sqrt(2)
    size = low.size
    # At whole times the scaling function is an eigenvector of its equation.
    grid = np.arange(size)
    index = 2 * grid[:, None] - grid[None, :]
    matrix = np.where((index >= 0) & (index < size), low[np.clip(index, 0, size - 1)], 0.0)
    eigenvalues, vectors = np.linalg.eig(matrix)
    phi = np.real(vectors[:, np.argmin(np.abs(eigenvalues - 1.0))])
    phi = phi / phi.sum()
    for level in range(levels):
        phi = scipy.signal.upfirdn(phi, low, 2**level)[: (size - 1) * 2 ** (level + 1) + 1]
    # φ is now known at times k/2^levels; the wavelet is ψ(t) = Σ h_k φ(2t − k).
    high = low[::-1] * (-1.0) ** np.arange(size)
    psi = scipy.signal.upfirdn(phi, high, 2**levels)
    return np.arange(psi.size) / 2 ** (levels + 1), psi
