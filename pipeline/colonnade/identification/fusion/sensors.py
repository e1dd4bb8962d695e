"""Sensors on a specimen: what each reads of its pose or motion, and what they separate together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

import numpy as np

from colonnade.arrays import Array, Mask, Vector
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose, pole_displacement, pole_position, rotation_matrix
from colonnade.errors import count
from colonnade.units.text import joined

Kind = TypeVar("Kind", covariant=True)

UNKNOWNS = ("rocking_angle", "slide", "out_of_plane_angle", "transverse_slide", "yaw", "uplift")
"""Of a pose, in the order in which they are looked for."""

GRAZING = 1e-3
"""A line of sight that leaves a round side is followed no further than to this fraction of its radius from the rim."""

LARGEST_AMPLIFICATION = 10.0
"""An unknown is fitted if, together with the others, no standard error grows by more than this factor."""

SIGHT = 0.1
"""Share of a motion, of a rotation times the pole distance, that a transducer has to read in order to see it."""

_ROTATIONS = ("rocking_angle", "out_of_plane_angle", "yaw")
_WORDS = {name: name.replace("_", " ").replace("out of plane", "out-of-plane") for name in UNKNOWNS}
_WORDS["rocking_angle"] = "angle"


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


@dataclass(frozen=True)
class Gyroscope:
    """An angular velocity about `direction`, right-handed; it turns with the specimen."""

    direction: Vector


@dataclass(frozen=True)
class Readings(Generic[Kind]):
    """
    What the sensors of one kind read.

    Attributes
    ----------
    sensors : list of length m
    values : ndarray, shape (m, n)
        Changes from rest, SI; NaN where missing.
    noise, cutoff_hz : ndarray, shape (m,)
        Standard deviation after the low-pass, and its cut-off.
    """

    sensors: list[Kind]
    values: Array
    noise: Array
    cutoff_hz: Array

    def white(self, interval: float) -> Array:
        """Noise of each sample were it white: what integration and smoothing have to count with."""
        return self.noise / np.sqrt(np.minimum(2 * self.cutoff_hz * interval, 1.0))

    def only(self, chosen: Mask) -> Readings[Kind]:
        """Those of some of the sensors."""
        sensors = [each for each, is_chosen in zip(self.sensors, chosen, strict=True) if is_chosen]
        return Readings(sensors, self.values[chosen], self.noise[chosen], self.cutoff_hz[chosen])


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
    for each in transducers:
        moved = to_ground if each.on_ground else to_table
        if each.sensing == "angle":
            reading, moment = _angle(np.array(each.direction), turn)
            work = np.zeros_like(moment[0])
        else:
            reading, place, force = _read(each, turn, pole, moved, outline)
            moment, work = np.cross(place - moved, force, axis=0), np.einsum("kin,in->kn", speeds, force)
        readings.append(reading)
        columns.append(work + np.einsum("kin,in->kn", spins, moment))
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


def _read(
    transducer: Transducer, turn: Array, pole: Array, moved: Array, outline: Outline
) -> tuple[Array, Array, Array]:
    """Reading, the place where it is taken, and its rate with the velocity of that place."""
    at, direction = np.array(transducer.at), np.array(transducer.direction)
    place = moved + np.einsum("ijn,j->in", turn, at - pole)
    if transducer.sensing == "point":
        return direction @ (place - at[:, None]), place, np.broadcast_to(direction[:, None], place.shape)
    if transducer.sensing == "wire":
        # Its change of length, counted positive where the point moves along the direction.
        anchor = np.array(transducer.anchor)
        sign, span = np.copysign(1.0, (at - anchor) @ direction), place - anchor[:, None]
        length = np.sqrt((span**2).sum(axis=0))
        return sign * (length - np.linalg.norm(at - anchor)), place, sign * span / length
    if transducer.normal is not None:
        facing = np.einsum("ijn,j->in", turn, np.array(transducer.normal))
        way = (facing * (place - at[:, None])).sum(axis=0) / (direction @ facing)
        reading = way
    else:
        way, reading, facing = _round_side(at, direction, turn, pole, moved, outline)
    return reading, at[:, None] + way * direction[:, None], facing / (direction @ facing)


def _round_side(
    at: Array, direction: Array, turn: Array, pole: Array, moved: Array, outline: Outline
) -> tuple[Array, Array, Array]:
    """Way along the line of sight to the moved cylinder or cone, the reading (NaN beside it), and the normal there."""
    # In the specimen's own frame.
    start = np.einsum("jin,jn->in", turn, at[:, None] - moved) + pole[:, None]
    ray = np.einsum("jin,j->in", turn, direction)
    way, missed = _way_to_side(start, ray, direction, at, outline)
    hit = start + way * ray
    radius = outline.half_width + outline.taper * hit[2]
    facing = np.einsum("ijn,jn->in", turn, np.array([hit[0], hit[1], -outline.taper * radius]))
    at_rest = _way_to_side(at[:, None], direction[:, None], direction, at, outline)[0]
    return way, np.where(missed, np.nan, way - at_rest), facing


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


def _angle(axis: Array, turn: Array) -> tuple[Array, Array]:
    """Part of the rotation vector along the axis; its rate is that of the inverse left Jacobian of SO(3)."""
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    size = np.arctan2(np.sqrt((skew**2).sum(axis=0)), (np.trace(turn) - 1) / 2)
    vector = skew / np.sinc(size / np.pi)
    half = np.maximum(size, 1e-4) / 2
    curvature = (1 - half / np.tan(half)) / (4 * half**2)
    once = np.cross(vector, axis[:, None], axis=0)
    moment = axis[:, None] + once / 2 + curvature * np.cross(vector, once, axis=0)
    return axis @ vector, moment


def angular_velocity(gyroscopes: list[Gyroscope], pose: Pose, interval: float) -> Array:
    """
    Angular velocity in the specimen's axes for a motion, shape (m, n), rad/s.

    Notes
    -----
    Of R₋ᵀR₊ over two samples, whose skew part is the rotation between them to the second order of the interval.
    """
    turn = rotation_matrix(pose)
    between = np.einsum("jin,jkn->ikn", turn[:, :, :-2], turn[:, :, 2:])
    rate = np.full((3, pose.angle.size), np.nan)
    skew = np.array([between[2, 1] - between[1, 2], between[0, 2] - between[2, 0], between[1, 0] - between[0, 1]])
    rate[:, 1:-1] = skew / (4 * interval)
    return np.array([np.array(each.direction) @ rate for each in gyroscopes]).reshape(len(gyroscopes), pose.angle.size)


class UnseenRotationError(ValueError):
    """The transducers on a specimen do not see its rotation; the message says what would."""


def separate(
    transducers: list[Transducer], sigma: Array, block: Block, outline: Outline
) -> tuple[list[int], Array, str]:
    """
    Decide which unknowns of a pose are fitted.

    Parameters
    ----------
    transducers : list of Transducer, length m
    sigma : ndarray, shape (m,)
        Standard deviations of the readings, m or rad.
    block : Block
    outline : Outline

    Returns
    -------
    fitted : list of int
        Of `UNKNOWNS`, in that order; the rocking angle always.
    designs : ndarray, shape (2, m, k)
        Derivatives of the readings by these at rest, about the pole of θ < 0 and of θ > 0.
    text : str
        What is separated and what is not, for the report.

    Raises
    ------
    UnseenRotationError
        A ValueError, if no transducer measures the rotation about both poles.

    Notes
    -----
    Unknowns are taken one after the other, each where it is seen and the design about either pole keeps all of them
    apart; what is left out counts as zero. Uplift of the pole takes two transducers that look along z: a single one
    with others is a check of the angle rather than a measurement of bounce.
    """
    rest = Pose(*np.zeros((len(UNKNOWNS), 1)))
    designs = np.array([predict(transducers, rest, side, block, outline)[1][..., 0] for side in (-1.0, 1.0)])
    sizes = np.array([block.pole_distance if name in _ROTATIONS else 1.0 for name in UNKNOWNS])
    seen_by = (np.abs(designs) > SIGHT * sizes).any(axis=0).sum(axis=0)
    sides = np.asarray((np.abs(designs[:, :, 0]) > 0).any(axis=1))
    if not sides.all():
        side = f" at θ {'>' if sides[0] else '<'} 0" if sides.any() else ""
        raise UnseenRotationError(
            f"No transducer measures the rotation{side}: each is at the height of the base, points across the plane, "
            "or is on the edge that the specimen rocks about. Add a displacement transducer above the base, with a "
            "direction along x"
        )
    fitted: list[int] = [0]
    mixed: list[int] = []
    for index in (each for each in range(1, len(UNKNOWNS)) if seen_by[each]):
        enough = seen_by[index] > 1 or UNKNOWNS[index] != "uplift"
        is_fitted = enough and is_separated(designs[:, :, [*fitted, index]], sigma)
        (fitted if is_fitted else mixed).append(index)
    unseen = [index for index in range(1, len(UNKNOWNS)) if not seen_by[index]]
    return fitted, designs[:, :, fitted], _text(fitted, mixed, unseen, transducers)


def is_separated(designs: Array, sigma: Array) -> bool:
    """Whether columns (2, m, k) are independent enough about either pole; sigma is infinite of a missing reading."""
    for design in designs / sigma[:, None]:
        lengths = np.sqrt((design**2).sum(axis=0))
        if not lengths.all():
            return False
        scaled = design / lengths
        correlation = scaled.T @ scaled
        is_singular = np.linalg.eigvalsh(correlation)[0] < 1e-9
        if is_singular or np.sqrt(np.linalg.inv(correlation).diagonal().max()) >= LARGEST_AMPLIFICATION:
            return False
    return True


def _text(fitted: list[int], mixed: list[int], unseen: list[int], transducers: list[Transducer]) -> str:
    names, others, missed = ([_WORDS[UNKNOWNS[index]] for index in each] for each in (fitted, mixed, unseen))
    kind = "transducer" if any(each.sensing == "angle" for each in transducers) else "displacement transducer"
    text = f"{joined(names)}{' only' * (len(names) == 1)}, from {count(len(transducers), kind)}"
    if others:
        text += f"; {joined(others)} cannot be separated: taken as zero"
    return f"{text}; no transducer measures {joined(missed, 'or')}" if missed else text
