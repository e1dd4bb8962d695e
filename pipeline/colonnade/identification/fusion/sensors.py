"""The reading of a transducer for a pose of the specimen, and how it changes with the pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from colonnade.arrays import Array, Mask, Vector
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose, pole_displacement, pole_position, rotation_matrix

UNKNOWNS = ("rocking_angle", "slide", "out_of_plane_angle", "transverse_slide", "yaw", "uplift")
"""Of a pose, in the order in which they are looked for."""

GRAZING = 1e-3
"""A line of sight that leaves a round side is followed no further than to this fraction of its radius from the rim."""


@dataclass(frozen=True)
class Transducer:
    """
    A transducer on, or aimed at, the specimen, in the specimen frame at rest.

    Attributes
    ----------
    sensing : str
        "point" follows a material point; "surface" looks along a line that is fixed in space; "wire" is the length
        between a fixed anchor and a material point; "angle" turns with the specimen.
    direction : tuple of 3 float
        Unit vector of a positive reading; of an angle its axis.
    at : tuple of 3 float
        The point, or a point on the line of sight where it meets the surface at rest, m.
    normal : tuple of 3 float or None
        Outward normal of the flat face that a "surface" transducer looks at; None for the side of a round specimen.
    anchor : tuple of 3 float or None
        Fixed end of a "wire", m.
    on_ground : bool
        Whether it is fixed to the ground, so that it reads the table's displacement as well.
    """

    sensing: Literal["point", "surface", "wire", "angle"]
    direction: Vector
    at: Vector = (0.0, 0.0, 0.0)
    normal: Vector | None = None
    anchor: Vector | None = None
    on_ground: bool = False

    def __post_init__(self) -> None:
        if self.sensing == "wire" and self.anchor is None:
            raise ValueError("A wire needs its anchor: the fixed end, in the specimen frame at rest")


@dataclass(frozen=True)
class _Carried:
    """A pose as the transducers see it: rotation (3, 3, n), the active pole at rest (3,) and moved (3, n)."""

    rotation: Array
    pole: Array
    moved_pole: Array

    def carry(self, at: Array) -> Array:
        """Bring a material point to its place, shape (3, n)."""
        return np.asarray(self.moved_pole + np.einsum("ijn,j->in", self.rotation, at - self.pole))


@dataclass(frozen=True)
class _Reading:
    """A reading (n,) and its rate of change with the velocity of the pole and with the rotation about it, (3, n)."""

    value: Array
    force: Array
    moment: Array


def predict(
    transducers: list[Transducer], pose: Pose, side: float, block: Block, outline: Outline, base: Array | None = None
) -> tuple[Array, Array]:
    """
    Readings of transducers for a pose, as changes from rest.

    Parameters
    ----------
    transducers : list of Transducer, length m
    pose : Pose
        Of n samples, relative to the table.
    side : float
        sgn θ of all samples: which pole is the active one.
    block : Block
    outline : Outline
    base : ndarray, shape (3, n), optional
        Displacement of the table relative to the ground, m; by default none.

    Returns
    -------
    readings : ndarray, shape (m, n)
        m, or rad of an angle; NaN where a line of sight misses the specimen.
    columns : ndarray, shape (m, 6, n)
        Their derivatives by the pose, in the order of `UNKNOWNS`.

    Notes
    -----
    Each transducer reacts to a small motion as a force and a moment would do work on it: along its direction at a
    material point, along the wire, or along the normal of the surface n over n·d, whatever slides through the line of
    sight. The columns are that work for the velocity and the angular velocity of each unknown, without approximation.
    """
    turn = rotation_matrix(pose)
    pole = np.array([side * pole_position(block), 0.0, 0.0])
    to_table = pole[:, None] + pole_displacement(pose, side, block)
    to_ground = to_table if base is None else to_table + base
    spins, speeds = _rates(pose, pole[0])
    readings, columns = [], []
    for transducer in transducers:
        carried = _Carried(turn, pole, to_ground if transducer.on_ground else to_table)
        found = _read(transducer, carried, outline)
        readings.append(found.value)
        columns.append(np.einsum("kin,in->kn", speeds, found.force) + np.einsum("kin,in->kn", spins, found.moment))
    return np.array(readings), np.array(columns)


def _rates(pose: Pose, reach: float) -> tuple[Array, Array]:
    """Angular velocity of the specimen and velocity of its active pole for each unknown, shape (6, 3, n)."""
    cosine, sine = np.cos(pose.angle), np.sin(pose.angle)
    upright, leant = np.cos(pose.out_of_plane_angle), np.sin(pose.out_of_plane_angle)
    ahead, turned = np.cos(pose.yaw), np.sin(pose.yaw)
    spins, speeds = np.zeros((2, len(UNKNOWNS), 3, cosine.size))
    spins[0] = -turned * upright, ahead * upright, leant
    spins[2, 0], spins[2, 1] = ahead, turned
    spins[4, 2] = 1.0
    speeds[1, 0] = speeds[3, 1] = speeds[5, 2] = 1.0
    # The transverse slide is that of the base's centre, so that rotations move the pole across.
    speeds[0, 1] = reach * (ahead * leant * cosine - turned * sine)
    speeds[2, 1] = reach * ahead * upright * sine
    speeds[4, 1] = reach * (ahead * cosine - turned * leant * sine)
    return spins, speeds


def _read(transducer: Transducer, carried: _Carried, outline: Outline) -> _Reading:
    at, direction = np.array(transducer.at), np.array(transducer.direction)
    if transducer.sensing == "angle":
        return _angle(direction, carried)
    if transducer.sensing == "wire":
        return _wire(at, direction, np.array(transducer.anchor), carried)
    if transducer.sensing == "point":
        place = carried.carry(at)
        force = np.broadcast_to(direction[:, None], place.shape)
        return _at_place(direction @ (place - at[:, None]), place, force, carried)
    if transducer.normal is not None:
        return _face(at, direction, np.array(transducer.normal), carried)
    return _round_side(at, direction, carried, outline)


def _at_place(value: Array, place: Array, force: Array, carried: _Carried) -> _Reading:
    return _Reading(value, force, np.cross(place - carried.moved_pole, force, axis=0))


def _wire(at: Array, direction: Array, anchor: Array, carried: _Carried) -> _Reading:
    """Change of length, counted positive where the point moves along the direction."""
    place = carried.carry(at)
    span = place - anchor[:, None]
    length = np.sqrt((span**2).sum(axis=0))
    sign = 1.0 if (at - anchor) @ direction >= 0 else -1.0
    return _at_place(sign * (length - np.linalg.norm(at - anchor)), place, sign * span / length, carried)


def _face(at: Array, direction: Array, normal: Array, carried: _Carried) -> _Reading:
    """Way along the fixed line of sight to the moved plane."""
    facing = np.einsum("ijn,j->in", carried.rotation, normal)
    along = direction @ facing
    way = (facing * (carried.carry(at) - at[:, None])).sum(axis=0) / along
    return _at_place(way, at[:, None] + way * direction[:, None], facing / along, carried)


def _round_side(at: Array, direction: Array, carried: _Carried, outline: Outline) -> _Reading:
    """Way along the fixed line of sight to the moved cylinder or cone, in the specimen's own frame."""
    start = np.einsum("jin,jn->in", carried.rotation, at[:, None] - carried.moved_pole) + carried.pole[:, None]
    ray = np.einsum("jin,j->in", carried.rotation, direction)
    hit_at_rest = _way_to_side(at[:, None], direction[:, None], direction, at, outline)[0]
    way, missed = _way_to_side(start, ray, direction, at, outline)
    hit = start + way * ray
    radius = outline.half_width + outline.taper * hit[2]
    facing = np.einsum("ijn,jn->in", carried.rotation, np.array([hit[0], hit[1], -outline.taper * radius]))
    reading = _at_place(
        way - hit_at_rest, at[:, None] + way * direction[:, None], facing / (direction @ facing), carried
    )
    return _Reading(np.where(missed, np.nan, reading.value), reading.force, reading.moment)


