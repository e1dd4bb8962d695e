"""Plausibility: channels compared with each other, the equation of motion and the named motion; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Codes, Mask
from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import ALONG
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.findings import Finding, serious
from colonnade.identification.fusion.sensors import Transducer, predict
from colonnade.identification.plausibility import table_motion
from colonnade.identification.plausibility import transducers as plausibility
from colonnade.identification.plausibility.factors import as_expected, cause
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.signals.named_motion import Series, check_motion
from colonnade.signals.quality import Flag
from colonnade.signals.stretches import filled_in
from colonnade.stages.ingesting.zero_error import Effect, on_angle, on_base
from colonnade.stages.ingesting.zeroing import COUPLED
from colonnade.stages.parts.inputs import Inputs
from colonnade.stages.parts.reference_motions import ReferenceMotionFile, load, reference_files
from colonnade.stages.parts.transducers import outline, transducers
from colonnade.store.description import variable_name

if TYPE_CHECKING:
    import xarray as xr

ANGLES = np.linspace(-0.4, 0.4, 161)
"""rad, at which the transducers' readings are computed."""

LEAST_LEVER = 0.02
"""Of the longest lever of a set-up; a transducer of a shorter one hardly sees the rotation."""

HALF_LEVER = 0.5
"""Of the longest lever of a set-up; transducers with shorter ones hardly affect its zero, as the others weigh more."""

SENSES_GRAVITY = 0.7
"""Of gravity, that has to lie along an accelerometer before its value at rest is judged."""


PEAKS = 0.8
"""Of the largest value, above which samples are its peaks."""


class PlausibilityInputs(Inputs):
    """
    What is known of a test's channels and of the motion that its table was to make.

    Attributes
    ----------
    block : Block
    outline : Outline
    positions : dict of str to Transducer
        Displacement transducers and inclinometers on the specimen, by variable.
    gains : dict of str to float
        SI value of one recorded unit, of these.
    accelerations, displacements : dict of str to float
        Table channels along x, by variable: the x-part of their direction.
    motion : str or None
        The motion's name.
    time_scale : float or None
    references : dict of str to ReferenceMotionFile
        Reference motions by name; empty if the test names no motion.
    """

    block: Block
    outline: Outline
    positions: dict[str, Transducer]
    gains: dict[str, float]
    accelerations: dict[str, float]
    displacements: dict[str, float]
    motion: str | None
    time_scale: float | None
    references: dict[str, ReferenceMotionFile]

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> PlausibilityInputs:
        """Gather what the channels of one test are compared with."""
        specimen = campaign.specimens[test.specimen]
        block = specimen.block(campaign.gravity)
        known = transducers(campaign.channels(test))
        gains = {variable_name(name): channel.factor for name, channel in campaign.channels(test).items()}
        return cls(
            block=block,
            outline=outline(specimen, block),
            positions=known.positions,
            gains={name: gains[name] for name in known.positions},
            accelerations={name: along[0] for name, along in known.accelerations.items() if abs(along[0]) >= ALONG},
            displacements={name: along[0] for name, along in known.displacements.items() if abs(along[0]) >= ALONG},
            motion=test.motion,
            time_scale=test.time_scale,
            references=reference_files(campaign) if test.motion else {},
        )


def doubts(conditioned: xr.Dataset, inputs: PlausibilityInputs) -> list[Finding]:
    """
    Say which of a test's channels cannot be right, with the probable cause.

    Parameters
    ----------
    conditioned : xr.Dataset
        Channels in SI on the clock `elapsed`, zeroed.
    inputs : PlausibilityInputs

    Returns
    -------
    doubts : list of Finding
        Empty if all agree.
    """
    time = conditioned["elapsed"].to_numpy()
    interval = float(time[1] - time[0])
    accelerations = _along_x(conditioned, inputs.accelerations)
    displacements = _along_x(conditioned, inputs.displacements)
    rotation = _rotation(conditioned, inputs, displacements)
    seen = None
    if rotation is not None and accelerations:
        seen = plausibility.base_scale(interval, rotation, accelerations[0].values, inputs.block)
    found, acceleration, agree = _table(interval, accelerations, displacements, seen)
    if rotation is not None and accelerations and not found:
        found, acceleration = _by_rocking(interval, accelerations, rotation, None if agree else seen, inputs.block)
    if rotation is not None and not any(each.kind in table_motion.MISPLACED for each in found):
        found += plausibility.suspicions(interval, rotation, acceleration, inputs.block)
    found += [hums for each in accelerations if (hums := table_motion.humming(interval, each))]
    found += _gravity(conditioned, inputs.block.gravity)
    if inputs.motion and accelerations and acceleration is not None:
        found += _named_motion(acceleration, interval, inputs)
    return [replace(each, text=f"{each.text[0].upper()}{each.text[1:]}.") for each in found]


