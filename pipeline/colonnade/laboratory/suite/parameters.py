"""
The six parameters of a broad-band ground motion, drawn for an earthquake of a magnitude at a distance.

Rezaeian and Der Kiureghian (2010) relate them, transformed to normal variables, to magnitude, distance, shear-wave
velocity of the ground and kind of fault; the coefficients are those of Rezaeian, Zhong and Zareian (2015).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, pi

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY

ARIAS = (-2.2962, 2.9440, -0.0707, -1.3564, -0.2654)
"""Constant, and factors on M/7, reverse faulting, ln(R/25 km) and ln(V/750 m/s)."""

OTHERS = np.array(
    [
        [-6.1946, 0.9703, -0.7034, 0.0087, -0.0007],
        [-5.0105, 0.6625, -0.3450, 0.0139, -0.0002],
        [2.2525, -0.2586, -0.0808, -0.0084, 0.0000],
        [-2.4886, 0.3440, 0.0441, 0.0026, -0.0001],
        [-0.2583, 0.1293, -0.4772, -0.0115, 0.0004],
    ]
)
"""Constant, and factors on M, reverse faulting, R (km) and V (m/s): of D5–95, tmid, fmid, f' and ζ."""

WITHIN = np.array([0.5937, 0.5688, 0.4145, 0.7228, 0.9529, 0.7601])
BETWEEN = np.array([0.2738, 0.4574, 0.5114, 0.6918, 0.1286, 0.6815])
"""Standard deviations of the normal variables within an earthquake, and between earthquakes."""

CORRELATION = np.array(
    [
        [1.0000, -0.3555, 0.0066, -0.1545, 0.1341, -0.0078],
        [-0.3555, 1.0000, 0.6729, -0.1303, -0.1576, -0.1958],
        [0.0066, 0.6729, 1.0000, -0.2761, -0.1977, -0.2188],
        [-0.1545, -0.1303, -0.2761, 1.0000, -0.2034, 0.2814],
        [0.1341, -0.1576, -0.1977, -0.2034, 1.0000, -0.0137],
        [-0.0078, -0.1958, -0.2188, 0.2814, -0.0137, 1.0000],
    ]
)
"""Of their sums."""

STEEPEST, FLATTEST = -2.0, 0.5
"""Bounds of f', Hz/s."""

LATEST = 0.95
"""Largest tmid over D5–95: a later middle has no envelope."""


@dataclass(frozen=True)
class Shaking:
    """
    A broad-band ground motion.

    Attributes
    ----------
    arias : float
        Arias intensity, m/s.
    duration : float
        D5–95, s.
    middle : float
        Time at which 45 % of the Arias intensity is reached, s.
    frequency : float
        Of the filter at that time, Hz.
    slope : float
        Its change, Hz/s.
    damping : float
        Of the filter, as a fraction of the critical one.
    """

    arias: float
    duration: float
    middle: float
    frequency: float
    slope: float
    damping: float


def drawn_shaking(
    magnitude: float, distance: float, random: np.random.Generator, *, velocity: float = 760.0, reverse: bool = False
) -> Shaking:
    """
    Draw the parameters of a ground motion.

    Parameters
    ----------
    magnitude : float
        Moment magnitude, about 6 to 8.
    distance : float
        From the fault, m, about 10 to 100 km.
    random : Generator
    velocity : float, optional
        Of shear waves in the upper 30 m of the ground, m/s, above 600.
    reverse : bool, optional
        Whether the fault is a reverse one, else strike-slip.
    """
    kilometres, is_reverse = distance / 1000, float(reverse)
    terms = np.array([1.0, magnitude / 7, is_reverse, log(kilometres / 25), log(velocity / 750)])
    means = np.array([terms @ ARIAS, *(OTHERS @ [1.0, magnitude, is_reverse, kilometres, velocity])])
    deviations = np.sqrt(WITHIN**2 + BETWEEN**2)
    covariance = CORRELATION * np.outer(deviations, deviations)
    return shaking_of(means + np.linalg.cholesky(covariance) @ random.standard_normal(len(means)))


def shaking_of(normal: Array) -> Shaking:
    """Transform normal variables, shape (6,), to the parameters with the distributions that were fitted to records."""
    share = scipy.stats.norm.cdf(normal)
    duration = 5.0 + 40.0 * float(scipy.stats.beta.ppf(share[1], 1.1314, 2.4474))
    middle = 0.5 + 39.5 * float(scipy.stats.beta.ppf(share[2], 1.5792, 3.6405))
    return Shaking(
        # The fitted variable is ∫ a² dt in g² s.
        pi / 2 * STANDARD_GRAVITY * exp(-4.8255 + 1.4318 * float(normal[0])),
        duration,
        min(middle, LATEST * duration),
        float(scipy.stats.gamma.ppf(share[3], 4.0982, scale=1.4330)),
        _slope(float(share[4])),
        0.02 + 0.98 * float(scipy.stats.beta.ppf(share[5], 1.4250, 5.7208)),
    )


def _slope(share: float) -> float:
    """Quantile of the two-sided exponential distribution of f', Hz/s."""
    falling, rising, height = 6.7729, 17.095, 4.8512
    below = height / falling * (1 - exp(falling * STEEPEST))
    if share < below:
        return max(log(share * falling / height + exp(falling * STEEPEST)) / falling, STEEPEST)
    left = 1 - (share - below) * rising / height
    return min(-log(left) / rising, FLATTEST) if left > 0 else FLATTEST
