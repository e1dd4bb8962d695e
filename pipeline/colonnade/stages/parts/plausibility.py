"""Plausibility: channels compared with each other, the equation of motion and the named motion; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from colonnade.arrays import Array, Dataset, Vector
from colonnade.campaign import Channel
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.findings import Finding
from colonnade.identification.fusion.sensors import Transducer, predict
from colonnade.identification.plausibility import table_motion
from colonnade.identification.plausibility.table_motion import TableChannel
from colonnade.identification.plausibility.transducers import (
    ANGLES,
    Gauge,
    Rotation,
    suspicions,
)
from colonnade.signals.named_motion import Series, check_motion
from colonnade.signals.quality import Flag
from colonnade.stages.parts.reference_motions import ReferenceMotionFile, load
from colonnade.stages.parts.transducers import along, transducers
from colonnade.store.provenance import Inputs

LEAST_LEVER = 0.02
"""Of the longest lever of a set-up; a transducer of a shorter one hardly sees the rotation."""

PEAKS = 0.8
"""Of the largest value, above which samples are its peaks."""


class PlausibilityInputs(Inputs):
    """
    What is known of a test's channels and of the motion that its table was to make.

    Attributes
    ----------
    block : Block
    outline : Outline
    channels : dict of str to Channel
        By channel id.
    motion : str or None
        The motion's name.
    time_scale : float or None
    references : dict of str to ReferenceMotionFile
        Reference motions by name; empty if the test names no motion.
    """

    block: Block
    outline: Outline
    channels: dict[str, Channel]
    motion: str | None
    time_scale: float | None
    references: dict[str, ReferenceMotionFile]


def doubts(conditioned: Dataset, inputs: PlausibilityInputs) -> list[Finding]:
    """Say which of a test's channels, zeroed on the clock `elapsed`, cannot be right, with the probable cause."""
    time = conditioned["elapsed"].to_numpy()
    interval = float(time[1] - time[0])
    known = transducers(inputs.channels)
    accelerations, displacements = (_along_x(conditioned, each) for each in (known.accelerations, known.displacements))
    moved = displacements[0].values if displacements else None
    shaken = accelerations or [
        each._replace(values=table_motion.derived(interval, each.values)) for each in displacements
    ]
    rotation = _rotation(conditioned, known.positions, inputs, moved, shaken[0].values if shaken else None)
    beside = displacements if accelerations else []
    found = table_motion.table_doubts(shaken, beside, rotation, interval) if shaken else []
    if rotation is not None and not any(each.kind in table_motion.MISPLACED for each in found):
        found += suspicions(rotation)
    if accelerations:
        found += _named_motion(Series(accelerations[0].values, interval), inputs)
    return [replace(each, text=f"{each.text[0].upper()}{each.text[1:]}.") for each in found]


def _along_x(conditioned: Dataset, channels: Mapping[str, Vector]) -> list[TableChannel]:
    found = []
    for name, part in along(channels, 0).items():
        if name in conditioned:
            given, values = conditioned[name].attrs, np.nan_to_num(conditioned[name].to_numpy() / part)
            # The scale of a channel can be judged where its largest values are beyond doubt.
            peaks = np.abs(values) >= PEAKS * np.abs(values).max()
            is_good = bool((conditioned[f"{name}_quality"].to_numpy()[peaks] == Flag.GOOD).mean() > 0.5)
            found.append(TableChannel(given["channel"], values, float(given.get("noise", 0.0)), is_good))
    return found


def _rotation(
    conditioned: Dataset,
    positions: Mapping[str, Transducer],
    inputs: PlausibilityInputs,
    moved: Array | None,
    acceleration: Array | None,
) -> Rotation | None:
    """
    Readings of the transducers that see the rotation, relative to the table; None if no transducer does.

    `moved` is the displacement of the table along x, m.
    """
    sides, gauges, cutoffs = [], [], []
    used = {name: each for name, each in positions.items() if name in conditioned}
    for side, angles in ((-1.0, ANGLES[ANGLES < 0]), (1.0, ANGLES[ANGLES >= 0])):
        pose = Pose(angles, *[np.zeros_like(angles)] * 5)
        sides.append(predict([*used.values()], pose, side, inputs.block, inputs.outline)[0])
    for (name, known), response in zip(used.items(), np.concatenate(sides, axis=-1), strict=True):
        given = conditioned[name].attrs
        cutoffs.append(float(given.get("cutoff_hz", np.inf)))
        reading = conditioned[name].to_numpy()
        if known.on_ground and moved is not None:
            reading = reading - known.direction[0] * moved
        if np.isfinite(response).all():
            quantity = "angle" if known.sensing == "angle" else "displacement"
            noise = float(given.get("noise", 0.0))
            factor = inputs.channels[given["channel"]].factor
            gauges.append(Gauge(given["channel"], reading, response, noise, factor, quantity))
    # Inclinometers have levers of one, displacements those in m.
    longest = max((abs(each.lever) for each in gauges if each.quantity == "displacement"), default=0.0)
    useful = [each for each in gauges if abs(each.lever) > LEAST_LEVER * (1.0 if each.quantity == "angle" else longest)]
    if not useful:
        return None
    time, blur = conditioned["elapsed"].to_numpy(), 0.5 / min(cutoffs)
    return Rotation(tuple(useful), inputs.block, float(time[1] - time[0]), acceleration, blur)


def _named_motion(record: Series, inputs: PlausibilityInputs) -> list[Finding]:
    warnings: list[Finding] = []
    names = {name.casefold(): name for name in inputs.references}
    named = names.get((inputs.motion or "").casefold())
    if named is None:
        return []
    loaded = load({named: inputs.references[named]}, warnings)
    if named not in loaded:
        return warnings
    others = load({name: each for name, each in inputs.references.items() if name != named}, [])
    return warnings + check_motion(record, named, loaded[named], time_scale=inputs.time_scale, others=others)