def zero_effects(inputs: PlausibilityInputs) -> dict[str, Effect]:
    """What an error of a channel's zero does to the rocking angle or the base acceleration, by variable."""
    angles = {name: Rotation.lever(ANGLES, response) for name, response in _responses(inputs).items()}
    levers = {name: lever for name, lever in angles.items() if np.isfinite(lever)}
    longest = max(map(abs, levers.values()), default=0.0)
    return {
        name: on_angle(lever, inputs.block) for name, lever in levers.items() if abs(lever) >= HALF_LEVER * longest > 0
    } | {name: on_base(along, inputs.block) for name, along in inputs.accelerations.items()}


def _responses(inputs: PlausibilityInputs) -> dict[str, Array]:
    """What each displacement transducer and inclinometer on the specimen reads at `ANGLES`, by variable."""
    seen = list(inputs.positions.values())
    sides = []
    for side, angles in ((-1.0, ANGLES[ANGLES < 0]), (1.0, ANGLES[ANGLES >= 0])):
        still = np.zeros_like(angles)
        pose = Pose(angles, still, still, still, still, still)
        sides.append(predict(seen, pose, side, inputs.block, inputs.outline)[0] if seen else np.empty((0, angles.size)))
    return dict(zip(inputs.positions, np.concatenate(sides, axis=1), strict=True))


def _along_x(conditioned: xr.Dataset, channels: Mapping[str, float]) -> list[table_motion.TableChannel]:
    return [
        table_motion.TableChannel(
            conditioned[name].attrs["channel"],
            np.nan_to_num(conditioned[name].to_numpy() / part),
            float(conditioned[name].attrs.get("noise", 0.0)),
            str(conditioned[name].attrs.get("recorder", "main")),
            _is_good(conditioned[name].to_numpy(), conditioned[f"{name}_quality"].to_numpy()),
        )
        for name, part in channels.items()
        if name in conditioned
    ]


def _is_good(values: Array, flags: Codes) -> bool:
    """Whether the largest values are beyond doubt, so that the scale of a channel can be judged by them."""
    magnitude = np.nan_to_num(np.abs(values))
    return bool((flags[magnitude >= PEAKS * magnitude.max()] == Flag.GOOD).mean() > 0.5)


def _rotation(
    conditioned: xr.Dataset, inputs: PlausibilityInputs, displacements: list[table_motion.TableChannel]
) -> Rotation | None:
    """Readings of the transducers that see the rotation, relative to the table; None if no transducer does."""
    names = [name for name in inputs.positions if name in conditioned]
    if not names:
        return None
    responses = _responses(inputs)
    readings = np.array([conditioned[name].to_numpy() for name in names])
    refixed = None
    if displacements:
        read = [each.direction[0] * (each.sensing != "angle") for each in map(inputs.positions.__getitem__, names)]
        refixed = np.outer(read, displacements[0].values)
        on_ground = np.array([inputs.positions[name].on_ground for name in names])
        readings[on_ground] -= refixed[on_ground]
        refixed[on_ground] *= -1
    seen = Rotation(
        tuple(conditioned[name].attrs["channel"] for name in names),
        readings,
        np.array([responses[name] for name in names]),
        ANGLES,
        np.array([float(conditioned[name].attrs.get("noise", 0.0)) for name in names]),
        np.array([inputs.gains[name] for name in names]),
        tuple("angle" if inputs.positions[name].sensing == "angle" else "displacement" for name in names),
        refixed,
        max(0.5 / float(conditioned[name].attrs.get("cutoff_hz", np.inf)) for name in names),
        np.array([conditioned[f"{name}_quality"].to_numpy() == Flag.SUSPECT for name in names]),
    )
    useful = _seeing(seen, np.array([quantity == "angle" for quantity in seen.quantities]))
    return seen.only(useful) if useful else None


