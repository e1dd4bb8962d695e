"""Rocking angle from displacement transducers that follow material points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Vector
from colonnade.dynamics.block import Block
from colonnade.identification.fusion.pose import PoseFit, fit_pose
from colonnade.identification.fusion.sensors import Transducer
from colonnade.validation import instance, samples

UNIT = 1e-3
"""By which the length of a unit vector may differ from one: directions are often given with three digits."""

LARGEST = 10.0
"""In pole distances: a point of a block that falls moves less; beyond it the displacements are no metres."""


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
    readings = samples("displacements", displacements, dimensions=(1, 2), gaps=True)
    largest = float(np.nanmax(np.abs(readings), initial=0.0))
    if largest > LARGEST * instance("block", block, Block).pole_distance:
        raise ValueError(
            f"displacements reach {largest:.3g}, more than {LARGEST:g} times the size of the block; metres, relative "
            "to the table, were expected"
        )
    return fit_rocking(readings, at, direction, block).angle


def fit_rocking(
    displacements: ArrayLike, at: ArrayLike, direction: ArrayLike, block: Block, *, noise: ArrayLike | None = None
) -> PoseFit:
    """
    Fit the pose, as far as point displacement transducers separate it; see `rocking_angle` for the arguments.

    Parameters
    ----------
    noise : array_like, shape (m,), optional
        Standard deviation of each reading, m: the weights of the fit. Default: all the same, taken from the residuals.
    """
    instance("block", block, Block)
    readings = np.atleast_2d(samples("displacements", displacements, dimensions=(1, 2), gaps=True))
    points, directions = _vectors("at", at), _vectors("direction", direction)
    lengths = np.linalg.norm(directions, axis=1)
    if not (np.abs(lengths - 1.0) < UNIT).all():
        worst = lengths[np.argmax(np.abs(lengths - 1.0))]
        raise ValueError(f"direction has a vector of length {worst:g}; unit vectors were expected")
    if noise is not None:
        noise = samples("noise", noise)
    if not readings.shape[0] == points.shape[0] == directions.shape[0]:
        raise ValueError(
            f"{readings.shape[0]} records, {points.shape[0]} positions and {directions.shape[0]} directions; "
            "one position and one direction for each record were expected"
        )
    transducers = [
        Transducer("point", _vector(along), _vector(point)) for point, along in zip(points, directions, strict=True)
    ]
    return fit_pose(readings, transducers, block, noise=noise)


def _vectors(name: str, values: ArrayLike) -> Array:
    vectors = samples(name, values, dimensions=(1, 2))
    if vectors.shape[-1] != 3:
        raise ValueError(f"{name} has shape {vectors.shape}; vectors of three components were expected")
    return vectors.reshape(-1, 3)


def _vector(values: Array) -> Vector:
    x, y, z = (float(each) for each in values)
    return x, y, z
