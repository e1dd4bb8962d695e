"""Motion of the specimen from everything that was on it: transducers, gyroscopes, accelerometers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.accelerometers import angle_from_accelerations
from colonnade.identification.fusion.gyroscopes import REST_ERROR, angle_from_rate, disagreement, mean_rate, upright
from colonnade.identification.fusion.inertial import Accelerometer, Gyroscope, angular_velocity, specific_force
from colonnade.identification.fusion.pose import PoseFit, fit_pose
from colonnade.identification.fusion.readings import Circumstances, Readings, TableReadings
from colonnade.identification.fusion.sensors import Transducer
from colonnade.identification.fusion.separation import UnseenRotationError

SEEN = 0.1
"""Part of a gyroscope's axis along y from which on its rate is used for the rocking angle."""

LARGEST_DISAGREEMENT = 3.0
"""Times the noise by which a rate may differ from the change of the angle before it is left out."""

UNSEEN = "slide and uplift are not measured and are taken as zero"


@dataclass(frozen=True)
class SpecimenMotion:
    """
    Motion of the specimen with its errors.

    Attributes
    ----------
    values, standard_error : dict of str to ndarray, shape (n,)
        As of `PoseFit`; rad and m.
    residual : ndarray, shape (m,)
        Root mean square of reading less prediction of every transducer: positions, gyroscopes, accelerometers; SI, NaN
        without a prediction.
    entered : ndarray of bool, shape (m,)
        Whether the angle is from it; the others are compared with what the motion predicts for them.
    separation : str
        What the set-up separates, for the report.
    is_integrated : bool
        Whether the angle is integrated, so that its error has a history of its own.
    """

    values: dict[str, Array]
    standard_error: dict[str, Array]
    residual: Array
    entered: Mask
    separation: str
    is_integrated: bool

    @property
    def angle(self) -> Array:
        """θ, rad, shape (n,)."""
        return self.values["rocking_angle"]


def specimen_motion(
    positions: tuple[list[Transducer], Readings],
    gyroscopes: tuple[list[Gyroscope], Readings],
    accelerometers: tuple[list[Accelerometer], Readings],
    table: TableReadings,
    block: Block,
    outline: Outline,
    circumstances: Circumstances,
) -> SpecimenMotion:
    """
    Fuse what the transducers on a specimen read.

    Parameters
    ----------
    positions, gyroscopes, accelerometers : (list of length m, Readings)
        Displacement transducers and inclinometers; rates; specific forces. Any of the three may be empty.
    table : TableReadings
    block : Block
    outline : Outline
    circumstances : Circumstances

    Returns
    -------
    motion : SpecimenMotion

    Raises
    ------
    UnseenRotationError
        A ValueError, if nothing sees the rotation.

    Notes
    -----
    Positions are fitted sample by sample. Gyroscopes are integrated, their drift held by that angle or, without one, by
    the rests. Accelerometers give the angle if nothing else does; otherwise they are compared with it.
    """
    interval = circumstances.interval
    fit, refusal = _fitted(positions, table, block, outline)
    values, errors, notes = (
        ({}, {}, []) if fit is None else (dict(fit.values), dict(fit.standard_error), [fit.separation])
    )
    entered = [np.full(len(each[0]), False) for each in (positions, gyroscopes, accelerometers)]
    entered[0][:] = fit is not None
    turning = np.array([abs(each.direction[1]) > SEEN for each in gyroscopes[0]], dtype=np.bool_)
    found = None
    if turning.any():
        tracked = None if fit is None else _tracked(fit, positions[1], interval)
        found, text = _with_rates(gyroscopes, turning, tracked, block, circumstances)
        entered[1][:] = turning & (found is not None)
        notes.append(text)
    elif fit is None and accelerometers[0]:
        found, text = _from_accelerometers(*accelerometers, table, block, circumstances)
        entered[2][:] = True
        notes.append(text)
    if found is not None:
        values["rocking_angle"], errors["rocking_angle"] = found
    if not values:
        raise refusal or UnseenRotationError("No transducer on the specimen measures its rotation")
    if refusal is not None:
        notes.append(f"the displacement transducers are not used: {refusal}")
    pose = replace(
        fit.pose if fit else Pose(*np.zeros((6, values["rocking_angle"].size))), angle=values["rocking_angle"]
    )
    misfit = np.full_like(positions[1].values, np.nan) if fit is None else fit.residual
    residual = np.concatenate((misfit, _compared(gyroscopes, accelerometers, pose, table, block, interval)))
    return SpecimenMotion(
        values, errors, _root_mean_square(residual), np.concatenate(entered), "; ".join(notes), found is not None
    )