def _seeing(seen: Rotation, is_angle: Mask) -> list[int]:
    """Transducers that see the rotation; inclinometers have levers of one, displacements those in m."""
    finite, lengths = np.isfinite(seen.responses).all(axis=1), np.abs(seen.levers)
    longest = lengths[finite & ~is_angle].max(initial=0.0)
    is_long = np.where(is_angle, lengths > LEAST_LEVER, (lengths >= LEAST_LEVER * longest) & (longest > 0.0))
    return [int(index) for index in np.flatnonzero(finite & is_long)]


def _table(
    interval: float,
    accelerations: list[table_motion.TableChannel],
    displacements: list[table_motion.TableChannel],
    seen: float | None,
) -> tuple[list[Finding], Array | None, bool]:
    """Doubts by the table's channels alone, its acceleration put right, and whether two of them agree."""
    if not accelerations:
        return [], table_motion.derived(interval, displacements[0]) if displacements else None, False
    found: list[Finding] = []
    agree = False
    for one, other in product(accelerations, displacements):
        compared = table_motion.with_displacement(interval, one, other)
        if compared is None:
            said = table_motion.unlike(interval, one, other)
            found += [said] if said else []
        elif compared.differs and (compared.is_misplaced or (one.is_good and other.is_good)):
            wrong = table_motion.guilty(compared.factor, seen)
            found.append(table_motion.disagreement(one, other, compared, wrong))
            if wrong == "acceleration":
                return found, accelerations[0].values / compared.factor, agree
        else:
            agree = True
    return found, accelerations[0].values, agree


def _by_rocking(
    interval: float,
    accelerations: list[table_motion.TableChannel],
    rotation: Rotation,
    seen: float | None,
    block: Block,
) -> tuple[list[Finding], Array]:
    """Doubts about the table's acceleration by what it does to the specimen, and the acceleration put right."""
    names, values = " and ".join(each.name for each in accelerations), accelerations[0].values
    longest = int(np.abs(rotation.levers).argmax())
    lever = float(rotation.levers[longest])
    angle, noise = filled_in(rotation.readings[longest]) / lever, float(rotation.noise[longest]) / abs(lever)
    misplaced = table_motion.by_rocking(interval, names, values, angle, noise, block)
    if misplaced is not None:
        return [misplaced], values
    if seen is None or as_expected(seen) or not accelerations[0].is_good:
        return [], values
    text = (
        f"channel {names} is {abs(seen):.3g} times what the specimen's rocking requires: {cause(seen, 'acceleration')}"
    )
    return [serious("gain", text)], values / abs(seen)


def _gravity(conditioned: xr.Dataset, gravity: float) -> list[Finding]:
    """Doubts about accelerometers on the specimen, by what they show of gravity at rest."""
    found = []
    for variable in conditioned.data_vars.values():
        due = float(variable.attrs.get("rest_value", 0.0))
        shown = float(variable.attrs.get("zero", 0.0)) + due
        # One that shows nothing is reported where gravity is added to it.
        if abs(due) < SENSES_GRAVITY * gravity or abs(shown) < COUPLED * abs(due):
            continue
        ratio = shown / due
        if as_expected(ratio) and ratio > 0:
            continue
        turned = as_expected(ratio)
        why = "its sign is wrong" if turned else cause(ratio, "acceleration")
        found.append(
            serious(
                "sign" if turned else "gain",
                f"channel {variable.attrs['channel']} shows {shown:.3g} m/s² at rest, but gravity's part along it is "
                f"{due:.3g} m/s²: {why}",
            )
        )
    return found


def _named_motion(acceleration: Array, interval: float, inputs: PlausibilityInputs) -> list[Finding]:
    warnings: list[Finding] = []
    names = {name.casefold(): name for name in inputs.references}
    named = names.get((inputs.motion or "").casefold())
    if named is None:
        return []
    loaded = load({named: inputs.references[named]}, warnings)
    if named not in loaded:
        return warnings
    others = load({name: each for name, each in inputs.references.items() if name != named}, [])
    record = Series(acceleration, interval)
    return warnings + check_motion(record, named, loaded[named], time_scale=inputs.time_scale, others=others)
