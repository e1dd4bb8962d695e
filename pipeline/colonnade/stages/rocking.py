"""Rocking: conditioned transducers and geometry -> motion of the specimen, base motion, outcome."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from colonnade.arrays import Array, Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.identification.fusion.motion import SEEN, Circumstances, specimen_motion
from colonnade.identification.fusion.pose import SpecimenMotion
from colonnade.identification.fusion.sensors import UnseenRotationError
from colonnade.identification.response.outcome import angle_features, ending
from colonnade.stages.parts.bodies import AssemblyInputs, measure, measured_variables, misplaced, together
from colonnade.stages.parts.transducers import (
    LEAST_NOISE,
    SeenInputs,
    along,
    axes,
    base_motion,
    outline,
    readings,
    transducers,
)

PARTS = 4
"""Of the stretch where zero is taken; how far their means are from that of the stretch is the error of the zero."""

SERIOUS = 10.0
"""Times the largest error that is not reported, from which on results are wrong."""


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
        specimen = campaign.specimens[test.specimen]
        block = specimen.block(campaign.gravity)
        return cls(
            block=block,
            outline=outline(specimen, block),
            transducers=transducers(campaign.channels(test)),
            catch=campaign.setups[test.setup].catch,
            assembly=AssemblyInputs.of(campaign, test),
            free_vibration=test.kind == "free-vibration",
            rest_duration=campaign.processing.rest_duration,
        )


def rocking(conditioned: Dataset, inputs: RockingInputs) -> Dataset:
    """
    Turn conditioned channels into the motion of the specimen and of its base.

    Parameters
    ----------
    conditioned : Dataset
        Result of `condition`: channels in SI on the clock `elapsed`.
    inputs : RockingInputs

    Returns
    -------
    motion : Dataset
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
    warnings: list[Finding] = []
    time = conditioned["elapsed"].to_numpy()
    base = base_motion(conditioned, inputs.transducers, warnings)
    used = [name for name in inputs.transducers.on_specimen if name in conditioned]
    motion, separation = None, "no transducer on the specimen"
    try:
        motion = _motion(conditioned, inputs, used, base, warnings) if used else None
    except UnseenRotationError as error:
        separation = f"{error} (channels {', '.join(used)})."
        text = f"No rocking angle is measured: {separation} Predictions continue with the base motion."
        warnings.append(warning("no rocking angle", text, follows=("channel left out", "dead channel")))
    if motion is None and "base_acceleration" not in base:
        raise StageError(
            "Neither a transducer on the specimen nor a table channel along x is usable in this test; at least one of "
            f"the two is needed ({separation}). See the warnings of the earlier stages, and the set-up's channels."
        )

    bodies = None
    if inputs.assembly is not None:
        warnings += misplaced(conditioned, inputs.assembly)
        bodies = measure(conditioned, inputs.assembly, _circumstances(time, inputs, base))
        motion = together(motion, bodies, inputs.assembly)
    variables: dict[str, Any] = {name: ("elapsed", values) for name, values in base.items()}
    acceleration = base.get("base_acceleration")
    table = [conditioned[name].attrs for name in along(inputs.transducers.accelerations, 0) if name in conditioned]
    if acceleration is not None and table:
        # Of the mean of the accelerometers.
        noise = float(np.linalg.norm([each["noise"] for each in table])) / len(table)
        known = {"noise": noise, "cutoff_hz": min(each["cutoff_hz"] for each in table)}
        variables["base_acceleration"] = "elapsed", acceleration, known
    variables["peak_ground_acceleration"] = np.nan if acceleration is None else float(np.nanmax(np.abs(acceleration)))
    warnings += _uncertain_zeros(conditioned, None if motion is None else motion.angle, acceleration, inputs.block)
    attributes = {"outcome": "", "separation": separation, "warnings": warnings}
    if motion is not None:
        variables |= _motion_variables(time, motion, acceleration, inputs, attributes)
        variables |= _of_transducers(conditioned, motion, used)
    if inputs.assembly is not None and bodies is not None:
        described, outcome = measured_variables(time, bodies, inputs.assembly, warnings)
        variables |= described
        attributes["outcome"] = outcome or attributes["outcome"]
    return dataset(variables, coords={"elapsed": ("elapsed", time)}, attrs=attributes)


def _uncertain_zeros(
    conditioned: Dataset, angle: Array | None, acceleration: Array | None, block: Block
) -> list[Finding]:
    """Say how far a zero may be off that was taken where something moves, if that matters."""
    if "restless_zero" not in conditioned.attrs:
        return []
    time, (start, stop), found = conditioned["elapsed"].to_numpy(), conditioned.attrs["restless_zero"], []
    uplift = block.uplift_acceleration
    for what, values, scale, of, share in (
        ("rocking angle", angle, block.critical_angle, "the critical angle", 0.01),
        ("base acceleration", acceleration, uplift, "the acceleration that uplifts the specimen", 0.03),
    ):
        if values is None:
            continue
        stretch = values[(time >= start) & (time <= stop) & np.isfinite(values)]
        parts = np.array([part.mean() for part in np.array_split(stretch, PARTS) if part.size])
        error = float(np.abs(parts - parts.mean()).max()) / scale if parts.size else 0.0
        if error > share:
            rest = "Record until the specimen is still" if start > time[0] else "Start recording before the motion"
            text = (
                f"The zero of the {what} is uncertain by {error:.2g} of {of}: it moves from {start:.3g} to "
                f"{stop:.3g} s, where zero is taken. {rest}, or give the test a `zero` where it is upright."
            )
            weight = serious if error > SERIOUS * share else warning
            found.append(weight("zero", text, follows=MEASUREMENT))
    return found


def _motion(
    conditioned: Dataset,
    inputs: RockingInputs,
    used: list[str],
    base: Mapping[str, Array],
    warnings: list[Finding],
) -> SpecimenMotion:
    known = inputs.transducers
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
        text = (
            f"The angle is not from gyroscope {', '.join(left_out)}: the displacement transducers contradict. "
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


def _of_transducers(conditioned: Dataset, motion: SpecimenMotion, used: list[str]) -> dict[str, Any]:
    """
    The angle and the residuals of its transducers.

    Its `cutoff_hz` is the lowest of the transducers on the specimen.
    """
    cutoff = min(conditioned[name].attrs["cutoff_hz"] for name in used)
    moved = np.array([float(np.nanstd(conditioned[name].to_numpy())) for name in used])
    noise = np.array([max(float(conditioned[name].attrs.get("noise", 0.0)), LEAST_NOISE) for name in used])
    return {
        "rocking_angle": ("elapsed", motion.angle, {"cutoff_hz": cutoff}),
        "transducer": ("transducer", [str(conditioned[name].attrs.get("channel", name)) for name in used]),
        "residual_to_noise": ("transducer", motion.residual_size / noise),
        "residual_to_reading": ("transducer", motion.residual_size / np.maximum(moved, 1e-300)),
    }
