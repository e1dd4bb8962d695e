"""The scale of a transducer's rotation relative to the equation of motion, from its record alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.signals.stretches import filled_in

BANDWIDTH = 2.0
"""Hz for each rad/s of p, below which the equation of motion is held against the record."""

FEWEST_SECONDS = 1.0
"""Of rocking, in units of 5/p; a shorter record gives no scale."""

CERTAIN = 0.15
"""Largest standard error of a scale, relative to it, with which it is used."""

STANDING = 8.0
"""Times the noise below which a transducer does not move."""

MOVES = 0.03
"""Of the largest angle, above which the specimen is taken to rock."""

HELD = 0.02
"""Of the largest angle, below which the deviation of one that is far from rest means that the specimen is held."""


@dataclass(frozen=True)
class Scale:
    """
    How large a transducer's rotation is against the equation of motion.

    Attributes
    ----------
    value, error : float
        1 where it is right; standard error.
    base, base_error : float
        The same from what the table's acceleration does to it, with its sign; NaN where that is not known.
    """

    value: float
    error: float
    base: float
    base_error: float

    @property
    def is_known(self) -> bool:
        """Whether the record gives the scale."""
        return bool(self.value > 0 and self.error < CERTAIN * self.value)

    @property
    def base_is_known(self) -> bool:
        """Whether the record shows what the table does to the specimen."""
        return bool(abs(self.base) > 0 and self.base_error < CERTAIN * abs(self.base))


def scale_of(interval: float, angle: Array, noise: float, acceleration: Array | None, block: Block) -> Scale:
    """
    Find how many times too large an angle is, by the equation of motion.

    Parameters
    ----------
    interval : float
        s.
    angle : ndarray, shape (n,)
        θ as one transducer gives it, rad; NaN where missing.
    noise : float
        Its standard deviation, rad.
    acceleration : ndarray, shape (n,), or None
        Of the table along x, m/s².
    block : Block

    Returns
    -------
    scale : Scale
        With NaN where the specimen hardly rocks.

    Notes
    -----
    Between impacts θ̈ = p² (θ − α sgn θ − a/g). An angle that is c times the true one obeys it with c α and c a/g
    instead, which gives c by a regression of θ̈ − p² θ on sgn θ and a. Impacts do not disturb it: their pulses are even
    about θ = 0, where sgn θ is odd.
    """
    nothing = Scale(np.nan, np.nan, np.nan, np.nan)
    bandwidth = min(BANDWIDTH * block.p, 0.2 / interval)
    filled = filled_in(angle)
    moving = _rocking(interval, filled, noise, block.p) & np.isfinite(angle)
    if moving.sum() * interval < FEWEST_SECONDS * 5 / block.p:
        return nothing
    critical = block.critical_angle_at(filled)
    squared = block.p**2
    bend = second_derivative(filled, interval, bandwidth) - squared * lowpass(filled, interval, bandwidth)
    columns = [lowpass(-squared * critical * np.sign(filled), interval, bandwidth)]
    if acceleration is not None:
        shaken = lowpass(-squared / block.gravity * filled_in(acceleration), interval, bandwidth)
        if shaken[moving].std() > 0:
            columns.append(shaken)
    matrix = np.column_stack(columns)[moving]
    normal = matrix.T @ matrix
    found = np.linalg.solve(normal, matrix.T @ bend[moving])
    residual = bend[moving] - matrix @ found
    independent = max(2 * bandwidth * interval * moving.sum(), 3.0)
    variance = float(residual @ residual) / independent
    errors = np.sqrt(np.diag(np.linalg.inv(normal)) * variance)
    base, base_error = (found[1], errors[1]) if len(columns) > 1 else (np.nan, np.nan)
    return Scale(float(found[0]), float(errors[0]), float(base), float(base_error))


def _rocking(interval: float, angle: Array, noise: float, p: float) -> Mask:
    """Samples of a movement that is neither noise nor held still far from rest."""
    magnitude = np.abs(angle)
    largest = float(magnitude.max())
    window = max(int(1.6 / p / interval), 3)
    moves = scipy.ndimage.maximum_filter1d(magnitude, window) > max(STANDING * noise, MOVES * largest)
    deviation = np.sqrt(
        np.maximum(
            scipy.ndimage.uniform_filter1d(angle**2, window) - scipy.ndimage.uniform_filter1d(angle, window) ** 2, 0.0
        )
    )
    held = (deviation < HELD * largest) & (magnitude > 0.1 * largest)
    return np.asarray(moves & ~scipy.ndimage.binary_dilation(held, iterations=window))
