"""Motion of the specimen from everything that was on it: transducers and gyroscopes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion import inertial
from colonnade.identification.fusion.pose import SpecimenMotion, fit_pose
from colonnade.identification.fusion.sensors import (
    Gyroscope,
    Readings,
    Transducer,
    UnseenRotationError,
    angular_velocity,
)

SEEN = 0.1
"""Part of a gyroscope's axis along y from which on its rate is used for the rocking angle."""

LARGEST_DISAGREEMENT = 3.0
"""Times the noise by which a rate may differ from the change of the angle before it is left out."""

Angle = tuple[Array, Array]
"""θ and its standard error, shape (n,), rad."""


@dataclass(frozen=True)
class Circumstances:
    """
    How a test went.

    Attributes
    ----------
    interval, rest_duration : float
        Between samples, and of the shortest rest, s.
    ends_at_rest : bool
        Whether it ends at rest for sure, or starts so.
    displacement : ndarray, shape (3, n)
        Of the table, m.
    """

    interval: float
    rest_duration: float
    ends_at_rest: bool
    displacement: Array


def specimen_motion(
    positions: Readings[Transducer],
    gyroscopes: Readings[Gyroscope],
    block: Block,
    outline: Outline,
    test: Circumstances,
) -> SpecimenMotion:
    """
    Fuse what the transducers on a specimen read.

    Parameters
    ----------
    positions, gyroscopes : Readings
        Displacement transducers and inclinometers; rates. Either may be empty.
    block : Block
    outline : Outline
    test : Circumstances

    Raises
    ------
    UnseenRotationError
        A ValueError, if nothing sees the rotation.

    Notes
    -----
    Positions are fitted sample by sample. Gyroscopes are integrated, their drift held by that angle or, without one, by
    the rests.
    """
    fitted, refusal = None, UnseenRotationError("No transducer on the specimen measures its rotation")
    if positions.sensors:
        try:
            fitted = fit_pose(
                positions.values, positions.sensors, block, outline, noise=positions.noise, base=test.displacement
            )
        except UnseenRotationError as error:
            refusal = error
    notes = [] if fitted is None else [fitted.separation]
    turning = np.array([abs(each.direction[1]) > SEEN for each in gyroscopes.sensors], dtype=np.bool_)
    found: Angle | None = None
    if turning.any():
        tracked = None
        if fitted is not None:
            # Its error were its noise white.
            kept = min(2 * float(positions.cutoff_hz.min()) * test.interval, 1.0)
            tracked = fitted.angle, fitted.standard_error["rocking_angle"] / np.sqrt(kept)
        found, text = _from_rates(gyroscopes.only(turning), tracked, block, test)
        notes.append(text)
    if fitted is None:
        if found is None:
            raise refusal
        still = np.zeros(test.displacement.shape[1])
        fitted = SpecimenMotion({}, {}, np.full_like(positions.values, np.nan), Pose(*[still] * 6), "")
        if positions.sensors:
            notes.append(f"the displacement transducers are not used: {refusal}")
    values, errors, pose = fitted.values, fitted.standard_error, fitted.pose
    if found is not None:
        values, errors = values | {"rocking_angle": found[0]}, errors | {"rocking_angle": found[1]}
        pose = replace(pose, angle=found[0])
    rates = gyroscopes.values - angular_velocity(gyroscopes.sensors, pose, test.interval)
    residual, separation = np.concatenate((fitted.residual, rates)), "; ".join(notes)
    entered = np.append(np.full(len(positions.sensors), bool(fitted.values)), turning & (found is not None))
    return SpecimenMotion(values, errors, residual, pose, separation, entered, found is not None)


def _from_rates(
    gyroscopes: Readings[Gyroscope], tracked: Angle | None, block: Block, test: Circumstances
) -> tuple[Angle | None, str]:
    """Angle and its error, and what was done; None if the rates contradict what tracks the angle."""
    rate, noise = inertial.mean_rate(gyroscopes.sensors, gyroscopes.values, gyroscopes.noise)
    _, white = inertial.mean_rate(gyroscopes.sensors, gyroscopes.values, gyroscopes.white(test.interval))
    count = "one gyroscope" if len(gyroscopes.sensors) == 1 else f"{len(gyroscopes.sensors)} gyroscopes"
    if tracked is not None:
        factor = inertial.disagreement(rate, white, test.interval, *tracked)
        if factor > LARGEST_DISAGREEMENT:
            text = f"{count} not used: the difference is {factor:.2g} times the noise; check gain, sign and axis"
            return None, text
        found = inertial.angle_from_rate(rate, white, test.interval, *tracked)
        return found, f"{count} combined with them, which remove its drift"
    known, rests = inertial.upright(
        rate, noise, white, test.interval, block, duration=test.rest_duration, from_end=test.ends_at_rest
    )
    where = f"drift removed at {len(rests)} rest{'s' if len(rests) > 1 else ''}"
    if not rests:
        known[-1 if test.ends_at_rest else 0] = 0.0
        where = f"no rest was found, so it is taken as upright at the {'end' if test.ends_at_rest else 'start'}"
    angle, error = inertial.angle_from_rate(rate, white, test.interval, known, np.full(rate.size, inertial.REST_ERROR))
    return (angle, error), (
        f"angle only, from {count}, integrated, {where}: its standard error grows to "
        f"{1e3 * float(error.max()):.2g} mrad; slide and uplift are not measured and are taken as zero"
    )
