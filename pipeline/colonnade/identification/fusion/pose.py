"""Motion of the specimen from its displacement transducers and inclinometers: least squares over exact rotations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose, lowest_rise, pole_position
from colonnade.identification.fusion.sensors import UNKNOWNS, Transducer, is_separated, predict, separate
from colonnade.validation import instance, samples

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

UNIT = 1e-3
"""By which the length of a unit vector may differ from one: directions are often given with three digits."""

LARGEST = 10.0
"""In pole distances: a point of a block that falls moves less; beyond it the displacements are no metres."""

Model = Callable[[Pose, float], tuple[Array, Array]]
"""`predict` of a pose and a side."""


@dataclass(frozen=True)
class SpecimenMotion:
    """
    Motion of the specimen with its errors.

    Attributes
    ----------
    values : dict of str to ndarray, shape (n,)
        What the set-up separates, by name: "rocking_angle" (rad) and, where separated, "slide", "out_of_plane_angle",
        "transverse_slide", "yaw" and "uplift" (of the lowest point of the base); m and rad. NaN where too few
        transducers have a value.
    standard_error : dict of str to ndarray, shape (n,)
        Of each of them: from the noise given, or from the residuals where these are larger.
    residual : ndarray, shape (m, n)
        Reading less predicted reading of each sensor, SI; NaN without a prediction.
    pose : Pose
        With zeros for what is not separated.
    separation : str
        What the set-up separates, for the report.
    entered : ndarray of bool, shape (m,)
        Whether the angle is from it; the others are compared with what the motion predicts for them.
    is_integrated : bool
        Whether the angle is integrated, so that its error has a history of its own.
    """

    values: dict[str, Array]
    standard_error: dict[str, Array]
    residual: Array
    pose: Pose
    separation: str
    entered: Mask = field(default_factory=lambda: np.empty(0, dtype=np.bool_))
    is_integrated: bool = False

    @property
    def angle(self) -> Array:
        """θ, rad, shape (n,)."""
        return self.values["rocking_angle"]

    @property
    def residual_size(self) -> Array:
        """Root mean square of each sensor's residual, shape (m,)."""
        count = np.isfinite(self.residual).sum(axis=1)
        return np.where(count, np.sqrt(np.nansum(self.residual**2, axis=1) / np.maximum(count, 1)), np.nan)


def rocking_angle(displacements: ArrayLike, at: ArrayLike, direction: ArrayLike, block: Block) -> Array:
    """
    Rocking angle from point displacement transducers.

    Parameters
    ----------
    displacements : array_like, shape (m, n) or (n,)
        Displacement of each material point along its direction, relative to the table, m; missing where not finite.
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
        If the shapes do not fit, no transducer measures the rotation, or the displacements are far larger than the
        block: in mm.

    Notes
    -----
    Lasers, string pots, inclinometers and the other unknowns of a pose:
    `colonnade.identification.fusion.pose.fit_pose`.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> readings = [[0.0, 4.4e-3], [0.0, 0.4e-3]]  # m, at 440 mm and at 40 mm
    >>> points = [[0.043, 0.0, 0.44], [0.043, 0.0, 0.04]]
    >>> rocking_angle(readings, points, [[1, 0, 0], [1, 0, 0]], block).round(5).tolist()
    [0.0, 0.01]
    """
    readings = np.atleast_2d(samples("displacements", displacements, dimensions=(1, 2), finite=False))
    readings = np.where(np.isfinite(readings), readings, np.nan)
    largest = float(np.nanmax(np.abs(readings), initial=0.0))
    if largest > LARGEST * instance("block", block, Block).pole_distance:
        raise ValueError(
            f"displacements reach {largest:.3g}, more than {LARGEST:g} times the size of the block; metres, relative "
            "to the table, were expected"
        )
    points, directions = _vectors("at", at), _vectors("direction", direction)
    lengths = np.linalg.norm(directions, axis=1)
    if not (np.abs(lengths - 1.0) < UNIT).all():
        worst = lengths[np.argmax(np.abs(lengths - 1.0))]
        raise ValueError(f"direction has a vector of length {worst:g}; unit vectors were expected")
    if not readings.shape[0] == points.shape[0] == directions.shape[0]:
        raise ValueError(
            f"{readings.shape[0]} records, {points.shape[0]} positions and {directions.shape[0]} directions; "
            "one position and one direction for each record were expected"
        )
    vectors = zip(directions.tolist(), points.tolist(), strict=True)
    transducers = [Transducer("point", tuple(along), tuple(point)) for along, point in vectors]
    outline, base = Outline(pole_position(block), 0.0), np.zeros((3, readings.shape[1]))
    return fit_pose(readings, transducers, block, outline, noise=np.ones(points.shape[0]), base=base).angle


def _vectors(name: str, values: ArrayLike) -> Array:
    vectors = samples(name, values, dimensions=(1, 2))
    if vectors.shape[-1] != 3:
        raise ValueError(f"{name} has shape {vectors.shape}; vectors of three components were expected")
    return vectors.reshape(-1, 3)