def _way_to_side(start: Array, ray: Array, direction: Array, at: Array, outline: Outline) -> tuple[Array, Mask]:
    """Solve x² + y² = (radius at z)² along a ray; the root is the one that faces the same way as at rest."""
    radius = outline.half_width + outline.taper * start[2]
    square = ray[0] ** 2 + ray[1] ** 2 - (outline.taper * ray[2]) ** 2
    half = start[0] * ray[0] + start[1] * ray[1] - outline.taper * radius * ray[2]
    constant = start[0] ** 2 + start[1] ** 2 - radius**2
    rest_radius = outline.half_width + outline.taper * at[2]
    facing = at[0] * direction[0] + at[1] * direction[1] - outline.taper * rest_radius * direction[2]
    discriminant = half**2 - square * constant
    root = np.sqrt(np.maximum(discriminant, (GRAZING * outline.half_width) ** 2))
    return -constant / (half + (root if facing >= 0 else -root)), discriminant < 0


def _angle(axis: Array, carried: _Carried) -> _Reading:
    """Part of the rotation vector along the axis; its rate is that of the inverse left Jacobian of SO(3)."""
    turn = carried.rotation
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    sine = np.sqrt((skew**2).sum(axis=0))
    size = np.arctan2(sine, (np.trace(turn) - 1) / 2)
    small = size < 1e-4
    safe = np.where(small, 1.0, size)
    vector = skew * np.where(small, 1.0, safe / np.where(small, 1.0, sine))
    curvature = np.where(small, 1 / 12, 1 / safe**2 - (1 + np.cos(safe)) / (2 * safe * np.where(small, 1.0, sine)))
    once = np.cross(vector, axis[:, None], axis=0)
    moment = axis[:, None] + once / 2 + curvature * np.cross(vector, once, axis=0)
    return _Reading(axis @ vector, np.zeros_like(vector), moment)
