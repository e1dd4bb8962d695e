"""Positions of the points of a rocking block, by exact finite rotation about the active pole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block


def pole_position(block: Block) -> float:
    """Distance of either pole from the centre of the base, m."""
    return (block.negative.half_width + block.positive.half_width) / 2


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


@dataclass(frozen=True)
class Pose:
    """
    The pose of a block relative to rest: rotation by `angle` about +y, then by `out_of_plane_angle` about x, then by
    `yaw` about z.

    Attributes
    ----------
    angle, out_of_plane_angle, yaw : ndarray, shape (n,)
        rad.
    slide : ndarray, shape (n,)
        x-displacement of the active pole, m.
    pole_rise : ndarray, shape (n,)
        z-displacement of the active pole, the middle of the edge that the block rocks about, m.
    transverse_slide : ndarray, shape (n,)
        y-displacement of the centre of the base, m.
    """

    angle: Array
    slide: Array
    pole_rise: Array
    out_of_plane_angle: Array
    transverse_slide: Array
    yaw: Array


def rotation_matrix(pose: Pose) -> Array:
    """Matrix that takes directions of the specimen to those of the table, shape (3, 3, n)."""
    cosine, sine = np.cos(pose.angle), np.sin(pose.angle)
    upright, leant = np.cos(pose.out_of_plane_angle), np.sin(pose.out_of_plane_angle)
    ahead, turned = np.cos(pose.yaw), np.sin(pose.yaw)
    nought = np.zeros_like(cosine)
    first = np.array([cosine, nought, sine])
    second = np.array([leant * sine, upright, -leant * cosine])
    third = np.array([-upright * sine, leant, upright * cosine])
    return np.array([ahead * first - turned * second, turned * first + ahead * second, third])


def pole_displacement(pose: Pose, side: ArrayLike, block: Block) -> Array:
    """Displacement of the active pole of a pose, shape (3, n), m; `side` is sgn θ, at θ = 0 the side it belongs to."""
    reach = np.asarray(side, dtype=np.float64) * pole_position(block)
    # Second row, first column of the rotation matrix: how far a point along x swings to y.
    swing = np.sin(pose.yaw) * np.cos(pose.angle)
    swing += np.cos(pose.yaw) * np.sin(pose.out_of_plane_angle) * np.sin(pose.angle)
    return np.array([pose.slide, pose.transverse_slide + reach * swing, pose.pole_rise])


@dataclass(frozen=True)
class Outline:
    """
    What of a specimen's surface its transducers and its base see.

    Attributes
    ----------
    half_width, half_depth : float
        Of the base along x and y, m; of a round one its radius, twice.
    is_round : bool
        Whether the base is a circle and the side that of a cylinder or cone.
    taper : float
        Change of a round side's radius with height.
    """

    half_width: float
    half_depth: float
    is_round: bool = False
    taper: float = 0.0


def lowest_rise(pose: Pose, side: ArrayLike, block: Block, outline: Outline) -> Array:
    """
    Height of the lowest point of the base above the table, m, shape (n,).

    Notes
    -----
    The centre of the base is at the pole's rise less the pole's arm turned; from there the base reaches down by
    |r₁| w/2 + |r₂| d/2 as a rectangle and by √(r₁² + r₂²) times its radius as a circle, with (r₁, r₂, r₃) the last row
    of the rotation matrix.
    """
    along, across, _ = rotation_matrix(pose)[2]
    centre = pose.pole_rise - np.asarray(side, dtype=np.float64) * pole_position(block) * along
    if outline.is_round:
        return np.asarray(centre - outline.half_width * np.hypot(along, across))
    return np.asarray(centre - outline.half_width * np.abs(along) - outline.half_depth * np.abs(across))
