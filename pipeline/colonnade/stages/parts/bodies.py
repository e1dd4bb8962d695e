"""The bodies of an assembly: what was measured of each, and what the contact model predicts of each."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from colonnade.arrays import Array, Dataset
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assembly import Whole
from colonnade.dynamics.assembly import Assembly, as_one, is_frame, standing_on
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import rotation_matrices
from colonnade.dynamics.contact.history import AssemblyHistory
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.kinematics import pole_displacement, pole_position, rotation_matrix
from colonnade.errors import count
from colonnade.findings import Finding, serious, warning
from colonnade.identification.fusion.motion import Circumstances, specimen_motion
from colonnade.identification.fusion.pose import SpecimenMotion
from colonnade.identification.fusion.sensors import Readings, Transducer, UnseenRotationError
from colonnade.identification.response.outcome import angle_features
from colonnade.stages.parts.beginning import Beginning
from colonnade.stages.parts.transducers import SeenInputs, outline, readings, transducers
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs
from colonnade.units.text import with_minus

MOTIONS = ("slide", "transverse_slide", "uplift", "out_of_plane_angle", "yaw")
"""What is known of a body over time beside its angle, as `body_…`."""

AXES = ("x", "y", "z")
"""Of a marker `ID`, in the names of its channels `ID_x`, `ID_y` and `ID_z`."""

OUTCOMES = ("overturned", "rocking", "no-rocking")
"""The worst first."""


class BodyInputs(SeenInputs):
    """
    What is read of one body; its transducers are about its own base.

    Attributes
    ----------
    part : Block
        The body with all that stands on it alone, as one: its α is that of the joint below.
    against : dict of str to str
        Body that a transducer measures against, by its variable.
    """

    part: Block
    against: dict[str, str]


class AssemblyInputs(Inputs):
    """
    What is read of an assembly: its bodies where they stand, and what is on each.

    `rest_duration`, s, is that of the end over which what is left is taken.
    """

    assembly: Assembly
    bodies: dict[str, BodyInputs]
    rest_duration: float

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> AssemblyInputs | None:
        """Gather it for a test; None if its specimen is a single body."""
        whole = campaign.specimens[test.specimen]
        if not isinstance(whole, Whole):
            return None
        assembly, setup = whole.assembly(campaign.gravity), campaign.setups[test.setup]
        bodies = {}
        for name, placed in assembly.bodies.items():
            channels = {
                key: each.model_copy(update={"on": "specimen"})
                for key, each in setup.channels.items()
                if each.on == name and each.recorder in test.files
            }
            bodies[name] = BodyInputs(
                block=placed.block,
                part=as_one(assembly, name),
                outline=outline(whole.made[name], placed.block),
                transducers=transducers(channels),
                against={
                    variable_name(key): each.relative_to
                    for key, each in channels.items()
                    if each.relative_to is not None and each.relative_to in assembly.bodies
                },
            )
        return cls(assembly=assembly, bodies=bodies, rest_duration=campaign.processing.rest_duration)


FEWEST = 4
"""Markers with which the places of all are compared."""

MISPLACED = 0.01
"""m, by which a marker may be off its place at rest, relative to the others."""

MOST_SAID = 9
"""Markers that one finding names."""


def misplaced(conditioned: Dataset, inputs: AssemblyInputs) -> list[Finding]:
    """
    Find markers that are not, at rest, where their `on` and `at` put them relative to each other.

    Where the cameras have their origin is not known: the median over all markers is taken for it.
    """
    names, off = [], []
    for body, known in inputs.bodies.items():
        placed, seen = inputs.assembly.bodies[body], dict[str, list[tuple[Transducer, float]]]()
        for variable, sensor in known.transducers.positions.items():
            marker, _, axis = variable.rpartition("_")
            if axis in AXES and variable in conditioned and "zero" in conditioned[variable].attrs:
                seen.setdefault(marker, []).append((sensor, float(conditioned[variable].attrs["zero"])))
        for marker, coordinates in seen.items():
            if len(coordinates) == len(AXES):
                # What was taken off each channel at rest, along the axes of the table.
                where = sum(zero * np.array(sensor.direction) for sensor, zero in coordinates)
                names.append(f"{marker} on body {body}")
                off.append(where - np.append(placed.position, inputs.assembly.levels[body]) - coordinates[0][0].at)
    if len(names) < FEWEST:
        return []
    away = np.array(off) - np.median(off, axis=0)
    wrong = np.flatnonzero(np.linalg.norm(away, axis=1) > MISPLACED)
    said = []
    for each in wrong[:MOST_SAID]:
        x, y, z = (with_minus(str(round(1e3 * value))) for value in away[each].tolist())
        said.append(f"{names[each]} by {x}, {y} and {z} mm along x, y and z")
    text = (
        f"At rest {wrong.size} of {len(names)} markers are off the places that `on` and `at` give: {'; '.join(said)}. "
        "Check their columns, `on` and `at`, the heights of the bodies, and the axes and the unit of the tracking."
    )
    return [serious("geometry", text)] if said else []


@dataclass(frozen=True)
class Measured:
    """
    Motions of the bodies that were measured, and why others were not.

    Attributes
    ----------
    motions : dict of str to SpecimenMotion
    placed : dict of str to (ndarray, ndarray)
        Their rotations, shape (3, 3, n), and displacements of the centres of their bases, m, shape (3, n).
    reasons : dict of str to str
    """

    motions: dict[str, SpecimenMotion]
    placed: dict[str, tuple[Array, Array]]
    reasons: dict[str, str]


def measure(conditioned: Dataset, inputs: AssemblyInputs, test: Circumstances) -> Measured:
    """Fuse what is on each body into its motion relative to the table."""
    found = Measured({}, {}, {})
    for name, body in inputs.bodies.items():
        missing = sorted({other for other in body.against.values() if other not in found.motions})
        if missing:
            found.reasons[name] = f"it is measured against {', '.join(missing)}, whose motion is not known"
        elif not any(each in conditioned for each in body.transducers.on_specimen):
            found.reasons[name] = "no transducer on it could be used"
        else:
            positions = readings(conditioned, body.transducers.positions)
            positions = _from_the_table(positions, name, conditioned, inputs, found)
            rates = readings(conditioned, body.transducers.gyroscopes)
            try:
                motion = specimen_motion(positions, rates, body.block, body.outline, test)
            except UnseenRotationError as error:
                found.reasons[name] = str(error)
            else:
                found.motions[name], found.placed[name] = motion, _placed(motion, body.block)
    return found


def together(motion: SpecimenMotion | None, found: Measured, inputs: AssemblyInputs) -> SpecimenMotion | None:
    """
    Return the motion of the lowest body, with the lean of it and all that stands on it alone as rocking angle.

    Parameters
    ----------
    motion : SpecimenMotion or None
        All transducers taken to be on one block: what is returned of a frame, or if one of those bodies is not known.
    found : Measured
    inputs : AssemblyInputs

    Notes
    -----
    The lean is the angle with the vertical of the line from the base to the common centre of mass, as of
    `BodyHistory.lean`: bodies that slide or rock on each other have no common rotation.
    """
    assembly = inputs.assembly
    lowest = next(iter(assembly.bodies))
    names = standing_on(assembly, lowest)
    if motion is None or is_frame(assembly) or not found.motions.keys() >= set(names):
        return motion
    masses = np.array([inputs.bodies[name].block.mass for name in names])
    arms = []
    for name in names:
        turned, centre = found.placed[name]
        place = centre + assembly.bodies[name].centre_height * turned[:, 2]
        arms.append(place + _apart(assembly, name, lowest)[:, None])
    x, y, z = np.tensordot(masses / masses.sum(), arms, 1) - found.placed[lowest][1]
    first = found.motions[lowest]
    values = first.values | {"rocking_angle": np.copysign(np.arctan2(np.hypot(x, y), z), x)}
    return replace(first, values=values, residual=motion.residual, entered=motion.entered)


def _from_the_table(
    positions: Readings[Transducer],
    name: str,
    conditioned: Dataset,
    inputs: AssemblyInputs,
    found: Measured,
) -> Readings[Transducer]:
    """Add to what is measured against another body how its own point there moved."""
    body, values = inputs.bodies[name], positions.values.copy()
    used = [each for each in body.transducers.positions if each in conditioned]
    for row, (variable, sensor) in enumerate(zip(used, positions.sensors, strict=True)):
        if variable in body.against:
            other = body.against[variable]
            turned, centre = found.placed[other]
            arm = np.array(sensor.at) + _apart(inputs.assembly, name, other)
            values[row] += np.array(sensor.direction) @ (centre + np.einsum("ijn,j->in", turned, arm) - arm[:, None])
    return replace(positions, values=values)


def _apart(assembly: Assembly, name: str, other: str) -> Array:
    """From the centre of the base of one body to that of another at rest, m, shape (3,)."""
    upper, lower = (np.append(assembly.bodies[each].position, assembly.levels[each]) for each in (name, other))
    return np.asarray(upper - lower)


def _placed(motion: SpecimenMotion, block: Block) -> tuple[Array, Array]:
    """Rotation of a body, shape (3, 3, n), and displacement of the centre of its base, m, shape (3, n)."""
    side = np.where(motion.pose.angle < 0, -1.0, 1.0)
    turned = rotation_matrix(motion.pose)
    swung = side * pole_position(block) * (turned[:, 0] - np.array([[1.0], [0.0], [0.0]]))
    return turned, pole_displacement(motion.pose, side, block) - swung


def measured_variables(
    time: Array, found: Measured, inputs: AssemblyInputs, warnings: list[Finding]
) -> tuple[dict[str, Any], str]:
    """Describe the bodies in a result of `rocking`, and the outcome of all; those without a motion are warned of."""
    fallen: set[str] = set()
    rows = []
    for name, placed in inputs.assembly.bodies.items():
        row = _measured_row(name, time, found, inputs)
        if row["outcome"] == "overturned" or (placed.on and fallen.issuperset(placed.on)):
            fallen.add(name)  # what stands on what fell has fallen
            row |= {"outcome": "overturned", "peak_ratio": np.nan}
        rows.append(row)
    if found.reasons:
        text = "; ".join(f"{name}: {reason}" for name, reason in found.reasons.items())
        lost = f"The motion of {count(len(found.reasons), 'body', 'bodies')} is not measured: {text}."
        warnings.append(warning("fewer transducers", lost, follows=("channel left out", "dead channel")))
    outcomes = [row["outcome"] for row in rows]
    return _table(list(inputs.bodies), rows), next((each for each in OUTCOMES if each in outcomes), "")


def _measured_row(name: str, time: Array, found: Measured, inputs: AssemblyInputs) -> dict[str, Any]:
    """What was measured of one body."""
    motion, body = found.motions.get(name), inputs.bodies[name]
    if motion is None:
        return {"outcome": "", "separation": f"not measured: {found.reasons[name]}"}
    values, error = motion.values, float(np.nanmedian(motion.standard_error["rocking_angle"]))
    row: dict[str, Any] = {key: values[key] for key in MOTIONS if key in values}
    row |= {"angle": values["rocking_angle"], "outcome": "", "separation": motion.separation}
    turned, centre = found.placed[name]
    joint_turned = turned
    for below in inputs.assembly.bodies[name].on[:1]:
        if below not in found.motions:
            row["separation"] += f"; not relative to {below}: {found.reasons[below]}"
            return row
        joint_turned = np.einsum("jin,jkn->ikn", found.placed[below][0], turned)
        error = float(np.hypot(error, np.nanmedian(found.motions[below].standard_error["rocking_angle"])))
    angle = np.arctan2(-joint_turned[2, 0], joint_turned[2, 2])
    half_width = body.block.governing.half_width
    # The base, or the top below where that is narrower.
    tops = [inputs.bodies[below].block.solid for below in inputs.assembly.bodies[name].on]
    narrower = min([half_width, *(solid.top[0] for solid in tops if solid is not None)])
    seen = angle_features(time, angle, error, body.part, rest_duration=inputs.rest_duration, catch=None)
    opened = np.flatnonzero(np.abs(angle) > seen.threshold)
    at_end = time >= time[-1] - inputs.rest_duration
    # Where the centre of its base is at the end, and how it is turned, from where it stood.
    left = {"slide": ("x", centre[0]), "transverse_slide": ("y", centre[1]), "yaw": ("yaw", motion.pose.yaw)}
    for key, (axis, moved) in left.items():
        if key in values and np.isfinite(moved[at_end]).any():
            row[f"residual_{axis}"] = float(np.nanmean(moved[at_end]))
    return row | {
        "joint_angle": angle,
        "outcome": seen.verdict.outcome,
        "peak_ratio": seen.peak_ratio,
        "opening": 2 * narrower * float(np.nanmax(np.abs(angle))),
        "opening_time": float(time[opened[0]]) if opened.size else np.nan,
    }


def predicted_variables(history: AssemblyHistory, beginning: Beginning, inputs: AssemblyInputs) -> dict[str, Any]:
    """Describe the bodies in a result of `predict`."""
    rows = []
    at_end = history.time >= history.time[-1] - inputs.rest_duration
    for name, body in history.bodies.items():
        assembly, joint = inputs.assembly, body.relative
        turned = np.moveaxis(rotation_matrices(body.orientation), 0, -1)
        rest = np.append(assembly.bodies[name].position, assembly.levels[name])
        centre = body.position.T - assembly.bodies[name].centre_height * turned[:, 2] - rest[:, None]
        fell = np.isfinite(body.overturning_time)
        ratio = float(np.abs(joint.angle).max() / inputs.bodies[name].part.critical_angle)
        over_time = {
            "angle": body.angle,
            "slide": body.slide[:, 0],
            "uplift": body.uplift,
            "out_of_plane_angle": body.out_of_plane_angle,
            "yaw": body.yaw,
            "joint_angle": joint.angle,
        }
        rows.append(
            {key: beginning.padded(each) for key, each in over_time.items()}
            | {
                "outcome": "overturned" if fell else "rocking" if ratio > NO_ROCKING_RATIO else "no-rocking",
                "peak_ratio": np.nan if fell else ratio,
                "residual_x": float(centre[0, at_end].mean()),
                "residual_y": float(centre[1, at_end].mean()),
                "residual_yaw": float(body.yaw[at_end].mean()),
            }
        )
    return _table(list(history.bodies), rows)


def _table(names: list[str], rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Variables on the dimension of bodies, from what is known of each; NaN or empty where another is not known."""
    variables: dict[str, Any] = {"body": ("body", np.array(names, dtype=object))}
    for key in dict.fromkeys(key for row in rows for key in row):
        known = next(row[key] for row in rows if key in row)
        missing = "" if isinstance(known, str) else np.full(np.shape(known), np.nan)
        values = np.array([row.get(key, missing) for row in rows], dtype=object if isinstance(known, str) else float)
        variables[f"body_{key}"] = ("body", "elapsed")[: values.ndim], values
    return variables