def fit_pose(
    readings: Array, transducers: list[Transducer], block: Block, outline: Outline, *, noise: Array, base: Array
) -> SpecimenMotion:
    """
    Fit the pose of a block to its transducers, sample by sample.

    Parameters
    ----------
    readings : ndarray, shape (m, n)
        Changes from rest, m or rad; NaN where missing.
    transducers : list of Transducer, length m
    block : Block
    outline : Outline
    noise : ndarray, shape (m,)
        Standard deviation of each reading: the weights of the fit.
    base : ndarray, shape (3, n)
        Displacement of the table relative to the ground, m; transducers on the ground read it as well.

    Raises
    ------
    ValueError
        If no transducer measures the rotation about both poles.

    Notes
    -----
    The pole changes at θ = 0, so each sample is solved about either pole, and the better of the two is taken.
    """
    lost = ~np.isfinite(base).all(axis=0) & np.array([[each.on_ground] for each in transducers])
    values, base, sigma = np.where(lost, np.nan, readings), np.nan_to_num(base), np.maximum(noise, 1e-12)
    chosen, designs, separation = separate(transducers, sigma, block, outline)
    weights = _weights(values, sigma, designs)
    pieces = []
    for start in range(0, values.shape[1], CHUNK):
        part = slice(start, start + CHUNK)
        model = partial(predict, transducers, block=block, outline=outline, base=base[:, part])
        pieces.append(_fit(values[:, part], weights[:, part], chosen, model))
    whole, side, residual, variance = (np.concatenate(each, axis=-1) for each in zip(*pieces, strict=True))

    errors = np.sqrt(variance) * _widening(residual, weights, len(chosen))
    pose = _pose(whole)
    names = [UNKNOWNS[index] for index in chosen]
    fitted = dict(zip(names, whole[chosen], strict=True))
    if "uplift" in fitted:
        fitted["uplift"] = lowest_rise(pose, side, block, outline)
    return SpecimenMotion(fitted, dict(zip(names, errors, strict=True)), residual, pose, separation)


def _weights(values: Array, sigma: Array, designs: Array) -> Array:
    """Inverse variances, zero of a missing reading and of all in a sample that does not separate the unknowns."""
    present = np.isfinite(values)
    weights = np.where(present, 1.0 / sigma[:, None] ** 2, 0.0)
    patterns, which = np.unique(present, axis=1, return_inverse=True)
    for index, pattern in enumerate(patterns.T):
        known = np.where(pattern, sigma, np.inf)
        if not pattern.all() and not (pattern.any() and is_separated(designs, known)):
            weights[:, np.ravel(which) == index] = 0.0
    return weights


def _widening(residual: Array, weights: Array, unknowns: int) -> float:
    """Factor on standard errors: scatter of the residuals over the noise, never below the noise that was given."""
    freedom, solved = residual.shape[0] - unknowns, weights.any(axis=0)
    if freedom <= 0 or not solved.any():
        return 1.0
    squares = np.nansum(weights[:, solved] * residual[:, solved] ** 2, axis=0) / freedom
    return max(float(np.sqrt(squares.mean())), 1.0)


def _fit(values: Array, weights: Array, chosen: list[int], model: Model) -> tuple[Array, Array, Array, Array]:
    """All unknowns (6, n), side (n,), residuals (m, n) and variances for unit noise (k, n) of some samples."""
    solvable = weights.any(axis=0)
    best = np.full(values.shape[1], np.inf)
    side, whole = np.ones_like(best), np.zeros((len(UNKNOWNS), best.size))
    whole[chosen] = np.nan
    variance, residual = np.full((len(chosen), best.size), np.nan), np.full_like(values, np.nan)
    for each in (-1.0, 1.0):
        found, misfit, normal = _solve(np.nan_to_num(values), weights, chosen, model, each)
        cost = np.where(solvable, (weights * misfit**2).sum(axis=0), np.inf)
        better = cost < best
        best, side = np.where(better, cost, best), np.where(better, each, side)
        whole = np.where(better, found, whole)
        residual = np.where(better & (weights > 0), misfit, residual)
        variance[:, better] = np.diagonal(np.linalg.inv(normal[better]), axis1=1, axis2=2).T
    return whole, side, residual, variance


def _solve(readings: Array, weights: Array, chosen: list[int], model: Model, side: float) -> tuple[Array, Array, Array]:
    """Gauss–Newton about one pole, all samples at once: unknowns (6, n), misfit (m, n), normal matrices (n, k, k)."""
    whole = np.zeros((len(UNKNOWNS), readings.shape[1]))
    for _ in range(ITERATIONS):
        predicted, columns = model(_pose(whole), side)
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
    return whole, misfit, normal


def _pose(whole: Array) -> Pose:
    angle, slide, out_of_plane_angle, transverse_slide, yaw, pole_rise = whole
    return Pose(angle, slide, pole_rise, out_of_plane_angle, transverse_slide, yaw)
