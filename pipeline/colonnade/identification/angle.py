"""Rocking angle and slide from displacement transducers, by least squares over exact finite rotations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import arm

Array = NDArray[np.float64]

LARGEST_AMPLIFICATION = 10.0
"""Slide is fitted beside the angle only where this costs the angle's standard error less than this factor."""

ITERATIONS = 8
"""Gauss–Newton converges quadratically; from θ = 0 to 1 rad this reaches rounding."""


@dataclass(frozen=True)
class RockingFit:
    """
    Plane motion of a block, fitted to its transducers.

    Attributes
    ----------
    angle : ndarray, shape (n,)
        θ, rad; NaN where too few transducers have a value.
    slide : ndarray, shape (n,), or None
        x-displacement of the active pole, m; None where the set-up does not separate it from the angle.
    residual : ndarray, shape (m, n)
        Reading less fitted displacement of each transducer, m.
    standard_error : float
        Of the angle, rad: from the noise given, or from the residuals where these are larger.
    separation : str
        What the set-up separates, for the report.
    """

    angle: Array
    slide: Array | None
    residual: Array
    standard_error: float
    separation: str


def rocking_angle(displacements: ArrayLike, at: ArrayLike, direction: ArrayLike, block: Block) -> Array:
    """
    Rocking angle from point displacement transducers.

    Parameters
    ----------
    displacements : array_like, shape (m, n) or (n,)
        Displacement of each material point along its direction, relative to the table, m; NaN where missing.
    at : array_like, shape (m, 3) or (3,)
        The points, in the specimen frame at rest (origin at the centre of the base, z up), m.
    direction : array_like, shape (m, 3) or (3,)
        Unit vectors.
    block : Block

    Returns
    -------
    angle : ndarray, shape (n,)
        θ, rad, positive when the top moves to +x.

    Raises
    ------
    ValueError
        If the shapes do not fit or no transducer sees the rotation.
    """
    return fit_rocking(displacements, at, direction, block).angle


def fit_rocking(
    displacements: ArrayLike, at: ArrayLike, direction: ArrayLike, block: Block, *, noise: ArrayLike | None = None
) -> RockingFit:
    """
    Fit angle and, as far as the set-up separates it, slide; see `rocking_angle` for the arguments.

    Parameters
    ----------
    noise : array_like, shape (m,), optional
        Standard deviation of each reading, m: the weights of the fit. Default: all the same, taken from the residuals.
    """
    readings = np.atleast_2d(np.asarray(displacements, dtype=np.float64))
    points = np.asarray(at, dtype=np.float64).reshape(-1, 3)
    directions = np.asarray(direction, dtype=np.float64).reshape(-1, 3)
    if not readings.shape[0] == points.shape[0] == directions.shape[0]:
        raise ValueError(
            f"{readings.shape[0]} records, {points.shape[0]} positions and {directions.shape[0]} directions; "
            "one position and one direction for each record were expected"
        )
    sigma = np.ones(points.shape[0]) if noise is None else np.maximum(np.asarray(noise, dtype=np.float64), 1e-12)
    with_slide, separation, amplification = _separation(points, directions, sigma)
    weights = np.where(np.isfinite(readings), 1.0 / sigma[:, None] ** 2, 0.0)
    filled = np.nan_to_num(readings)

    best_cost = np.full(readings.shape[1], np.inf)
    angle, slide = np.full_like(best_cost, np.nan), np.full_like(best_cost, np.nan)
    residual = np.full_like(readings, np.nan)
    for side in (-1.0, 1.0):
        theta, shift, misfit, solvable = _solve(filled, weights, points, directions, block, side, with_slide=with_slide)
        cost = np.where(solvable, (weights * misfit**2).sum(axis=0), np.inf)
        better = cost < best_cost
        best_cost = np.where(better, cost, best_cost)
        angle, slide = np.where(better, theta, angle), np.where(better, shift, slide)
        residual = np.where(better & (weights > 0), misfit, residual)

    unknowns = 2 if with_slide else 1
    freedom = points.shape[0] - unknowns
    spread = 1.0
    if freedom > 0:
        scatter = float(np.sqrt(np.nanmean(np.nansum((residual / sigma[:, None]) ** 2, axis=0) / freedom)))
        spread = scatter if noise is None else max(scatter, 1.0)
    elif noise is None:
        spread = float("nan")
    return RockingFit(angle, slide if with_slide else None, residual, amplification * spread, separation)


