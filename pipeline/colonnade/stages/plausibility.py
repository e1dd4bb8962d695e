"""Plausibility: channels held against each other, the equation of motion and the motion named; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.findings import Finding, serious
from colonnade.identification import plausibility, table_motion
from colonnade.identification.factors import as_expected, cause
from colonnade.identification.plausibility import Rotation
from colonnade.identification.sensors import Transducer, predict
from colonnade.signals.named_motion import Series, check_motion
from colonnade.stages.reference_motions import Source, load, sources
from colonnade.stages.transducers import outline, transducers
from colonnade.stages.zero_error import Effect, on_angle, on_base
from colonnade.stages.zeroing import COUPLED
from colonnade.store.description import variable_name

Array = NDArray[np.float64]

ANGLES = np.linspace(-0.4, 0.4, 161)
"""rad, at which the transducers' readings are computed."""

ALONG = 0.9
"""Smallest part of a table channel's direction along x with which it counts as a record of the motion along x."""

LEAST_LEVER = 0.02
"""Of the longest lever of a set-up; a transducer of a shorter one hardly sees the rotation."""

HALF_LEVER = 0.5
"""Of the longest lever of a set-up; transducers of shorter ones hardly tell its zero, as the others weigh more."""

SENSES_GRAVITY = 0.7
"""Of gravity, that has to lie along an accelerometer before its value at rest is judged."""


class PlausibilityInstructions(BaseModel):
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
    references : dict of str to Source
        Reference motions by name; empty where the test names no motion.
    """

    model_config = ConfigDict(frozen=True)

    block: Block
    outline: Outline
    positions: dict[str, Transducer]
    gains: dict[str, float]
    accelerations: dict[str, float]
    displacements: dict[str, float]
    motion: str | None
    time_scale: float | None
    references: dict[str, Source]


def instructions(campaign: Campaign, test: Test) -> PlausibilityInstructions:
    """Gather what is held against the channels of one test."""
    specimen = campaign.specimens[test.specimen]
    block = specimen.block(campaign.gravity)
    known = transducers(campaign.channels(test))
    gains = {variable_name(name): channel.factor for name, channel in campaign.channels(test).items()}
    return PlausibilityInstructions(
        block=block,
        outline=outline(specimen, block),
        positions=known.positions,
        gains={name: gains[name] for name in known.positions},
        accelerations={name: along[0] for name, along in known.accelerations.items() if abs(along[0]) >= ALONG},
        displacements={name: along[0] for name, along in known.displacements.items() if abs(along[0]) >= ALONG},
        motion=test.motion,
        time_scale=test.time_scale,
        references=sources(campaign) if test.motion else {},
    )


def doubts(conditioned: xr.Dataset, read: PlausibilityInstructions) -> list[Finding]:
    """
    Say what of a test's channels cannot be right, with the probable cause.

    Parameters
    ----------
    conditioned : xr.Dataset
        Channels in SI on the clock `elapsed`, zeroed.
    read : PlausibilityInstructions

    Returns
    -------
    doubts : list of Finding
        Empty where all agree.
    """
    time = conditioned["elapsed"].to_numpy()
    interval = float(time[1] - time[0])
    accelerations = _along_x(conditioned, read.accelerations)
    displacements = _along_x(conditioned, read.displacements)
    acceleration = accelerations[0].values if accelerations else None
    rotation = _rotation(conditioned, read, displacements)
    by_specimen = None
    if rotation is not None and acceleration is not None:
        by_specimen = plausibility.base_scale(interval, rotation, acceleration, read.block)
    found, blamed = _table(interval, accelerations, displacements, by_specimen)
    if rotation is not None:
        right = acceleration / blamed if acceleration is not None else None
        found += plausibility.suspicions(interval, rotation, right, read.block)
    found += _gravity(conditioned, read.block.gravity)
    if read.motion and acceleration is not None:
        found += _named_motion(acceleration / blamed, interval, read)
    return [replace(each, text=f"{each.text[0].upper()}{each.text[1:]}.") for each in found]


def zero_effects(read: PlausibilityInstructions) -> dict[str, Effect]:
    """What an error of a channel's zero does to the rocking angle or the base acceleration, by variable."""
    angles = {name: Rotation.lever(ANGLES, response) for name, response in _by_transducer(read).items()}
    levers = {name: lever for name, lever in angles.items() if np.isfinite(lever)}
    longest = max(map(abs, levers.values()), default=0.0)
    return {
        name: on_angle(lever, read.block) for name, lever in levers.items() if abs(lever) >= HALF_LEVER * longest > 0
    } | {name: on_base(along, read.block) for name, along in read.accelerations.items()}


def _by_transducer(read: PlausibilityInstructions) -> dict[str, Array]:
    """What each transducer on the specimen reads at `ANGLES`."""
    seen = list(read.positions.values())
    if not seen:
        return {}
    responses = np.concatenate([_responses(seen, side, read) for side in (-1.0, 1.0)], axis=1)
    return dict(zip(read.positions, responses, strict=True))


