"""Rocking: conditioned transducers and geometry -> rocking angle, slide, base motion, outcome."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Channel, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, amplitude
from colonnade.errors import StageError
from colonnade.identification.angle import RockingFit, fit_rocking
from colonnade.identification.arcs import find_impacts
from colonnade.identification.outcome import judge
from colonnade.signals.filters import second_derivative
from colonnade.signals.rest import drift
from colonnade.store.variables import variable_name

Array = NDArray[np.float64]

NOISE_FACTOR = 6.0
"""Standard errors of the angle below which a rotation is not told from noise, over records of some 10⁴ samples."""

DRIFT_FACTOR = 1.5
"""A specimen that stands has no angle: what differs between the rests before and after is the transducers' drift."""

LARGEST_DRIFT = 0.02
"""Fraction of α; a specimen that is further off at an end of its record is held tilted, or has overturned."""

ALONG = 0.9
"""Smallest part of a channel's direction along x with which it counts as a record of the motion along x."""


class Transducer(BaseModel):
    """A displacement transducer on the specimen."""

    model_config = ConfigDict(frozen=True)

    at: tuple[float, float, float]
    direction: tuple[float, float, float]
    relative_to: str


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    block : Block
    transducers : dict of str to Transducer
        By the name of their variable.
    accelerations, displacements : dict of str to float
        Table channels along x: variable name to the x-part of their direction.
    catch : float or None
        Angle of the safety frame, rad.
    """

    model_config = ConfigDict(frozen=True)

    block: Block
    transducers: dict[str, Transducer]
    accelerations: dict[str, float]
    displacements: dict[str, float]
    catch: float | None
    free_vibration: bool
    rest_duration: float


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `rocking` reads for one test."""
    setup = campaign.setups[test.setup]
    channels = {variable_name(name): channel for name, channel in setup.channels.items()}
    return Instructions(
        block=campaign.specimens[test.specimen].block(campaign.gravity),
        transducers={
            name: Transducer(at=channel.at, direction=channel.direction, relative_to=channel.relative_to)
            for name, channel in channels.items()
            if channel.on == "specimen" and channel.quantity == "displacement" and channel.sensing == "point"
            if channel.at and channel.direction and channel.relative_to
        },
        accelerations=_table_channels(channels, "acceleration"),
        displacements=_table_channels(channels, "displacement"),
        catch=setup.catch,
        free_vibration=test.kind == "free-vibration",
        rest_duration=campaign.processing.rest_duration,
    )


def _table_channels(channels: Mapping[str, Channel], quantity: str) -> dict[str, float]:
    return {
        name: float(channel.direction[0])
        for name, channel in channels.items()
        if channel.on == "table" and channel.quantity == quantity
        if channel.direction and abs(channel.direction[0]) >= ALONG
    }


def rocking(conditioned: xr.Dataset, instructions: Instructions) -> xr.Dataset:
    """
    Turn conditioned channels into the motion of the specimen and of its base.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: channels in SI on the clock `elapsed`.
    instructions : Instructions

    Returns
    -------
    motion : xr.Dataset
        `rocking_angle` (rad), `slide` (m) where separated, `base_acceleration` (m/s²), `base_displacement` (m),
        `impact_time` (s), scalars of the peak, and the attributes `outcome` and `separation`. Without a transducer on
        the specimen, the base motion alone with an empty outcome.

    Raises
    ------
    StageError
        If nothing of the test is usable, or ground-relative transducers lack the table's displacement.
    """
    warnings: list[str] = []
    time = conditioned["elapsed"].to_numpy()
    base = _base_motion(conditioned, instructions, warnings)
    used = [name for name in instructions.transducers if name in conditioned]
    fit = _fit(conditioned, instructions, used, base, warnings) if used else None
    if fit is None and "base_acceleration" not in base:
        raise StageError(
            "Neither a displacement transducer on the specimen nor a table channel along x is usable in this test; "
            "at least one of the two was expected. See the warnings of the stages before, and the set-up's channels."
        )

    variables: dict[str, Any] = {name: ("elapsed", values) for name, values in base.items()}
    acceleration = base.get("base_acceleration")
    peak_acceleration = np.nan if acceleration is None else float(np.nanmax(np.abs(acceleration)))
    variables["peak_ground_acceleration"] = ((), peak_acceleration)
    attributes = {"outcome": "", "separation": "no displacement transducer on the specimen", "warnings": warnings}
    if fit is not None:
        variables |= _angle_variables(time, fit, conditioned, used, instructions, attributes)
    return xr.Dataset(variables, coords={"elapsed": ("elapsed", time)}, attrs=attributes)


