"""Motion of the specimen from all its transducers: weighted least squares over exact finite rotations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose, lowest_rise, pole_position
from colonnade.identification.fusion.sensors import UNKNOWNS, Transducer, predict
from colonnade.identification.fusion.separation import Separation, is_separated, separate

ITERATIONS = 12
"""Gauss–Newton converges quadratically; from rest to 1 rad this reaches rounding."""

CONVERGED = 1e-13
"""Steps below this, in rad and m, end the iteration."""

RIDGE = 1e-12
"""Relative addition to the diagonal of the normal matrices; it slows a step and leaves the solution as it is."""

LARGEST_ANGLE = 2.0
"""rad; no transducer follows a specimen further."""

CHUNK = 16384
"""Samples that are fitted at a time, so that a long record needs little memory."""


@dataclass(frozen=True)
class PoseFit:
    """
    Motion of a block, fitted to its transducers.

    Attributes
    ----------
    values : dict of str to ndarray, shape (n,)
        What the set-up separates, by name: "rocking_angle" (rad) and, where separated, "slide", "out_of_plane_angle",
        "transverse_slide", "yaw" and "uplift" (of the lowest point of the base); m and rad. NaN where too few
        transducers have a value.
    standard_error : dict of str to ndarray, shape (n,)
        Of each of them: from the noise given, or from the residuals where these are larger.
    residual : ndarray, shape (m, n)
        Reading less predicted reading of each transducer, m or rad.
    pose : Pose
        The fitted pose, with zeros for what is not separated.
    separation : str
        What the set-up separates, for the report.
    """

    values: dict[str, Array]
    standard_error: dict[str, Array]
    residual: Array
    pose: Pose
    separation: str

    @property
    def angle(self) -> Array:
        """θ, rad, shape (n,)."""
        return self.values["rocking_angle"]


def fit_pose(
    readings: ArrayLike,
    transducers: list[Transducer],
    block: Block,
    *,
    noise: ArrayLike | None = None,
    outline: Outline | None = None,
    base: Array | None = None,
) -> PoseFit:
    """
    Fit the pose of a block to its transducers, sample by sample.

    Parameters
    ----------
    readings : array_like, shape (m, n)
        Changes from rest, m or rad; NaN where missing.
    transducers : list of Transducer, length m
    block : Block
    noise : array_like, shape (m,), optional
        Standard deviation of each reading: the weights of the fit. Default: all the same, taken from the residuals.
    outline : Outline, optional
        Of the specimen; by default a base as wide as the poles are apart, of no depth.
    base : ndarray, shape (3, n), optional
        Displacement of the table relative to the ground, m; transducers on the ground read it as well.

    Returns
    -------
    fit : PoseFit

    Raises
    ------
    ValueError
        If no transducer measures the rotation about both poles.

    Notes
    -----
    The pole changes at θ = 0, so each sample is solved about either pole, and the better of the two is taken.
    """
    values = np.atleast_2d(np.asarray(readings, dtype=np.float64))
    outline = outline or Outline(pole_position(block), 0.0)
    if base is not None:
        lost = ~np.isfinite(base).all(axis=0) & np.array([[each.on_ground] for each in transducers])
        values, base = np.where(lost, np.nan, values), np.nan_to_num(base)
    sigma = np.ones(len(transducers)) if noise is None else np.maximum(np.asarray(noise, dtype=np.float64), 1e-12)
    separation = separate(transducers, sigma, block, outline)
    weights = _weights(values, sigma, separation)
    pieces = []
    for start in range(0, values.shape[1], CHUNK):
        part = slice(start, start + CHUNK)
        moved = None if base is None else base[:, part]
        pieces.append(_fit_part(values[:, part], weights[:, part], transducers, block, outline, moved, separation))
    found, side, residual, variance = (np.concatenate(each, axis=-1) for each in zip(*pieces, strict=True))

    errors = np.sqrt(variance) * _widening(residual, weights, len(separation.unknowns), given=noise is not None)
    whole = np.zeros((len(UNKNOWNS), values.shape[1]))
    whole[_indices(separation)] = found
    pose = _pose(whole)
    fitted = dict(zip(separation.unknowns, found, strict=True))
    if "uplift" in fitted:
        fitted["uplift"] = lowest_rise(pose, side, block, outline)
    return PoseFit(fitted, dict(zip(separation.unknowns, errors, strict=True)), residual, pose, separation.text)


def _weights(values: Array, sigma: Array, separation: Separation) -> Array:
    """Inverse variances, zero of a missing reading and of all in a sample that does not separate the unknowns."""
    present = np.isfinite(values)
    weights = np.where(present, 1.0 / sigma[:, None] ** 2, 0.0)
    if present.all():
        return weights
    patterns, which = np.unique(present, axis=1, return_inverse=True)
    for index, pattern in enumerate(patterns.T):
        known = np.where(pattern, sigma, np.inf)
        if not pattern.all() and not (pattern.any() and is_separated(separation.designs, known)):
            weights[:, np.ravel(which) == index] = 0.0
    return weights


def _widening(residual: Array, weights: Array, unknowns: int, *, given: bool) -> float:
    """Factor on standard errors: scatter of the residuals over the noise, never below the noise that was given."""
    freedom = residual.shape[0] - unknowns
    if freedom <= 0:
        return 1.0 if given else float("nan")
    solved = weights.any(axis=0)
    squares = np.nansum(weights[:, solved] * residual[:, solved] ** 2, axis=0) / freedom
    scatter = float(np.sqrt(squares.mean())) if squares.size else float("nan")
    return max(scatter, 1.0) if given else scatter


def _fit_part(
    values: Array,
    weights: Array,
    transducers: list[Transducer],
    block: Block,
    outline: Outline,
    base: Array | None,
    separation: Separation,
) -> tuple[Array, Array, Array, Array]:
    """Unknowns (k, n), side (n,), residuals (m, n) and variances for unit noise (k, n) of some samples."""
    solvable = weights.any(axis=0)
    best = np.full(values.shape[1], np.inf)
    side = np.ones_like(best)
    unknowns, variance = np.full((2, len(separation.unknowns), values.shape[1]), np.nan)
    residual = np.full_like(values, np.nan)
    for each in (-1.0, 1.0):
        found, misfit, normal = _solve(
            np.nan_to_num(values), weights, transducers, block, outline, base, separation, each
        )
        cost = np.where(solvable, (weights * misfit**2).sum(axis=0), np.inf)
        better = cost < best
        best, side = np.where(better, cost, best), np.where(better, each, side)
        unknowns = np.where(better, found, unknowns)
        residual = np.where(better & (weights > 0), misfit, residual)
        covariance = np.linalg.inv(normal[better])
        variance[:, better] = np.diagonal(covariance, axis1=1, axis2=2).T
    return unknowns, side, residual, variance


def _solve(
    readings: Array,
    weights: Array,
    transducers: list[Transducer],
    block: Block,
    outline: Outline,
    base: Array | None,
    separation: Separation,
    side: float,
) -> tuple[Array, Array, Array]:
    """Gauss–Newton about one pole, all samples at once: unknowns (k, n), misfit (m, n), normal matrices (n, k, k)."""
    chosen = _indices(separation)
    whole = np.zeros((len(UNKNOWNS), readings.shape[1]))
    for _ in range(ITERATIONS):
        predicted, columns = predict(transducers, _pose(whole), side, block, outline, base)
        misfit = np.where(weights > 0, readings - predicted, 0.0)
        columns = columns[:, chosen]
        weighted = columns * weights[:, None]
        normal = np.einsum("mkn,mln->nkl", weighted, columns)
        # A column that no reading is left in would make its matrix singular; the rest is too small to be felt.
        diagonal = np.diagonal(normal, axis1=1, axis2=2)
        normal += np.where(diagonal > 0, RIDGE * diagonal, 1.0)[:, :, None] * np.eye(len(chosen))
        step = np.linalg.solve(normal, np.einsum("mkn,mn->nk", weighted, misfit)[..., None])[..., 0].T
        before = whole[chosen]
        whole[chosen] = before + step
        whole[0] = np.clip(whole[0], min(0.0, LARGEST_ANGLE * side), max(0.0, LARGEST_ANGLE * side))
        if not (np.abs(whole[chosen] - before) > CONVERGED).any():
            break
    return whole[chosen], misfit, normal


def _pose(whole: Array) -> Pose:
    angle, slide, out_of_plane_angle, transverse_slide, yaw, pole_rise = whole
    return Pose(angle, slide, pole_rise, out_of_plane_angle, transverse_slide, yaw)


def _indices(separation: Separation) -> list[int]:
    return [UNKNOWNS.index(name) for name in separation.unknowns]