def _fitted(
    positions: tuple[list[Transducer], Readings], table: TableReadings, block: Block, outline: Outline
) -> tuple[PoseFit | None, UnseenRotationError | None]:
    """Fit of the positions, or why they give none."""
    transducers, readings = positions
    if not transducers:
        return None, None
    try:
        fit = fit_pose(
            readings.values, transducers, block, noise=readings.noise, outline=outline, base=table.displacement
        )
    except UnseenRotationError as error:
        return None, error
    return fit, None


def _tracked(fit: PoseFit, positions: Readings, interval: float) -> tuple[Array, Array]:
    """Angle of the positions and its error were their noise white."""
    widening = 1 / np.sqrt(np.minimum(2 * float(positions.cutoff_hz.min()) * interval, 1.0))
    return fit.angle, fit.standard_error["rocking_angle"] * widening


def _with_rates(
    gyroscopes: tuple[list[Gyroscope], Readings],
    turning: Mask,
    tracked: tuple[Array, Array] | None,
    block: Block,
    circumstances: Circumstances,
) -> tuple[tuple[Array, Array] | None, str]:
    """Angle and its error, and what was done; None if the rates contradict what tracks the angle."""
    chosen = [each for each, turns in zip(gyroscopes[0], turning, strict=True) if turns]
    given = gyroscopes[1]
    readings = Readings(given.values[turning], given.noise[turning], given.cutoff_hz[turning])
    interval = circumstances.interval
    rate, noise = mean_rate(chosen, readings.values, readings.noise)
    white = mean_rate(chosen, readings.values, readings.white(interval))[1]
    count = "one gyroscope" if len(chosen) == 1 else f"{len(chosen)} gyroscopes"
    if tracked is not None:
        factor = disagreement(rate, white, interval, *tracked)
        if factor > LARGEST_DISAGREEMENT:
            return (
                None,
                f"{count} not used: the difference is {factor:.2g} times the noise; check gain, sign and axis",
            )
        return angle_from_rate(rate, white, interval, *tracked), f"{count} combined with them, which remove its drift"
    known, rests = upright(
        rate,
        noise,
        white,
        interval,
        block,
        duration=circumstances.rest_duration,
        from_end=circumstances.ends_at_rest,
    )
    where = f"drift removed at {len(rests)} rest{'s' if len(rests) > 1 else ''}"
    if not rests:
        known[-1 if circumstances.ends_at_rest else 0] = 0.0
        where = (
            f"no rest was found, so it is taken as upright at the {'end' if circumstances.ends_at_rest else 'start'}"
        )
    angle, error = angle_from_rate(rate, white, interval, known, np.full(rate.size, REST_ERROR))
    grown = f"its standard error grows to {1e3 * float(error.max()):.2g} mrad"
    return (angle, error), f"angle only, from {count}, integrated, {where}: {grown}; {UNSEEN}"


def _from_accelerometers(
    accelerometers: list[Accelerometer],
    readings: Readings,
    table: TableReadings,
    block: Block,
    circumstances: Circumstances,
) -> tuple[tuple[Array, Array], str]:
    if table.acceleration is None:
        raise UnseenRotationError(
            "Only accelerometers are on the specimen, and the table's acceleration is not known. Without it gravity "
            "cannot be separated from the table's motion. Add a table channel along x"
        )
    found = angle_from_accelerations(
        accelerometers,
        readings.values,
        readings.white(circumstances.interval),
        table.acceleration,
        circumstances.interval,
        block,
    )
    if found is None:
        raise UnseenRotationError(
            "Only accelerometers are on the specimen, and they do not separate its rotation from its translation. "
            "Place two along x at different heights"
        )
    text = f"angle only, from {len(accelerometers)} accelerometers: differences for the rotation, gravity for the tilt"
    return found, f"{text}; slide cannot be separated from tilt and is taken as zero"


def _compared(
    gyroscopes: tuple[list[Gyroscope], Readings],
    accelerometers: tuple[list[Accelerometer], Readings],
    pose: Pose,
    table: TableReadings,
    block: Block,
    interval: float,
) -> Array:
    """Readings of rates and accelerometers less what the motion predicts, shape (m, n)."""
    rates = gyroscopes[1].values - angular_velocity(gyroscopes[0], pose, interval)
    if table.acceleration is None:
        return np.concatenate((rates, np.full_like(accelerometers[1].values, np.nan)))
    forces = specific_force(accelerometers[0], pose, table.acceleration, interval, block)
    return np.concatenate((rates, accelerometers[1].values - forces))


def _root_mean_square(residual: Array) -> Array:
    known = np.isfinite(residual)
    squares = np.where(known, residual, 0.0) ** 2
    with np.errstate(invalid="ignore"):
        return np.asarray(np.sqrt(squares.sum(axis=1) / known.sum(axis=1)))