def _base_motion(conditioned: xr.Dataset, instructions: Instructions, warnings: list[str]) -> dict[str, Array]:
    """Average the table's channels along x; without an accelerometer, differentiate its displacement twice."""
    base: dict[str, Array] = {}
    for target, channels in (
        ("base_acceleration", instructions.accelerations),
        ("base_displacement", instructions.displacements),
    ):
        values = [conditioned[name].to_numpy() / part for name, part in channels.items() if name in conditioned]
        if values:
            base[target] = np.mean(values, axis=0)
    if "base_acceleration" not in base and "base_displacement" in base:
        interval = float(np.diff(conditioned["elapsed"].to_numpy()[:2])[0])
        cutoff = min(
            float(conditioned[name].attrs["cutoff_hz"]) for name in instructions.displacements if name in conditioned
        )
        base["base_acceleration"] = second_derivative(base["base_displacement"], interval, cutoff)
        warnings.append(
            "The base acceleration is the second derivative of the table's displacement, as no table accelerometer "
            f"is usable: nothing above {cutoff:.3g} Hz is in it."
        )
    return base


def _fit(
    conditioned: xr.Dataset,
    instructions: Instructions,
    used: list[str],
    base: Mapping[str, Array],
    warnings: list[str],
) -> RockingFit:
    readings = []
    for name in used:
        reading, transducer = conditioned[name].to_numpy(), instructions.transducers[name]
        if transducer.relative_to == "ground":
            if "base_displacement" in base:
                reading = reading - transducer.direction[0] * base["base_displacement"]
            elif not instructions.free_vibration:
                raise StageError(
                    f"channel {conditioned[name].attrs['channel']} measures relative to the ground, and none gives "
                    "the table's displacement along x; one was expected, so that it can be taken off. Add it to the "
                    'set-up (on = "table", quantity = "displacement"), or say relative_to = "table" if that is so.'
                )
        readings.append(reading)
    missing = sorted(set(instructions.transducers) - set(used))
    if missing:
        warnings.append(f"The angle is from {', '.join(used)} alone; {', '.join(missing)} could not be used.")
    transducers = [instructions.transducers[name] for name in used]
    noise = [max(float(conditioned[name].attrs.get("noise", 0.0)), 1e-9) for name in used]
    try:
        return fit_rocking(
            np.array(readings),
            [transducer.at for transducer in transducers],
            [transducer.direction for transducer in transducers],
            instructions.block,
            noise=noise,
        )
    except ValueError as error:
        raise StageError(f"{error} (channels {', '.join(used)}).") from error


def _angle_variables(
    time: Array,
    fit: RockingFit,
    conditioned: xr.Dataset,
    used: list[str],
    instructions: Instructions,
    attributes: dict[str, Any],
) -> dict[str, Any]:
    block = instructions.block
    drifted = drift(time, fit.angle, duration=instructions.rest_duration, noise=fit.standard_error)
    if drifted > LARGEST_DRIFT * block.critical_angle:
        drifted = 0.0
    indistinct = NOISE_FACTOR * fit.standard_error + DRIFT_FACTOR * drifted
    threshold = max(indistinct, NO_ROCKING_RATIO * block.critical_angle)
    verdict = judge(time, fit.angle, block, threshold=threshold, catch=instructions.catch)
    attributes |= {"outcome": verdict.outcome, "separation": fit.separation}
    standing = time <= verdict.overturning_time if np.isfinite(verdict.overturning_time) else np.isfinite(time)
    ratio = np.where(standing & np.isfinite(fit.angle), amplitude(fit.angle, block), -1.0)
    peak = int(np.argmax(ratio))
    quality = np.max([conditioned[f"{name}_quality"].to_numpy() for name in used], axis=0)
    variables: dict[str, Any] = {
        "rocking_angle": ("elapsed", fit.angle),
        "rocking_angle_quality": ("elapsed", quality.astype(np.int8)),
        "rocking_angle_standard_error": ((), float(np.hypot(fit.standard_error, drifted / np.sqrt(3)))),
        "impact_time": ("impact", find_impacts(time[standing], fit.angle[standing], lowest=threshold)),
        "peak_angle": ((), float(fit.angle[peak])),
        "peak_ratio": ((), np.nan if verdict.outcome == "overturned" else float(ratio[peak])),
        "peak_time": ((), float(time[peak])),
        "overturning_time": ((), verdict.overturning_time),
        "noise_threshold": ((), threshold),
    }
    if fit.slide is not None:
        variables["slide"] = ("elapsed", fit.slide)
    return variables