def _separation(points: Array, directions: Array, sigma: Array) -> tuple[bool, str, float]:
    """Decide whether slide is fitted; return the angle's standard error for unit spread as well."""
    # Readings change by (z d_x − x d_z) δθ + d_x δs about rest; the pole's own lift enters x only.
    rotation = (points[:, 2] * directions[:, 0] - points[:, 0] * directions[:, 2]) / sigma
    translation = directions[:, 0] / sigma
    seen = float(rotation @ rotation)
    if not seen > 0.0:
        raise ValueError(
            "No transducer sees the rotation: each lies at the height of the base, or points across the plane. "
            "At least one displacement transducer above the base, with a direction along x, was expected"
        )
    alone = 1.0 / np.sqrt(seen)
    slid = float(translation @ translation)
    overlap = float(rotation @ translation)
    determinant = seen * slid - overlap**2
    if points.shape[0] > 1 and slid > 0 and determinant > 0:
        both = float(np.sqrt(slid / determinant))
        if both < LARGEST_AMPLIFICATION * alone:
            return True, f"angle and slide, from {points.shape[0]} displacement transducers", both
    count = "one displacement transducer" if points.shape[0] == 1 else f"{points.shape[0]} displacement transducers"
    return False, f"angle only, from {count}; slide is not separated from it and taken as zero", float(alone)


def _solve(
    readings: Array, weights: Array, points: Array, directions: Array, block: Block, side: float, *, with_slide: bool
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Gauss–Newton on one side of θ = 0, all samples at once."""
    horizontal, vertical = (values[:, None] for values in arm(points, side, block))
    along_x, along_z = directions[:, :1], directions[:, 2:]
    theta, slide = np.zeros(readings.shape[1]), np.zeros(readings.shape[1])
    solvable = np.ones(readings.shape[1], dtype=bool)

    def misfit_of(theta: Array, slide: Array) -> Array:
        rise, sine = np.cos(theta) - 1, np.sin(theta)
        moved_x = horizontal * rise + vertical * sine + slide
        moved_z = vertical * rise - horizontal * sine
        return np.asarray(readings - along_x * moved_x - along_z * moved_z)

    for _ in range(ITERATIONS):
        misfit = misfit_of(theta, slide)
        cosine, sine = np.cos(theta), np.sin(theta)
        turn = along_x * (vertical * cosine - horizontal * sine) - along_z * (horizontal * cosine + vertical * sine)
        a = (weights * turn**2).sum(axis=0)
        b = (weights * turn * misfit).sum(axis=0)
        if with_slide:
            c = (weights * turn * along_x).sum(axis=0)
            d = (weights * along_x**2).sum(axis=0)
            f = (weights * along_x * misfit).sum(axis=0)
            determinant = a * d - c**2
            solvable = determinant > 1e-9 * a * d
            safe = np.where(solvable, determinant, 1.0)
            step, shift = (d * b - c * f) / safe, (a * f - c * b) / safe
            slide = slide + np.where(solvable, shift, 0.0)
        else:
            solvable = a > 0
            step = b / np.where(solvable, a, 1.0)
        # The pole changes at θ = 0, so each side is solved within itself; a full turn is out of any transducer's reach.
        theta = np.clip(theta + np.where(solvable, step, 0.0), min(0.0, 2.0 * side), max(0.0, 2.0 * side))
    return theta, slide, misfit_of(theta, slide), solvable
