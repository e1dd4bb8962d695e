"""Readings of gyroscopes and accelerometers on the moving specimen: rates and specific force in its own axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Vector
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Pose, pole_displacement, pole_position, rotation_matrix


@dataclass(frozen=True)
class Gyroscope:
    """An angular velocity about `direction`, right-handed; it turns with the specimen."""

    direction: Vector


@dataclass(frozen=True)
class Accelerometer:
    """
    An accelerometer on the specimen at `at` (m, specimen frame at rest), along `direction`; it turns with the specimen.

    Notes
    -----
    It senses specific force Rᵀ(a + g ẑ): at rest, gravity upwards.
    """

    direction: Vector
    at: Vector


def specific_force(
    accelerometers: list[Accelerometer], pose: Pose, base: Array, interval: float, block: Block
) -> Array:
    """
    Specific force of accelerometers for a motion, as changes from rest.

    Parameters
    ----------
    accelerometers : list of Accelerometer, length m
    pose : Pose
        Of n samples, smooth enough to be differentiated twice.
    base : ndarray, shape (3, n)
        Acceleration of the table, m/s².
    interval : float
        s.
    block : Block

    Returns
    -------
    readings : ndarray, shape (m, n)
        m/s²; NaN at the first and last sample.

    Notes
    -----
    The place of each accelerometer over time is differentiated twice, which holds every tangential, centripetal and
    sliding part, and turned into the specimen's axes together with gravity.
    """
    side = np.where(pose.angle < 0, -1.0, 1.0)
    turn = rotation_matrix(pose)
    pole = np.zeros((3, side.size))
    pole[0] = side * pole_position(block)
    moved = pole + pole_displacement(pose, side, block)
    readings = []
    for each in accelerometers:
        place = moved + np.einsum("ijn,jn->in", turn, np.array(each.at)[:, None] - pole)
        acceleration = np.full_like(place, np.nan)
        acceleration[:, 1:-1] = np.diff(place, 2, axis=1) / interval**2
        acceleration += base
        acceleration[2] += block.gravity
        sensed = np.einsum("jin,jn->in", turn, acceleration)
        readings.append(np.array(each.direction) @ sensed - block.gravity * each.direction[2])
    return np.array(readings).reshape(len(accelerometers), side.size)


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
