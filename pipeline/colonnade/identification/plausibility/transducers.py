"""Whether transducers on a rocking specimen agree with each other, with the table and with the equation of motion."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, log, tan

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.factors import DEAD, MISLEADING, STANDING, UNKNOWN, as_expected, cause, dead
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.scale import SURE, Scale
from colonnade.identification.plausibility.stuck import stuck
from colonnade.identification.plausibility.undone import undone
from colonnade.signals.stretches import filled_in

ALIKE = 0.05
"""Relative difference up to which scales are one."""

FAR = 2.3
"""Factor from which on a scale is not that of a size or a calibration."""

LEAST_RATE = 0.01
"""Relative departure of p that a clock is suspected of."""

PLAIN_UNITS = {1.0: "m", 1e-2: "cm", 1e-3: "mm", 1e-6: "µm", 0.0254: "inches"}
"""Units by the gain that a channel has which is given none."""

FOLLOWS = 0.9
"""Correlation with which one transducer turns with another."""


def suspicions(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> list[Finding]:
    """
    Say which transducers cannot be right, with the probable cause.

    Parameters
    ----------
    interval : float
        Of the record, s.
    rotation : Rotation
    acceleration : ndarray, shape (n,), or None
        Of the table along x, m/s².
    block : Block

    Returns
    -------
    suspicions : list of Finding
        Empty if all agree, or if the specimen does not rock enough to show it.

    Notes
    -----
    Each transducer's scale is found separately, see `scale_of`, so that a wrong one can be named.
    """
    scales = rotation.scales(interval, acceleration, block)
    known = [index for index, scale in enumerate(scales) if scale.is_known]
    if mistakes := _mistakes(interval, rotation, scales, acceleration, block):
        return mistakes
    if not known:
        return []
    right = [index for index in known if not scales[index].differs]
    return [
        *_gains(rotation, scales, known, block),
        *_dead(rotation, scales, right),
        *_signs(rotation, scales, known),
    ]


def base_scale(interval: float, rotation: Rotation, acceleration: Array, block: Block) -> float | None:
    """
    How many times too large the table's acceleration is, by what it does to the specimen; None if unknown.

    See `suspicions` for the arguments. Negative where its sign, or that of all transducers, is wrong.
    """
    scales = rotation.scales(interval, acceleration, block)
    found = [
        scale.value / scale.base
        for scale in scales
        if scale.is_known and scale.base_is_known and as_expected(scale.value)
    ]
    if not found or _mistakes(interval, rotation, scales, acceleration, block):
        return None
    # Transducers that turn against each other do not show the sign; see `suspicions`.
    return float(np.median(np.abs(found))) * (-1.0 if max(found) < 0 else 1.0)


def _mistakes(
    interval: float, rotation: Rotation, scales: Sequence[Scale], acceleration: Array | None, block: Block
) -> list[Finding]:
    """What has to be mended before a scale means anything."""
    mistake = undone(interval, rotation, acceleration, block)
    return [mistake] if mistake else stuck(interval, rotation, scales, acceleration, block)


def _gains(rotation: Rotation, scales: Sequence[Scale], known: list[int], block: Block) -> list[Finding]:
    """Name transducers whose rotation is not that of the equation of motion, or what all of them share."""
    wrong = [index for index in known if scales[index].differs]
    if not wrong:
        return []
    common = scales[min(wrong, key=lambda index: scales[index].error / scales[index].value)]
    if all(_is_near(scales[index], common.value) for index in known):
        return [_of_all(rotation, known, common, block)]
    others = [rotation.names[index] for index in known if index not in wrong]
    shown = f", and that {', '.join(others)} {'shows' if len(others) == 1 else 'show'}" if others else ""
    return [
        _weighted(
            "gain",
            scales[index],
            f"channel {rotation.names[index]} shows {scales[index].value:.3g} times the rotation that the equation of "
            f"motion gives{shown}: {_why(rotation, index, scales[index].value)}",
            follows=("unit",),
        )
        for index in wrong
    ]


def _is_near(scale: Scale, value: float) -> bool:
    """Whether a scale may be another one, and rather that than one."""
    departure = abs(scale.value / value - 1)
    return departure < max(ALIKE, SURE * scale.error / scale.value) and departure < abs(scale.value - 1)


def _weighted(kind: str, scale: Scale, text: str, *, follows: tuple[str, ...]) -> Finding:
    build = serious if abs(log(abs(scale.value))) > log(1 + MISLEADING) else warning
    return build(kind, text, follows=follows)


def _of_all(rotation: Rotation, wrong: list[int], scale: Scale, block: Block) -> Finding:
    """
    Say what all transducers show, and which mistakes explain it, the likeliest first.

    A wrong critical angle leaves alone what the table does to the specimen, a gain does not; a clock changes p, too.
    """
    value, several = scale.value, len(wrong) > 1
    names = " and ".join(rotation.names[index] for index in wrong)
    text = (
        f"{f'channels {names} all show' if several else f'channel {names} shows'} {value:.3g} times the rotation that "
        "the equation of motion gives for this specimen: "
    )
    gains = f"{'all gains' if several else 'its gain'} × {1 / value:.3g} (all angles change alike)"
    half, height = (side := block.governing).half_width, side.pole_distance * cos(side.critical_angle)
    critical = min(value * side.critical_angle, 1.5)
    wide, high = height * tan(critical), half / tan(critical) / height
    sizes = (
        f"sizes that make α {critical:.3g} rad and not {side.critical_angle:.3g} rad, as a base of {2e3 * wide:.3g} mm "
        f"for {2e3 * half:.3g} mm or a height × {high:.3g}"
    )
    kind, causes = "gain", (gains, sizes, "another sampling rate")
    is_clock = abs(log(max(scale.without_rate, 1e-9))) < abs(log(value)) / 2
    if is_clock and abs(scale.rate - 1) > max(SURE * scale.rate_error, LEAST_RATE):
        clock = f"a sampling rate × {1 / scale.rate:.3g} (all times change alike), or all sizes × {scale.rate**-2:.3g}"
        kind, causes = "clock", (clock, gains, sizes)
    elif not 1 / FAR < value < FAR or _cause(rotation, wrong[0], value) != UNKNOWN:
        end = f"{', in all of them' if several else ''}; or the specimen's dimensions, or the sampling rate"
        return _weighted("gain", scale, text + _why(rotation, wrong[0], value) + end, follows=("unit", "specimen"))
    elif scale.base_is_known and scale.base > 0:
        if abs(log(scale.base)) < abs(log(scale.base / value)):
            kind, causes = "specimen", (sizes, f"{gains}, and that of the table's acceleration", causes[2])
        else:
            causes = (gains, f"a sampling rate × {scale.base**-0.5:.3g}", f"{sizes}, and another table's acceleration")
    likeliest = f"{causes[0]}; or {causes[1]}; or {causes[2]}"
    return _weighted(kind, scale, f"{text}{likeliest}, would make them agree", follows=("unit",))


def _cause(rotation: Rotation, index: int, scale: float) -> str:
    return cause(scale, "angle" if rotation.measures_angle(index) else "displacement")


def _why(rotation: Rotation, index: int, scale: float) -> str:
    """Probable cause of a scale; an odd one of a channel that is given no gain is that of a transducer in volts."""
    known, is_angle = _cause(rotation, index, scale), rotation.measures_angle(index)
    unit = PLAIN_UNITS.get(float(rotation.gains[index]))
    if known != UNKNOWN or not 1 / FAR < scale < FAR:
        is_plain = known == UNKNOWN and unit and not is_angle
        return f"its values are probably not {unit} but volts, and its `gain` is missing" if is_plain else known
    lever = 1e3 * float(rotation.levers[index])
    place = f", or a place (`at`) whose lever is {scale * lever:.3g} mm and not {lever:.3g} mm,"
    return f"its gain × {1 / scale:.3g}{'' if is_angle else place} would make them agree"


def _dead(rotation: Rotation, scales: Sequence[Scale], right: list[int]) -> list[Finding]:
    """Name transducers that stand still while others turn."""
    if not right:
        return []
    levers = rotation.levers
    angle = np.median([filled_in(rotation.readings[index]) / levers[index] for index in right], axis=0)
    others = ", ".join(rotation.names[index] for index in right)
    found = []
    for index, name in enumerate(rotation.names):
        expected = float(np.std(levers[index] * angle))
        shown = float(np.nanstd(rotation.readings[index]))
        moves = expected > STANDING * max(rotation.noise[index], 1e-12)
        if not scales[index].is_known and moves and shown < DEAD * expected:
            by = f"the rotation measured by {others}"
            found.append(dead(name, 1e3 * shown, 1e3 * expected, "mm", by))
    return found


def _signs(rotation: Rotation, scales: Sequence[Scale], known: list[int]) -> list[Finding]:
    """Name transducers that turn against the others, or all of them if they turn against the table."""
    sides = _sides(rotation, known)
    against = {index: scales[index].base < 0 for index in sides if scales[index].base_is_known}
    if len(set(sides.values())) > 1:
        return [_against_each_other(rotation, sides, against)]
    if not against or not all(against.values()):
        return []
    names = " and ".join(rotation.names[index] for index in sides)
    channels, which = (
        (f"channels {names} turn", "all of them") if len(sides) > 1 else (f"channel {names} turns", "this channel")
    )
    return [
        serious(
            "sign",
            f"{channels} opposite to the table's acceleration: the sign of the table's acceleration is wrong, or that "
            f"of {which} (`direction`, or the sign of the gain)",
        )
    ]


def _sides(rotation: Rotation, known: list[int]) -> dict[int, float]:
    """Sign with which each transducer that follows the first one turns with it."""
    angles = rotation.readings / rotation.levers[:, None]
    leader = known[0]
    sides = {leader: 1.0}
    for index in known[1:]:
        both = np.isfinite(angles[leader]) & np.isfinite(angles[index])
        agreement = float(np.corrcoef(angles[leader][both], angles[index][both])[0, 1])
        if abs(agreement) > FOLLOWS:
            sides[index] = float(np.sign(agreement))
    return sides


def _against_each_other(rotation: Rotation, sides: dict[int, float], against: dict[int, bool]) -> Finding:
    """Name the wrong ones of two groups: those that turn against the table if that is known, else the fewer."""
    groups = [[index for index in sides if sides[index] == side] for side in (1.0, -1.0)]
    fewer, more = sorted(groups, key=len)
    sure = len(fewer) < len(more)
    if against:
        fewer = [index for index in sides if against.get(index)] or fewer
        more, sure = [index for index in sides if index not in fewer], True
    names, others = (", ".join(rotation.names[index] for index in group) for group in (fewer, more))
    which = f"the sign of {names} is wrong" if sure else f"the sign of one of the two is wrong, {names} or {others}"
    return serious(
        "sign", f"channel {names} turns opposite to {others}: {which} (`direction`, or the sign of the gain)"
    )
