"""Rocking angle from accelerometers alone: their differences turned twice into an angle, held by gravity."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import pole_position
from colonnade.identification.fusion.inertial import Accelerometer
from colonnade.identification.fusion.smoother import smooth

LARGEST_AMPLIFICATION = 10.0
"""Rotation is taken from accelerometers where it costs this factor in the error of the mean, over the pole distance."""

PASSES = 3
"""Of the angle from accelerometers: the second has centripetal accelerations, the third the errors that it leaves."""

LARGEST_BIAS = 0.1
"""rad/s²: standard deviation of the angular acceleration that accelerometers show at rest, before it is known."""

LARGEST_RATE = 10.0
"""rad/s: standard deviation of a specimen's angular velocity, before anything is known of it."""


def angle_from_accelerations(
    accelerometers: list[Accelerometer],
    readings: Array,
    sigma: Array,
    base: Array,
    interval: float,
    block: Block,
) -> tuple[Array, Array] | None:
    """
    Angle of a specimen that has accelerometers only.

    Parameters
    ----------
    accelerometers : list of Accelerometer, length m
    readings : ndarray, shape (m, n)
        Specific force less gravity at rest, m/s²; a sample that any of them misses is bridged.
    sigma : ndarray, shape (m,)
        Standard deviations were they white, m/s².
    base : ndarray, shape (3, n)
        Acceleration of the table, m/s².
    interval : float
        s.
    block : Block

    Returns
    -------
    angle, standard_error : ndarray, shape (n,), or None
        rad; None if the accelerometers do not separate rotation from translation.

    Notes
    -----
    In the specimen's axes each reads d·A + θ̈ (z dₓ − x d_z) − θ̇² (x dₓ + z d_z), with A the specific force at the
    centre of its base. Differences give θ̈; what is left along x, a cos θ − g sin θ where the pole stays on the table,
    gives the tilt. θ̈ is integrated twice, and held by the tilt. A slide reads as tilt and is not separated from it.
    """
    directions = np.array([each.direction for each in accelerometers])
    places = np.array([each.at for each in accelerometers])
    columns = np.column_stack(
        (directions[:, 0], directions[:, 2], places[:, 2] * directions[:, 0] - places[:, 0] * directions[:, 2])
    )
    solving = _solving(columns, sigma, block)
    if solving is None:
        return None
    errors = np.sqrt((solving**2 * sigma**2).sum(axis=1))
    missing = np.asarray(np.isnan(readings).any(axis=0))
    pull = (places[:, [0, 2]] * directions[:, [0, 2]]).sum(axis=1)[:, None]
    states = np.zeros((missing.size, 3))
    deviations = np.zeros_like(states)
    tilt_error = float(errors[0]) / block.gravity
    for _ in range(PASSES):
        squared = states[:, 1] ** 2
        along, _, angular = solving @ np.nan_to_num(readings + squared * pull)
        along = along - squared * np.sign(states[:, 0]) * pole_position(block)
        tilt = np.arctan2(base[0], block.gravity) - np.arcsin(
            np.clip(along / np.hypot(base[0], block.gravity), -1.0, 1.0)
        )
        tilt[missing] = np.nan
        states, deviations = _from_angular(angular, float(errors[2]), missing, tilt, tilt_error, interval)
        scatter = float(np.sqrt(np.nanmean((tilt - states[:, 0]) ** 2)))
        tilt_error = max(tilt_error, scatter)
    return states[:, 0], deviations[:, 0]


def _solving(columns: Array, sigma: Array, block: Block) -> Array | None:
    """Matrix (3, m) from readings to A along x and z and θ̈; None if θ̈ and A along x are not separated."""
    present = [index for index in range(3) if np.abs(columns[:, index]).max() > 1e-9]
    if 0 not in present or 2 not in present:
        return None
    weighted = columns[:, present] / sigma[:, None]
    if np.linalg.matrix_rank(weighted, tol=1e-9 * float(np.abs(weighted).max())) < len(present):
        return None
    solving = np.zeros((3, sigma.size))
    solving[present] = np.linalg.pinv(weighted) / sigma
    error = float(np.sqrt((solving[2] ** 2 * sigma**2).sum()))
    alone = 1 / float(np.sqrt((1 / sigma**2).sum()))
    return solving if error * block.pole_distance < LARGEST_AMPLIFICATION * alone else None


def _from_angular(
    angular: Array, noise: float, missing: Mask, tilt: Array, tilt_error: float, interval: float
) -> tuple[Array, Array]:
    """Angle, rate and bias of θ̈ from θ̈ and the tilt."""
    middle = np.append((angular[1:] + angular[:-1]) / 2, 0.0)
    push = np.array([interval**2 / 2, interval, 0.0])
    deviation = np.where(missing, max(float(angular.std()), noise), noise)
    process = deviation[:, None, None] ** 2 * np.outer(push, push)
    readings, variances = np.zeros((tilt.size, 3)), np.full((tilt.size, 3), np.inf)
    known = np.isfinite(tilt)
    readings[known, 0], variances[known, 0] = tilt[known], tilt_error**2
    transition = np.array([[1.0, interval, interval**2 / 2], [0.0, 1.0, interval], [0.0, 0.0, 1.0]])
    start = np.array([np.pi, LARGEST_RATE, LARGEST_BIAS]) ** 2
    return smooth(transition, middle[:, None] * push, process, readings, variances, start)
