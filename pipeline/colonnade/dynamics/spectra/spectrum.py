"""Rocking spectrum of a recorded motion: the largest angle of rectangular blocks over their size and slenderness."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.models.registry import plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock


@dataclass(frozen=True)
class RockingSpectrum:
    """
    Largest angles of blocks on one motion.

    Attributes
    ----------
    critical_angle : ndarray, shape (n,)
        α, rad.
    period : ndarray, shape (m,)
        2π/p, s.
    peak_ratio : ndarray, shape (n, m)
        Largest |θ|/α; NaN where the block overturns, 0 where it does not uplift.
    peak_velocity_ratio : ndarray, shape (n, m)
        Largest |θ'|/p, rad, up to overturning.
    overturned : ndarray of bool, shape (n, m)
    """

    critical_angle: Array
    period: Array
    peak_ratio: Array
    peak_velocity_ratio: Array
    overturned: NDArray[np.bool_]


def rocking_spectrum(
    motion: Motion,
    *,
    critical_angle: ArrayLike,
    period: ArrayLike,
    restitution: float | None = None,
    model: str = NONLINEAR.name,
    gravity: float = STANDARD_GRAVITY,
) -> RockingSpectrum:
    """
    Compute the rocking spectrum of a recorded motion.

    Parameters
    ----------
    motion : Motion
    critical_angle : array_like, shape (n,)
        α of the blocks, rad.
    period : array_like, shape (m,)
        2π/p of the blocks, s; for a rectangular block p² = 3 g/(4 R).
    restitution : float, optional
        e; by default that of a rigid rectangular block without bounce, 1 − (3/2) sin² α.
    model : str, optional
        A plane one.
    gravity : float, optional
        m/s².

    Returns
    -------
    spectrum : RockingSpectrum

    Raises
    ------
    ValueError
        If an angle, a period or e is out of its range or the model is not known.

    Notes
    -----
    After Makris and Konstantinidis (2003): p, unlike a natural period, is a measure of size only, and the spectrum has
    to be read for one slenderness at a time.

    Examples
    --------
    >>> motion = Motion(3.0 * np.sin(np.linspace(0, 2 * np.pi, 200)), 0.005)
    >>> spectrum = rocking_spectrum(motion, critical_angle=[0.2, 0.4], period=[0.8, 6.0])
    >>> spectrum.overturned.tolist()
    [[True, False], [False, False]]
    """
    angles = np.atleast_1d(np.asarray(critical_angle, dtype=np.float64))
    periods = np.atleast_1d(np.asarray(period, dtype=np.float64))
    shape = (angles.size, periods.size)
    peak, velocity, overturned = np.zeros(shape), np.zeros(shape), np.zeros(shape, dtype=bool)
    for row, alpha in enumerate(angles.tolist()):
        uplifts = motion.peak > gravity * plane_model_of(model).uplift_threshold(alpha)
        for column, one in enumerate(periods.tolist()):
            block = _rectangular(alpha, one, gravity)
            if not uplifts:
                continue
            history = rock(block, motion, restitution=restitution, model=model)
            overturned[row, column] = history.outcome == "overturned"
            peak[row, column] = np.nan if history.peak_ratio is None else history.peak_ratio
            standing = history.time <= history.overturning_time if overturned[row, column] else slice(None)
            velocity[row, column] = np.abs(history.angular_velocity[standing]).max() / block.p
    return RockingSpectrum(angles, periods, peak, velocity, overturned)


def _rectangular(critical_angle: float, period: float, gravity: float) -> Block:
    if not period > 0:
        raise ValueError(f"period is {period}; a positive number of seconds was expected")
    distance = 0.75 * gravity / (2 * pi / period) ** 2
    return Block.measured(
        mass=1.0,
        pole_distance=distance,
        critical_angle=critical_angle,
        inertia=4 / 3 * distance**2,
        gravity=gravity,
    )