def _along_x(conditioned: xr.Dataset, channels: Mapping[str, float]) -> list[table_motion.TableChannel]:
    return [
        table_motion.TableChannel(
            conditioned[name].attrs["channel"],
            np.nan_to_num(conditioned[name].to_numpy() / part),
            float(conditioned[name].attrs.get("noise", 0.0)),
        )
        for name, part in channels.items()
        if name in conditioned
    ]


def _rotation(
    conditioned: xr.Dataset, read: PlausibilityInstructions, displacements: list[table_motion.TableChannel]
) -> Rotation | None:
    """Readings of the transducers that see the rotation, relative to the table."""
    names = [name for name in read.positions if name in conditioned]
    if not names:
        return None
    seen = [read.positions[name] for name in names]
    responses = np.concatenate([_responses(seen, side, read) for side in (-1.0, 1.0)], axis=1)
    readings = np.array([conditioned[name].to_numpy() for name in names])
    for index, transducer in enumerate(seen):
        if transducer.on_ground and displacements:
            readings[index] -= transducer.direction[0] * displacements[0].values
    noise = np.array([float(conditioned[name].attrs.get("noise", 0.0)) for name in names])
    channels = tuple(conditioned[name].attrs["channel"] for name in names)
    gains = np.array([read.gains[name] for name in names])
    whole = Rotation(channels, readings, responses, ANGLES, noise, gains)
    useful = [index for index in range(len(names)) if np.isfinite(responses[index]).all()]
    lengths = np.abs(whole.levers)
    # Inclinometers have levers of one, in rad; displacements are compared among themselves.
    kinds = np.array([each.sensing == "angle" for each in seen])
    longest = max((lengths[index] for index in useful if not kinds[index]), default=0.0)
    useful = [index for index in useful if kinds[index] or lengths[index] >= LEAST_LEVER * longest > 0]
    useful = [index for index in useful if lengths[index] > LEAST_LEVER or not kinds[index]]
    return whole.only(useful) if useful else None


def _responses(seen: list[Transducer], side: float, read: PlausibilityInstructions) -> Array:
    angles = ANGLES[ANGLES < 0] if side < 0 else ANGLES[ANGLES >= 0]
    still = np.zeros_like(angles)
    pose = Pose(angles, still, still, still, still, still)
    return predict(seen, pose, side, read.block, read.outline)[0]


def _table(
    interval: float,
    accelerations: list[table_motion.TableChannel],
    displacements: list[table_motion.TableChannel],
    by_specimen: float | None,
) -> tuple[list[Finding], float]:
    """Doubts about the table's channels, and how many times too large its acceleration is by them."""
    found: list[Finding] = []
    for acceleration, displacement in product(accelerations, displacements):
        ratio = table_motion.ratio(interval, acceleration, displacement)
        if ratio is None:
            said = table_motion.dead(interval, acceleration, displacement)
            found += [said] if said else []
            continue
        wrong = table_motion.guilty(ratio, by_specimen)
        if wrong:
            found.append(table_motion.disagreement(acceleration.name, displacement.name, ratio, wrong))
        if wrong == "acceleration":
            return found, ratio
    if not found and by_specimen is not None and not as_expected(by_specimen):
        names = " and ".join(each.name for each in accelerations)
        found.append(
            serious(
                "gain",
                f"channel {names} is {abs(by_specimen):.3g} times what the specimen's rocking asks for: "
                f"{cause(by_specimen, 'acceleration')}",
            )
        )
        return found, abs(by_specimen)
    return found, 1.0


def _gravity(conditioned: xr.Dataset, gravity: float) -> list[Finding]:
    """Doubts about accelerometers on the specimen, by what they show of gravity at rest."""
    found = []
    for variable in conditioned.data_vars.values():
        due = float(variable.attrs.get("rest_value", 0.0))
        shown = float(variable.attrs.get("zero", 0.0)) + due
        # One that shows nothing is told where gravity is added to it.
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
                f"channel {variable.attrs['channel']} shows {shown:.3g} m/s² at rest, where gravity's part along it is "
                f"{due:.3g} m/s²: {why}",
            )
        )
    return found


def _named_motion(acceleration: Array, interval: float, read: PlausibilityInstructions) -> list[Finding]:
    warnings: list[Finding] = []
    names = {name.casefold(): name for name in read.references}
    named = names.get((read.motion or "").casefold())
    if named is None:
        return []
    loaded = load({named: read.references[named]}, warnings)
    if named not in loaded:
        return warnings
    others = load({name: each for name, each in read.references.items() if name != named}, [])
    record = Series(acceleration, interval)
    return warnings + check_motion(record, named, loaded[named], time_scale=read.time_scale, others=others)
