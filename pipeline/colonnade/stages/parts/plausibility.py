"""Plausibility: channels compared with each other, the equation of motion and the named motion; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Vector
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.kinematics import Pose
from colonnade.findings import Finding, serious
from colonnade.identification.fusion.sensors import predict
from colonnade.identification.plausibility import table_motion
from colonnade.identification.plausibility.rotation import Gauge, Rotation, lever
from colonnade.identification.plausibility.scale import as_expected, cause
from colonnade.identification.plausibility.table_motion import TableChannel
from colonnade.identification.plausibility.transducers import Judged, base_scale, judge, suspicions
from colonnade.signals.named_motion import Series, check_motion
from colonnade.signals.quality import Flag
from colonnade.signals.samples import filled_in
from colonnade.stages.parts.reference_motions import ReferenceMotionFile, load, reference_files
from colonnade.stages.parts.transducers import SeenInputs, along
from colonnade.stages.parts.zeroing import COUPLED, Effect, on_angle, on_base
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


class PlausibilityInputs(SeenInputs):
    """
    What is known of a test's channels and of the motion that its table was to make.

    Attributes
    ----------
    gains : dict of str to float
        SI value of one recorded unit, of the displacement transducers and inclinometers on the specimen.
    motion : str or None
        The motion's name.
    time_scale : float or None
    references : dict of str to ReferenceMotionFile
        Reference motions by name; empty if the test names no motion.
    """

    gains: dict[str, float]
    motion: str | None
    time_scale: float | None
    references: dict[str, ReferenceMotionFile]

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> PlausibilityInputs:
        """Gather what the channels of one test are compared with."""
        seen = cls.seen(campaign, test)
        gains = {variable_name(name): channel.factor for name, channel in campaign.channels(test).items()}
        return cls(
            **seen,
            gains={name: gains[name] for name in seen["transducers"].positions},
            motion=test.motion,
            time_scale=test.time_scale,
            references=reference_files(campaign) if test.motion else {},
        )


def doubts(conditioned: xr.Dataset, inputs: PlausibilityInputs) -> list[Finding]:
    """Say which of a test's channels, zeroed on the clock `elapsed`, cannot be right, with the probable cause."""
    time, block = conditioned["elapsed"].to_numpy(), inputs.block
    interval = float(time[1] - time[0])
    accelerations = _along_x(conditioned, inputs.transducers.accelerations)
    displacements = _along_x(conditioned, inputs.transducers.displacements)
    rotation = _rotation(conditioned, inputs, displacements)
    acceleration = None
    if accelerations:
        acceleration = accelerations[0].values
    elif displacements:
        acceleration = table_motion.derived(interval, displacements[0])
    judged = None if rotation is None else judge(replace(rotation, acceleration=acceleration))
    found, factor = _table(interval, accelerations, displacements, judged) if accelerations else ([], 1.0)
    if acceleration is not None and factor != 1.0:
        acceleration = acceleration / factor
        judged = None if rotation is None else judge(replace(rotation, acceleration=acceleration))
    if judged is not None and not any(each.kind in table_motion.MISPLACED for each in found):
        found += suspicions(judged)
    found += [hums for each in accelerations if (hums := table_motion.humming(interval, each))]
    found += _gravity(conditioned, block.gravity)
    if inputs.motion and accelerations and acceleration is not None:
        found += _named_motion(acceleration, interval, inputs)
    return [replace(each, text=f"{each.text[0].upper()}{each.text[1:]}.") for each in found]


def zero_effects(inputs: PlausibilityInputs) -> dict[str, Effect]:
    """What an error of a channel's zero does to the rocking angle or the base acceleration, by variable."""
    angles = {name: lever(ANGLES, response) for name, response in _responses(inputs).items()}
    longest = np.nanmax(np.abs([*angles.values()]), initial=0.0)
    on_angles = {
        name: on_angle(length, inputs.block)
        for name, length in angles.items()
        if abs(length) >= HALF_LEVER * longest > 0
    }
    table = along(inputs.transducers.accelerations, 0)
    return on_angles | {name: on_base(part, inputs.block) for name, part in table.items()}


def _responses(inputs: PlausibilityInputs) -> dict[str, Array]:
    """What each displacement transducer and inclinometer on the specimen reads at `ANGLES`, by variable."""
    sides, positions = [], inputs.transducers.positions
    for side, angles in ((-1.0, ANGLES[ANGLES < 0]), (1.0, ANGLES[ANGLES >= 0])):
        pose = Pose(angles, *[np.zeros_like(angles)] * 5)
        sides.append(predict([*positions.values()], pose, side, inputs.block, inputs.outline)[0])
    return dict(zip(positions, np.concatenate(sides, axis=-1), strict=True))


