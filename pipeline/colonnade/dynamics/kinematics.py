"""Where the points of a rocking block are: exact finite rotation about the active pole."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.dynamics.block import Block

Array = NDArray[np.float64]


def pole_position(block: Block) -> float:
    """Distance of either pole from the centre of the base, m."""
    return (block.negative.half_width + block.positive.half_width) / 2


def arm(at: ArrayLike, side: float, block: Block) -> tuple[Array, Array]:
    """
    Horizontal and vertical distance of points from the active pole, at rest.

    Parameters
    ----------
    at : array_like, shape (m, 3)
        Positions in the specimen frame, m.
    side : float
        sgn θ: the pole is at +x for θ > 0 and at −x for θ < 0.

    Returns
    -------
    horizontal, vertical : ndarray, shape (m,)
        m, along x and z.
    """
    points = np.asarray(at, dtype=np.float64).reshape(-1, 3)
    return points[:, 0] - side * pole_position(block), points[:, 2]


def point_displacement(angle: ArrayLike, at: ArrayLike, block: Block, slide: ArrayLike = 0.0) -> Array:
    """
    Displacement of material points of the block relative to the table.

    Parameters
    ----------
    angle : array_like, shape (n,)
        Rocking angle θ, rad, positive when the top moves to +x.
    at : array_like, shape (m, 3)
        Positions in the specimen frame at rest, m.
    block : Block
    slide : array_like, shape (n,) or scalar, optional
        x-displacement of the active pole, m.

    Returns
    -------
    displacement : ndarray, shape (m, n, 3)
        Along x, y, z, m.

    Notes
    -----
    Rotation about +y by θ takes a point (X, Z) from the pole to (X cos θ + Z sin θ, Z cos θ − X sin θ).
    """
    theta = np.atleast_1d(np.asarray(angle, dtype=np.float64))
    points = np.asarray(at, dtype=np.float64).reshape(-1, 3)
    horizontal = points[:, :1] - np.sign(theta) * pole_position(block)
    vertical = points[:, 2:]
    cosine, sine = np.cos(theta), np.sin(theta)
    displacement = np.zeros((points.shape[0], theta.size, 3))
    displacement[..., 0] = horizontal * (cosine - 1) + vertical * sine + np.asarray(slide, dtype=np.float64)
    displacement[..., 2] = vertical * (cosine - 1) - horizontal * sine
    return displacement
