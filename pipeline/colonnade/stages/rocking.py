"""Rocking: conditioned transducers and geometry -> motion of the specimen, base motion, outcome."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.errors import StageError
from colonnade.findings import Finding, serious, warning
from colonnade.identification.fusion.motion import SEEN, Circumstances, specimen_motion
from colonnade.identification.fusion.pose import SpecimenMotion
from colonnade.identification.fusion.sensors import UnseenRotationError
from colonnade.identification.response.outcome import angle_features, ending
from colonnade.signals.quality import Flag
from colonnade.signals.samples import stretches
from colonnade.stages.parts.bodies import AssemblyInputs, measure, measured_variables, together
from colonnade.stages.parts.transducers import (
    LEAST_NOISE,
    SeenInputs,
    axes,
    base_motion,
    misplaced,
    readings,
)

if TYPE_CHECKING:
    import xarray as xr


STRONG = 0.5
"""Of the recorded peak; missing samples next to as much may hold a larger one."""

NEARBY = 0.5
"""s, on either side of missing samples, of motion that they may go on with; as long as they last, if that is longer."""

LEAST_RISE = 0.02
"""Of the peak; what the block cannot rise by within missing samples is not worth a word."""


class RockingInputs(SeenInputs):
    """
    What `rocking` reads of the campaign.

    Attributes
    ----------
    catch : float or None
        Angle of the safety frame, rad.
    assembly : AssemblyInputs or None
        Of several bodies; the others then describe the one block as which they rock together.
    """

    catch: float | None
    assembly: AssemblyInputs | None = None
    free_vibration: bool
    rest_duration: float

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> RockingInputs:
        """Gather what `rocking` reads for one test."""
        return cls(
            **cls.seen(campaign, test),
            catch=campaign.setups[test.setup].catch,
            assembly=AssemblyInputs.of(campaign, test),
            free_vibration=test.kind == "free-vibration",
            rest_duration=campaign.processing.rest_duration,
        )


def rocking(conditioned: xr.Dataset, inputs: RockingInputs) -> xr.Dataset:
    """
    Turn conditioned channels into the motion of the specimen and of its base.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: channels in SI on the clock `elapsed`.
    inputs : RockingInputs

    Returns
    -------
    motion : xr.Dataset
        `rocking_angle` (rad); where separated `slide`, `uplift`, `transverse_slide` (m), `out_of_plane_angle` and `yaw`
        (rad), each with the median of its standard error; `angle_deviation` (rad) where the error is one of history;
        `base_acceleration` (m/s²), `base_displacement` (m) and their like along y and z; `impact_time` (s), scalars of
        the peak, residuals by transducer, and the attributes `outcome` and `separation`. Of an assembly these are of
        the one block as which its bodies rock together, and the same by `body` of each: its motion relative to the
        table, its angle in the joint below, how far and when that opened, what is left at the end. Without a
        transducer on the specimen, the base motion alone with an empty outcome.

    Raises
    ------
    StageError
        If nothing of the test is usable, or ground-relative transducers lack the table's displacement. Transducers
        that do not see the rotation give only a warning if the base motion is known, as a prediction needs no more.
    """
    import xarray as xr

    warnings: list[Finding] = []
    time = conditioned["elapsed"].to_numpy()
    base = base_motion(conditioned, inputs.transducers, warnings)
    used = [name for name in inputs.transducers.on_specimen if name in conditioned]
    motion, separation = None, "no transducer on the specimen"
    try:
        motion = _motion(conditioned, inputs, used, base, warnings) if used else None
    except UnseenRotationError as error:
        separation = f"{error} (channels {', '.join(used)})."
        if "base_acceleration" not in base:
            raise StageError(separation) from error
        text = f"No rocking angle is measured: {separation} Predictions continue with the base motion."
        warnings.append(warning("no rocking angle", text, follows=("channel left out", "dead channel")))
    if motion is None and "base_acceleration" not in base:
        raise StageError(
            "Neither a transducer on the specimen nor a table channel along x is usable in this test; at least one of "
            "the two is needed. See the warnings of the earlier stages, and the set-up's channels."
        )

    bodies = None
    if inputs.assembly is not None:
        warnings += misplaced(conditioned, inputs.assembly.markers, inputs.assembly.assembly)
        bodies = measure(conditioned, inputs.assembly, _circumstances(time, inputs, base))
        motion = together(motion, bodies, inputs.assembly)
    variables: dict[str, Any] = {name: ("elapsed", values) for name, values in base.items()}
    acceleration = base.get("base_acceleration")
    variables["peak_ground_acceleration"] = np.nan
    if acceleration is not None:
        variables["peak_ground_acceleration"] = float(np.nanmax(np.abs(acceleration)))
    attributes = {"outcome": "", "separation": separation, "warnings": warnings}
    if motion is not None:
        variables |= _motion_variables(time, motion, acceleration, inputs, attributes)
        variables |= _of_transducers(conditioned, motion, used)
        warnings += [] if inputs.free_vibration else _hidden_peak(time, motion.angle, inputs.block)
    if inputs.assembly is not None and bodies is not None:
        described, outcome = measured_variables(time, bodies, inputs.assembly, warnings)
        variables |= described
        attributes["outcome"] = outcome or attributes["outcome"]
    return xr.Dataset(variables, coords={"elapsed": ("elapsed", time)}, attrs=attributes)


def _hidden_peak(time: Array, angle: Array, block: Block) -> list[Finding]:
    """Report missing samples next to strong motion, in which the block has time to rise above the recorded peak."""
    interval, size = float(time[1] - time[0]), np.abs(angle)
    peak = float(np.nanmax(size))
    for start, stop in zip(*stretches(np.isnan(angle)), strict=True):
        duration = (stop - start) * interval
        reach = max(stop - start, round(NEARBY / interval))
        near = float(np.nanmax(size[max(start - reach, 0) : stop + reach], initial=0.0))
        # Standing up, the block turns back with p² α.
        rise = block.critical_angle * (block.p * duration) ** 2 / 8
        if near >= STRONG * peak and rise > LEAST_RISE * peak and peak < block.critical_angle:
            text = (
                f"The rocking angle is missing for {duration:.3g} s from {time[start]:.4g} s on, next to motion of "
                f"{near / block.critical_angle:.3g} α: the peak of {peak / block.critical_angle:.3g} α may be too "
                "small. Repair the raw file, or repeat the test."
            )
            return [serious("missing samples", text)]
    return []


def _motion(
    conditioned: xr.Dataset,
    inputs: RockingInputs,
    used: list[str],
    base: Mapping[str, Array],
    warnings: list[Finding],
) -> SpecimenMotion:
    known = inputs.transducers
    missing = sorted(set(known.on_specimen) - set(used))
    if missing:
        text = f"The angle is only from {', '.join(used)}; {', '.join(missing)} could not be used."
        warnings.append(warning("fewer transducers", text, follows=("channel left out", "dead channel")))
    on_ground = [name for name in used if name in known.positions and known.positions[name].on_ground]
    if on_ground and "base_displacement" not in base and not inputs.free_vibration:
        raise StageError(
            f"channel {conditioned[on_ground[0]].attrs['channel']} measures relative to the ground, but no channel "
            "gives the table's displacement along x, which has to be subtracted. Add it to the set-up "
            '(on = "table", quantity = "displacement"), or write relative_to = "table" if the transducer is fixed to '
            "the table."
        )
    motion = specimen_motion(
        readings(conditioned, known.positions),
        readings(conditioned, known.gyroscopes),
        inputs.block,
        inputs.outline,
        _circumstances(conditioned["elapsed"].to_numpy(), inputs, base),
    )
    turning = {name for name, each in known.gyroscopes.items() if abs(each.direction[1]) > SEEN}
    left_out = [name for name, enters in zip(used, motion.entered, strict=True) if name in turning and not enters]
    if left_out:
        several = "s" if len(left_out) > 1 else ""
        text = (
            f"The angle is not from gyroscope{several} {', '.join(left_out)}: the displacement transducers contradict. "
            "Check gain, sign and axis (`direction`)."
        )
        warnings.append(warning("fewer transducers", text))
    return motion


def _circumstances(time: Array, inputs: RockingInputs, base: Mapping[str, Array]) -> Circumstances:
    return Circumstances(
        float(time[1] - time[0]),
        inputs.rest_duration,
        ends_at_rest=inputs.free_vibration,
        displacement=axes(base, "displacement", time),
    )


def _motion_variables(
    time: Array, motion: SpecimenMotion, acceleration: Array | None, inputs: RockingInputs, attributes: dict[str, Any]
) -> dict[str, Any]:
    median = {name: float(np.nanmedian(errors)) for name, errors in motion.standard_error.items()}
    error, rest = median["rocking_angle"], inputs.rest_duration
    found = angle_features(time, motion.angle, error, inputs.block, rest_duration=rest, catch=inputs.catch)
    attributes |= {"outcome": found.verdict.outcome, "separation": motion.separation}
    moved = None if inputs.free_vibration else acceleration
    ended = ending(time, motion.angle, moved, found.verdict, inputs.block, error=error, duration=rest)
    # Bodies that slid on each other leave the one block leaning.
    attributes["warnings"] += [ended] if ended and inputs.assembly is None else []
    variables: dict[str, Any] = {f"{name}_standard_error": error for name, error in median.items()}
    variables |= {name: ("elapsed", values) for name, values in motion.values.items()}
    if motion.is_integrated:
        variables["angle_deviation"] = ("elapsed", motion.standard_error["rocking_angle"])
    return variables | {
        "rocking_angle_standard_error": found.standard_error,
        "rocking_angle_drift": found.drift,
        "impact_time": ("impact", found.impact_times),
        "peak_angle": found.peak_angle,
        "peak_ratio": found.peak_ratio,
        "peak_time": found.peak_time,
        "overturning_time": found.verdict.overturning_time,
        "noise_threshold": found.threshold,
    }


def _of_transducers(conditioned: xr.Dataset, motion: SpecimenMotion, used: list[str]) -> dict[str, Any]:
    """
    The angle with its low-pass, its flags and the residuals.

    Flags are the worst of its transducers, suspect if one is missing but others are there. The low-pass is that of its
    transducers, if they share one and nothing else smoothed the angle.
    """
    entered = [name for name, counts in zip(used, motion.entered, strict=True) if counts]
    cutoffs = {float(conditioned[name].attrs.get("cutoff_hz", np.nan)) for name in entered}
    is_shared = not motion.is_integrated and len(cutoffs) == 1 and np.isfinite(min(cutoffs))
    flags = np.max([conditioned[f"{name}_quality"].to_numpy() for name in entered], axis=0).astype(np.int8)
    others = np.isfinite(motion.angle) & (flags == Flag.MISSING)
    moved = np.array([float(np.nanstd(conditioned[name].to_numpy())) for name in used])
    noise = np.array([max(float(conditioned[name].attrs.get("noise", 0.0)), LEAST_NOISE) for name in used])
    return {
        "rocking_angle": ("elapsed", motion.angle, {"cutoff_hz": min(cutoffs)} if is_shared else {}),
        "rocking_angle_quality": ("elapsed", np.where(others, np.int8(Flag.SUSPECT), flags)),
        "transducer": ("transducer", [str(conditioned[name].attrs.get("channel", name)) for name in used]),
        "residual_to_noise": ("transducer", motion.residual_size / noise),
        "residual_to_reading": ("transducer", motion.residual_size / np.maximum(moved, 1e-300)),
    }