def _along_x(conditioned: xr.Dataset, channels: Mapping[str, Vector]) -> list[TableChannel]:
    found = []
    for name, part in along(channels, 0).items():
        if name in conditioned:
            given, values = conditioned[name].attrs, np.nan_to_num(conditioned[name].to_numpy() / part)
            # The scale of a channel can be judged where its largest values are beyond doubt.
            peaks = np.abs(values) >= PEAKS * np.abs(values).max()
            is_good = bool((conditioned[f"{name}_quality"].to_numpy()[peaks] == Flag.GOOD).mean() > 0.5)
            noise, recorder = float(given.get("noise", 0.0)), str(given.get("recorder", "main"))
            found.append(TableChannel(given["channel"], values, noise, recorder, is_good))
    return found


def _rotation(
    conditioned: xr.Dataset, inputs: PlausibilityInputs, displacements: list[TableChannel]
) -> Rotation | None:
    """Readings of the transducers that see the rotation, relative to the table; None if no transducer does."""
    names = [name for name in inputs.transducers.positions if name in conditioned]
    if not names:
        return None
    time, responses, gauges = conditioned["elapsed"].to_numpy(), _responses(inputs), []
    for name in names:
        known, given = inputs.transducers.positions[name], conditioned[name].attrs
        reading = conditioned[name].to_numpy()
        is_angle, refixed = known.sensing == "angle", None
        if displacements:
            refixed = displacements[0].values * (0.0 if is_angle else known.direction[0])
            if known.on_ground:
                reading, refixed = reading - refixed, -refixed
        gauges.append(
            Gauge(
                given["channel"],
                reading,
                ANGLES,
                responses[name],
                float(given.get("noise", 0.0)),
                inputs.gains[name],
                "angle" if is_angle else "displacement",
                refixed,
                conditioned[f"{name}_quality"].to_numpy() == Flag.SUSPECT,
            )
        )
    seen = [each for each in gauges if np.isfinite(each.response).all()]
    # Inclinometers have levers of one, displacements those in m.
    longest = max((abs(each.lever) for each in seen if each.quantity == "displacement"), default=0.0)
    useful = [each for each in seen if abs(each.lever) > LEAST_LEVER * (1.0 if each.quantity == "angle" else longest)]
    if not useful:
        return None
    blur = max(0.5 / float(conditioned[name].attrs.get("cutoff_hz", np.inf)) for name in names)
    return Rotation(tuple(useful), inputs.block, float(time[1] - time[0]), blur=blur)


def _table(
    interval: float, accelerations: list[TableChannel], displacements: list[TableChannel], judged: Judged | None
) -> tuple[list[Finding], float]:
    """Doubts about the table's channels, by each other and by what rocks the specimen; how many times too large."""
    names = " and ".join(each.name for each in accelerations)
    seen = None if judged is None else base_scale(judged)
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
                return found, compared.factor
        else:
            agree = True
    if judged is None or found:
        return found, 1.0
    by = max(judged.rotation.gauges, key=lambda each: abs(each.lever))
    angle, noise = filled_in(by.reading) / by.lever, by.noise / abs(by.lever)
    misplaced = table_motion.by_rocking(interval, names, accelerations[0].values, angle, noise, judged.rotation.block)
    if misplaced is not None:
        return [misplaced], 1.0
    if agree or seen is None or as_expected(seen) or not accelerations[0].is_good:
        return [], 1.0
    why = cause(seen, "acceleration")
    text = f"channel {names} is {abs(seen):.3g} times what the specimen's rocking requires: {why}"
    return [serious("gain", text)], abs(seen)


def _gravity(conditioned: xr.Dataset, gravity: float) -> list[Finding]:
    """Doubts about accelerometers on the specimen, by what they show of gravity at rest."""
    found = []
    for variable in conditioned.data_vars.values():
        due = float(variable.attrs.get("rest_value", 0.0))
        shown = float(variable.attrs.get("zero", 0.0)) + due
        # One that shows nothing is reported where gravity is added to it.
        if abs(due) < SENSES_GRAVITY * gravity or abs(shown) < COUPLED * abs(due):
            continue
        kind, why = "gain", cause(shown / due, "acceleration")
        if as_expected(shown / due):
            kind, why = "sign", "its sign is wrong"
        if kind == "gain" or shown / due < 0:
            text = f"channel {variable.attrs['channel']} shows {shown:.3g} m/s² at rest, but gravity's part along it is"
            found.append(serious(kind, f"{text} {due:.3g} m/s²: {why}"))
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
