"""Peaks of a rocking history and the relation between their energies: each impact multiplies the energy by e²."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.restitution.result import EXACT, Peaks
from colonnade.identification.restitution.scatter import LinearModel, Solved

FEWEST_PEAKS = 5

LEAST_ERROR = 1e-3
"""Of the noise of the angle, below which the error of a peak is not believed."""

MOST_ROUNDS = 6

METHOD = "peaks: ln of their energy against the impact number, with a common zero and a scatter of e"


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


def half_duration(peak: ArrayLike, critical_angle: ArrayLike) -> Array:
    """Phase p t from peaks of free rocking (|θ|, rad) to the impact; α in rad (an elliptic integral)."""
    peak, critical = np.asarray(peak, dtype=np.float64), np.asarray(critical_angle, dtype=np.float64)
    top, turning = np.sin(critical / 2) ** 2, np.sin((critical - peak) / 2) ** 2
    # sin² of half of α less that at the peak, without the cancellation at small angles: half of the lift.
    phase = np.arctan2(np.sqrt(lift(peak, critical) / 2), np.sqrt(turning * (1 - top)))
    return np.asarray(scipy.special.ellipkinc(phase, 1 - turning))


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


def fit_peaks(seen: Peaks, block: Block, noise: float, known: Uncertainty) -> tuple[Solved, Peaks] | None:
    """
    Fit a line to ln of the energies of peaks.

    Parameters
    ----------
    seen : Peaks
    block : Block
    noise : float
        Standard deviation of the angle at rest, rad.
    known : Uncertainty
        Of α and of the angle's gain.

    Returns
    -------
    solved, peaks : Solved and Peaks, or None
        ln e, height and zero (rad), then ln of α and of the gain; the peaks about that zero. None if fewer than
        `FEWEST_PEAKS` are usable.

    Notes
    -----
    The logarithm falls by 2 ln e an impact. Unknown are its height, the mean of ln e and its departure at each impact,
    a zero that moves peaks of opposite sign in opposite ways, and ln of α and of the gain as far as they are not known.
    """
    usable = seen.used
    if usable.sum() < FEWEST_PEAKS:
        return None
    number = np.flatnonzero(usable)
    number = number - number[0]
    angle, alpha = seen.angle[usable], block.critical_angle_at(seen.angle[usable])
    error = np.maximum(seen.standard_error[usable], LEAST_ERROR * max(noise, 1e-9))
    p = block.p_at(angle)
    walk = 2.0 * (np.arange(int(number[-1])) < number[:, None])
    precision = np.array([0.0, 0.0, 0.0, *np.maximum((known.critical_angle, known.angle_gain), EXACT) ** -2.0])
    origin = np.zeros(precision.size)
    for _ in range(MOST_ROUNDS):
        mean, height, zero = origin[:3]
        size = np.maximum(np.sign(angle) * (angle - zero), 1e-3 * error)
        slope = energy_slope(size, alpha)
        by_alpha = alpha * (np.sin(alpha - size) - np.sin(alpha)) / lift(size, alpha)
        left = np.log(p**2 * lift(size, alpha)) - height - 2 * mean * number
        columns = np.ones(size.size), np.sign(angle) * slope, by_alpha, size * slope, walk
        rows = np.column_stack((left, walk.sum(axis=1), *columns)) / (slope * error)[:, None]
        solved = LinearModel.of(rows.T @ rows, precision, origin, float(size.size), 1.0).solved()
        origin = np.append(solved.mean[:3], [0.0, 0.0])
        if abs(origin[2] - zero) < 1e-3 * error.min():
            break
    mean, height, zero = origin[:3]
    fitted = np.full(seen.angle.shape, np.nan)
    rise = np.exp(height + 2 * mean * number) / p**2 / (1 - np.cos(alpha))
    fitted[usable] = np.sign(angle) * angle_of_energy(rise, alpha)
    return solved, replace(seen, angle=seen.angle - zero, fitted_angle=fitted)
