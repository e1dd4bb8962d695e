"""Whether transducers agree: with each other, the table, the equation of motion, and themselves in the last test."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import cos, log, tan
from typing import NamedTuple

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.mistakes import stuck, undone
from colonnade.identification.plausibility.rotation import Gauge, Rotation
from colonnade.identification.plausibility.scale import DEAD, STANDING, SURE, UNKNOWN, Scale, as_expected, cause, dead
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


Seen = list[tuple[Gauge, Scale]]
"""Transducers with their scales."""


class Judged(NamedTuple):
    """Transducers held against the equation of motion, and what has to be mended before a scale means anything."""

    rotation: Rotation
    mistakes: list[Finding]

    @property
    def seen(self) -> Seen:
        """All transducers with their scales."""
        return list(zip(self.rotation.gauges, self.rotation.scales, strict=True))


def judge(rotation: Rotation) -> Judged:
    """Hold each transducer against the equation of motion."""
    mistake = undone(rotation)
    return Judged(rotation, [mistake] if mistake else list(stuck(rotation)))


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
    known = [(each, scale) for each, scale in judged.seen if scale.is_known]
    if judged.mistakes or not known:
        return judged.mistakes
    return [*_gains(known, judged.rotation.block), *_dead(judged.seen), *_signs(known)]


def base_scale(judged: Judged) -> float | None:
    """
    How many times too large the table's acceleration is, by what it does to the specimen; None if unknown.

    Negative where its sign, or that of all transducers, is wrong.
    """
    known = [each for each in judged.rotation.scales if each.is_known and each.base_is_known]
    found = [each.value / each.base for each in known if as_expected(each.value)]
    if not found or judged.mistakes:
        return None
    # Transducers that turn against each other do not show the sign; see `suspicions`.
    return float(np.median(np.abs(found))) * (-1.0 if max(found) < 0 else 1.0)


def _names(gauges: Iterable[Gauge], between: str = ", ") -> str:
    return between.join(each.name for each in gauges)


def _gains(known: Seen, block: Block) -> Iterator[Finding]:
    """Name transducers whose rotation is not that of the equation of motion, or what all of them share."""
    wrong = [(each, scale) for each, scale in known if scale.differs]
    if not wrong:
        return
    common = min((scale for _, scale in wrong), key=lambda scale: scale.error / scale.value)
    if all(_is_near(scale, common.value) for _, scale in known):
        yield _of_all([each for each, _ in known], common, block)
        return
    others = [each for each, scale in known if not scale.differs]
    shown = f", and that {_names(others)} {'shows' if len(others) == 1 else 'show'}" if others else ""
    for each, scale in wrong:
        text = f"channel {each.name} shows {scale.value:.3g} times the rotation that the equation of motion gives"
        build = serious if scale.misleads else warning
        yield build("gain", f"{text}{shown}: {_why(each, scale.value)}", follows=("unit",))


def _is_near(scale: Scale, value: float) -> bool:
    """Whether a scale may be another one, and rather that than one."""
    departure = abs(scale.value / value - 1)
    return departure < max(ALIKE, SURE * scale.error / scale.value) and departure < abs(scale.value - 1)


def _of_all(wrong: list[Gauge], scale: Scale, block: Block) -> Finding:
    """
    Say what all transducers show, and which mistakes explain it, the likeliest first.

    A wrong critical angle leaves alone what the table does to the specimen, a gain does not; a clock changes p, too.
    """
    value, several = scale.value, len(wrong) > 1
    names = _names(wrong, " and ")
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
    elif not 1 / FAR < value < FAR or cause(value, wrong[0].quantity) != UNKNOWN:
        end = f"{', in all of them' if several else ''}; or the specimen's dimensions, or the sampling rate"
        likeliest, follows = _why(wrong[0], value) + end, ("unit", "specimen")
    elif scale.base_is_known and scale.base > 0:
        if abs(log(scale.base)) < abs(log(scale.base / value)):
            kind, causes = "specimen", (sizes, f"{gains}, and that of the table's acceleration", causes[2])
        else:
            causes = (gains, f"a sampling rate × {scale.base**-0.5:.3g}", f"{sizes}, and another table's acceleration")
    likeliest = likeliest or f"{'; or '.join(causes)}, would make them agree"
    return (serious if scale.misleads else warning)(kind, text + likeliest, follows=follows)


def _why(gauge: Gauge, scale: float) -> str:
    """Probable cause of a scale; an odd one of a channel that is given no gain is that of a transducer in volts."""
    known, is_angle = cause(scale, gauge.quantity), gauge.quantity == "angle"
    unit = PLAIN_UNITS.get(float(gauge.gain))
    if known != UNKNOWN or not 1 / FAR < scale < FAR:
        is_plain = known == UNKNOWN and unit and not is_angle
        return f"its values are probably not {unit} but volts, and its `gain` is missing" if is_plain else known
    lever = 1e3 * gauge.lever
    place = f", or a place (`at`) whose lever is {scale * lever:.3g} mm and not {lever:.3g} mm,"
    return f"its gain × {1 / scale:.3g}{'' if is_angle else place} would make them agree"


def _dead(seen: Seen) -> Iterator[Finding]:
    """Name transducers that stand still while others turn."""
    right = [each for each, scale in seen if scale.is_known and not scale.differs]
    if not right:
        return
    angle = np.median([filled_in(each.reading) / each.lever for each in right], axis=0)
    for each, scale in seen:
        due, shown = float(np.std(each.lever * angle)), float(np.nanstd(each.reading))
        if not scale.is_known and due > STANDING * max(each.noise, 1e-12) and shown < DEAD * due:
            yield dead(each.name, 1e3 * shown, 1e3 * due, "mm", f"the rotation measured by {_names(right)}")


def _signs(known: Seen) -> Iterator[Finding]:
    """Name transducers that turn against the others, or all of them if they turn against the table."""
    groups = _sides(known)
    turning = groups[0] + groups[1]
    shown = [(each, scale.base) for each, scale in turning if scale.base_is_known]
    against = [each for each, base in shown if base < 0]
    wrong = "(`direction`, or the sign of the gain)"
    if all(groups):
        # Wrong are those that turn against the table if that is known, else the fewer.
        fewer, more = ([each for each, _ in group] for group in sorted(groups, key=len))
        sure = bool(shown) or len(fewer) < len(more)
        if shown:
            fewer = against or fewer
            more = [each for each, _ in turning if each not in fewer]
        names, others = _names(fewer), _names(more)
        which = f"the sign of {names} is wrong" if sure else f"the sign of one of the two is wrong, {names} or {others}"
        yield serious("sign", f"channel {names} turns opposite to {others}: {which} {wrong}")
    elif against and len(against) == len(shown):
        several = len(turning) > 1
        names = _names((each for each, _ in turning), " and ")
        yield serious(
            "sign",
            f"{f'channels {names} turn' if several else f'channel {names} turns'} opposite to the table's "
            "acceleration: the sign of the table's acceleration is wrong, or that of "
            f"{'all of them' if several else 'this channel'} {wrong}",
        )


def _sides(known: Seen) -> tuple[Seen, Seen]:
    """Transducers that turn with the first one, and against it; those that do neither are left out."""
    leader = known[0][0].reading / known[0][0].lever
    sides: tuple[Seen, Seen] = [known[0]], []
    for each, scale in known[1:]:
        angle = each.reading / each.lever
        both = np.isfinite(leader) & np.isfinite(angle)
        agreement = float(np.corrcoef(leader[both], angle[both])[0, 1])
        if abs(agreement) > FOLLOWS:
            sides[int(agreement < 0)].append((each, scale))
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
