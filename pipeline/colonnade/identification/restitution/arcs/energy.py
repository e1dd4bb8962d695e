"""The energy that a peak holds: each impact multiplies it by e²."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array


def lift(angle: ArrayLike, critical_angle: ArrayLike) -> Array:
    """
    Rise of the centre of mass at a peak over the pole distance: cos(α − |θ|) − cos α, angles in rad.

    It is (ω/p)²/2 at the impacts on either side of the peak.
    """
    theta, critical = np.abs(np.asarray(angle, dtype=np.float64)), np.asarray(critical_angle, dtype=np.float64)
    # Without the cancellation at small angles.
    return np.asarray(2 * np.sin(critical - theta / 2) * np.sin(theta / 2))


def energy_slope(angle: ArrayLike, critical_angle: ArrayLike) -> Array:
    """Return the derivative of ln of the energy by |θ|, 1/rad; infinite or NaN where θ is 0 or NaN."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.sin(critical_angle - np.abs(angle)) / lift(angle, critical_angle))


def released_energy(angle: ArrayLike, critical_angle: ArrayLike) -> Array:
    """
    Fraction of the overturning energy barrier that a peak holds.

    Parameters
    ----------
    angle, critical_angle : array_like, shape (n,)
        |θ| and α, rad.

    Returns
    -------
    energy : ndarray, shape (n,)
        [cos(α − |θ|) − cos α] / (1 − cos α), dimensionless.

    Notes
    -----
    Each impact multiplies it by e². For small α it is Housner's 1 − (1 − |θ|/α)² (Housner 1963, eq. 11).

    Examples
    --------
    >>> released_energy(0.2, 0.2).tolist()
    1.0
    """
    return np.asarray(lift(angle, critical_angle) / (2 * np.sin(np.asarray(critical_angle) / 2) ** 2))


def angle_of_energy(energy: ArrayLike, critical_angle: ArrayLike) -> Array:
    """Return |θ| of a peak (rad) that holds a fraction of the barrier: the inverse of `released_energy`."""
    critical = np.asarray(critical_angle, dtype=np.float64)
    cosine = np.asarray(energy, dtype=np.float64) * (1 - np.cos(critical)) + np.cos(critical)
    return np.asarray(critical - np.arccos(np.clip(cosine, -1.0, 1.0)))
