"""The confidence band of the straight line through the energies of the peaks."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.energy import energy_slope, lift
from colonnade.identification.restitution.fitting.random_walk_fit import RandomWalkProblem

FEWEST_PEAKS = 4


def confidence_band(
    angle: ArrayLike, standard_error: ArrayLike, used: ArrayLike, block: Block, *, level: float = 0.95
) -> Array:
    """
    Half-width of the band about the fitted line of ln energy against the impact number.

    Parameters
    ----------
    angle, standard_error : array_like, shape (n,)
        θ of the peaks, signed, about their common zero, and its standard error, rad.
    used : array_like of bool, shape (n,)
        Peaks through which the line goes.
    block : Block
    level : float, optional
        Confidence that the line at one number lies inside.

    Returns
    -------
    half_width : ndarray, shape (n,)
        Of ln energy; NaN where fewer than `FEWEST_PEAKS` are used.

    Notes
    -----
    Unknown are the height of the line, its slope 2 ln e and the zero offset of θ; e may scatter from impact to impact.
    """
    theta, error = np.asarray(angle, dtype=np.float64), np.asarray(standard_error, dtype=np.float64)
    critical = block.critical_angle_at(theta)
    size = np.abs(theta)
    kept = np.asarray(used, dtype=bool) & np.isfinite(error) & (size > 0) & (size < critical)
    if kept.sum() < FEWEST_PEAKS:
        return np.full(theta.shape, np.nan)
    number = np.arange(theta.size, dtype=np.float64)
    slope = energy_slope(theta, critical)
    since = number[kept] - number[kept][0]
    problem = RandomWalkProblem(
        np.column_stack((np.ones(since.size), number[kept], (np.sign(theta) * slope)[kept])),
        np.log(lift(theta, critical)[kept]),
        np.diag(np.maximum(slope * error, 1e-9)[kept] ** 2),
        np.minimum.outer(since, since),
    )
    fit = problem.fit()
    at = np.column_stack((np.ones(theta.size), number))
    variance = ((at @ fit.covariance[:2, :2]) * at).sum(axis=1)
    return np.asarray(float(scipy.special.stdtrit(fit.freedom, (1 + level) / 2)) * np.sqrt(variance))
