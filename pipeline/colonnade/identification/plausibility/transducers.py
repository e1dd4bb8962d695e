"""Whether transducers agree: with each other, the table, the equation of motion, and themselves in the last test."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import cos, log, tan

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.mistakes import mistakes
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.scale import DEAD, STANDING, SURE, UNKNOWN, Scale, as_expected, dead
from colonnade.signals.samples import filled_in

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

NOISE_FACTOR = 4.0
"""Noise that differs by more than this between two tests comes from another gain, cable or filter."""

STILL = 3.0
"""A channel that moves by less than this many times its noise does not move."""

ALIVE = 20.0
"""A channel that moves by more than this many times its noise moves."""

WANDERED = 0.25
"""Of the largest motion of both tests: a zero that shifts by more wandered."""


@dataclass(frozen=True)
class Judged:
    """
    Transducers that were held against the equation of motion.

    Attributes
    ----------
    rotation : Rotation
    block : Block
    scales : list of Scale
        Of each transducer.
    mistakes : list of Finding
        What has to be mended before a scale means anything.
    """

    rotation: Rotation
    block: Block
    scales: list[Scale]
    mistakes: list[Finding]


def judge(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Judged:
    """
    Hold each transducer against the equation of motion.

    Parameters
    ----------
    interval : float
        Of the record, s.
    rotation : Rotation
    acceleration : ndarray, shape (n,), or None
        Of the table along x, m/s².
    block : Block
    """
    scales = rotation.scales(interval, acceleration, block)
    return Judged(rotation, block, scales, mistakes(interval, rotation, scales, acceleration, block))


def suspicions(judged: Judged) -> list[Finding]:
    """
    Say which transducers cannot be right, with the probable cause.

    Returns
    -------
    suspicions : list of Finding
        Empty if all agree, or if the specimen does not rock enough to show it.

    Notes
    -----
    Each transducer's scale is found separately, see `scale_of`, so that a wrong one can be named.
    """
    rotation, scales = judged.rotation, judged.scales
    known = [index for index, scale in enumerate(scales) if scale.is_known]
    if judged.mistakes or not known:
        return judged.mistakes
    return [*_gains(rotation, scales, known, judged.block), *_dead(rotation, scales), *_signs(rotation, scales, known)]


def base_scale(judged: Judged) -> float | None:
    """
    How many times too large the table's acceleration is, by what it does to the specimen; None if unknown.

    Negative where its sign, or that of all transducers, is wrong.
    """
    found = [
        each.value / each.base
        for each in judged.scales
        if each.is_known and each.base_is_known and as_expected(each.value)
    ]
    if not found or judged.mistakes:
        return None
    # Transducers that turn against each other do not show the sign; see `suspicions`.
    return float(np.median(np.abs(found))) * (-1.0 if max(found) < 0 else 1.0)


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
    found = []
    for index in wrong:
        value = scales[index].value
        text = f"channel {rotation.names[index]} shows {value:.3g} times the rotation that the equation of motion gives"
        build = serious if scales[index].misleads else warning
        found.append(build("gain", f"{text}{shown}: {_why(rotation, index, value)}", follows=("unit",)))
    return found


def _is_near(scale: Scale, value: float) -> bool:
    """Whether a scale may be another one, and rather that than one."""
    departure = abs(scale.value / value - 1)
    return departure < max(ALIKE, SURE * scale.error / scale.value) and departure < abs(scale.value - 1)


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
    follows: tuple[str, ...] = ("unit",)
    is_clock = abs(log(max(scale.without_rate, 1e-9))) < abs(log(value)) / 2
    likeliest = ""
    if is_clock and abs(scale.rate - 1) > max(SURE * scale.rate_error, LEAST_RATE):
        clock = f"a sampling rate × {1 / scale.rate:.3g} (all times change alike), or all sizes × {scale.rate**-2:.3g}"
        kind, causes = "clock", (clock, gains, sizes)
    elif not 1 / FAR < value < FAR or rotation.cause(wrong[0], value) != UNKNOWN:
        end = f"{', in all of them' if several else ''}; or the specimen's dimensions, or the sampling rate"
        likeliest, follows = _why(rotation, wrong[0], value) + end, ("unit", "specimen")
    elif scale.base_is_known and scale.base > 0:
        if abs(log(scale.base)) < abs(log(scale.base / value)):
            kind, causes = "specimen", (sizes, f"{gains}, and that of the table's acceleration", causes[2])
        else:
            causes = (gains, f"a sampling rate × {scale.base**-0.5:.3g}", f"{sizes}, and another table's acceleration")
    likeliest = likeliest or f"{'; or '.join(causes)}, would make them agree"
    return (serious if scale.misleads else warning)(kind, text + likeliest, follows=follows)


def _why(rotation: Rotation, index: int, scale: float) -> str:
    """Probable cause of a scale; an odd one of a channel that is given no gain is that of a transducer in volts."""
    known, is_angle = rotation.cause(index, scale), rotation.measures_angle(index)
    unit = PLAIN_UNITS.get(float(rotation.gains[index]))
    if known != UNKNOWN or not 1 / FAR < scale < FAR:
        is_plain = known == UNKNOWN and unit and not is_angle
        return f"its values are probably not {unit} but volts, and its `gain` is missing" if is_plain else known
    lever = 1e3 * float(rotation.levers[index])
    place = f", or a place (`at`) whose lever is {scale * lever:.3g} mm and not {lever:.3g} mm,"
    return f"its gain × {1 / scale:.3g}{'' if is_angle else place} would make them agree"


def _dead(rotation: Rotation, scales: Sequence[Scale]) -> list[Finding]:
    """Name transducers that stand still while others turn."""
    right = [index for index, scale in enumerate(scales) if scale.is_known and not scale.differs]
    if not right:
        return []
    levers, found = rotation.levers, []
    angle = np.median([filled_in(rotation.readings[index]) / levers[index] for index in right], axis=0)
    by = f"the rotation measured by {', '.join(rotation.names[index] for index in right)}"
    for index, name in enumerate(rotation.names):
        due, shown = float(np.std(levers[index] * angle)), float(np.nanstd(rotation.readings[index]))
        moves = due > STANDING * max(rotation.noise[index], 1e-12)
        if not scales[index].is_known and moves and shown < DEAD * due:
            found.append(dead(name, 1e3 * shown, 1e3 * due, "mm", by))
    return found


def _signs(rotation: Rotation, scales: Sequence[Scale], known: list[int]) -> list[Finding]:
    """Name transducers that turn against the others, or all of them if they turn against the table."""
    sides = _sides(rotation, known)
    against = {index: scales[index].base < 0 for index in sides if scales[index].base_is_known}
    wrong = "(`direction`, or the sign of the gain)"
    groups = [[index for index in sides if sides[index] == side] for side in (1.0, -1.0)]
    if all(groups):
        # Wrong are those that turn against the table if that is known, else the fewer.
        fewer, more = sorted(groups, key=len)
        sure = len(fewer) < len(more)
        if against:
            fewer, sure = [index for index in sides if against.get(index)] or fewer, True
            more = [index for index in sides if index not in fewer]
        names, others = (", ".join(rotation.names[index] for index in group) for group in (fewer, more))
        which = f"the sign of {names} is wrong" if sure else f"the sign of one of the two is wrong, {names} or {others}"
        return [serious("sign", f"channel {names} turns opposite to {others}: {which} {wrong}")]
    if not against or not all(against.values()):
        return []
    names, several = " and ".join(rotation.names[index] for index in sides), len(sides) > 1
    channels = f"channels {names} turn" if several else f"channel {names} turns"
    text = (
        f"{channels} opposite to the table's acceleration: the sign of the table's acceleration is wrong, or that of "
        f"{'all of them' if several else 'this channel'} {wrong}"
    )
    return [serious("sign", text)]


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


@dataclass(frozen=True)
class ChannelState:
    """
    A channel in one test, in its own SI unit.

    Attributes
    ----------
    zero : float
        Reading at rest.
    noise : float
        Standard deviation at rest.
    motion : float
        Largest magnitude about the zero.
    """

    zero: float
    noise: float
    motion: float

    @property
    def is_still(self) -> bool:
        """Whether it does not move."""
        return self.motion <= STILL * self.noise

    @property
    def is_alive(self) -> bool:
        """Whether it moves beyond doubt."""
        return self.motion > ALIVE * self.noise


def changes(now: Mapping[str, ChannelState], before: Mapping[str, ChannelState], last: str) -> Iterator[Finding]:
    """
    Compare the channels of a test with those of the last test of the same set-up.

    Parameters
    ----------
    now, before : mapping of str to ChannelState
        By channel.
    last : str
        Id of the last test.

    Yields
    ------
    finding : Finding
    """
    something_moves = any(state.is_alive for state in now.values())
    for name in now.keys() & before.keys():
        here, there = now[name], before[name]
        if something_moves and here.is_still and there.is_alive:
            yield serious(
                "dead channel",
                f"Channel {name} does not move, as it did in {last}, while others do. Check its cable and its core.",
            )
        elif there.noise > 0.0 and not 1 / NOISE_FACTOR < here.noise / there.noise < NOISE_FACTOR:
            yield warning(
                "gain",
                f"The noise of channel {name} is {here.noise / there.noise:.2g} times that in {last}. "
                "Was its gain, range or filter changed?",
            )
        elif abs(here.zero - there.zero) > WANDERED * max(here.motion, there.motion):
            share = abs(here.zero - there.zero) / max(here.motion, there.motion)
            yield warning(
                "zero",
                f"The zero of channel {name} moved since {last} by {share:.2g} times its largest motion. Was it moved?",
            )
