"""Whether transducers agree: with each other, and with the equation of motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from math import cos, isfinite, log, tan

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.scale import (
    STANDING,
    SURE,
    UNKNOWN,
    UNKNOWN_SCALE,
    Scale,
    as_expected,
    cause,
    scale_of,
)
from colonnade.signals.samples import filled_in

ANGLES = np.linspace(-0.4, 0.4, 161)
"""rad, at which what transducers have to read is computed."""

SMALL = 0.05
"""rad; slope of a transducer's reading over the angle is taken between ± this."""

ITERATIONS = 5
"""Towards the rotation that transducers share."""

AT_REST = 3.0
"""Over p: length of the end of a record on which a transducer shows whether it rests where it began, ..."""

ELSEWHERE = 0.1
"""... which is less than this share of its largest angle away."""

BETTER = 4.0
"""Times less that has to be left unexplained without a mistake."""

LEAST = 0.01
"""Of what the least of them moves, that is left unexplained with it."""

ALIKE = 0.05
"""Relative difference up to which scales are one."""

DEAD = 0.1
"""Share of what others give below which a channel is dead."""


@dataclass(frozen=True, eq=False)
class Gauge:
    """
    A transducer that sees the rotation.

    Attributes
    ----------
    name : str
        Of its channel.
    reading : ndarray, shape (n,)
        Relative to the table, m or rad; NaN where missing.
    response : ndarray, shape (k,)
        Its reading as it has to be at `ANGLES`.
    noise, gain : float
        Standard deviation; physical over recorded value.
    quantity : str
        "displacement" or "angle".
    """

    name: str
    reading: Array
    response: Array
    noise: float
    gain: float = 1.0
    quantity: str = "displacement"

    @cached_property
    def lever(self) -> float:
        """Slope of the reading over the angle about rest."""
        low, high = np.interp((-SMALL, SMALL), ANGLES, self.response)
        return float(high - low) / (2 * SMALL)

    def angle(self, scale: float = 1.0) -> Array:
        """θ (n,) if its readings are `scale` times too large; beyond `ANGLES` by its lever."""
        reading, order = self.reading / scale, np.argsort(self.response)
        inside = (reading >= self.response.min()) & (reading <= self.response.max())
        return np.where(inside, np.interp(reading, self.response[order], ANGLES[order]), reading / self.lever)


@dataclass(frozen=True, eq=False)
class Rotation:
    """
    A test's rotation as all transducers see it.

    Attributes
    ----------
    gauges : tuple of Gauge
    block : Block
    interval : float
        s.
    acceleration : ndarray, shape (n,), or None
        Of the table along x, m/s².
    blur : float
        What a low-pass rounds on either side of an impact, s.
    """

    gauges: tuple[Gauge, ...]
    block: Block
    interval: float
    acceleration: Array | None = None
    blur: float = 0.0

    @cached_property
    def scales(self) -> list[Scale]:
        """Scale of each by the equation of motion; unknown of one that ends at rest far from its zero."""
        return [self._scale(each) for each in self.gauges]

    def _scale(self, gauge: Gauge) -> Scale:
        straight = gauge.reading / gauge.lever
        end = filled_in(straight)[-max(round(AT_REST / self.block.p / self.interval), 2) :]
        largest, middle = float(np.nanmax(np.abs(straight))), abs(float(end.max() + end.min())) / 2
        if ELSEWHERE * largest < middle < self.block.critical_angle and float(np.ptp(end)) < largest / 2:
            return UNKNOWN_SCALE
        noise = gauge.noise / abs(gauge.lever)
        return scale_of(self.interval, gauge.angle, noise, self.acceleration, self.block, blur=self.blur)

    @property
    def shaken(self) -> float:
        """How many times too large the table's acceleration is by what it does to the specimen; NaN if not known."""
        shown = [scale for scale in self.scales if scale.is_known and isfinite(scale.base)]
        best = min(shown, key=lambda scale: scale.error / scale.value, default=UNKNOWN_SCALE)
        # A wrong clock changes both alike.
        return np.nan if best.differs and isfinite(best.rate) else best.value / best.base

    @cached_property
    def mistake(self) -> Finding | None:
        """The one mistake without which transducers agree on one rotation, far better: no scale means anything then."""
        before, moved = self.residual, min(float(np.nanstd(each.reading)) for each in self.gauges)
        best: tuple[float, Finding | None] = (np.inf, None)
        if len(self.gauges) == 1 or before < LEAST * moved:
            return None
        for kind, text, changed in self._candidates():
            after = changed.residual
            if before <= BETTER * after or after >= best[0]:
                continue
            # What agrees by chance, or with a block that walks, does not obey the equation of motion as well.
            proved = all(each.is_known and as_expected(each.value) for each in changed.scales)
            if proved and not (kind == "sign" and any(each.base < 0 for each in changed.scales)):
                fall = f"their residual about one rotation falls from {1e3 * before:.2g} to {1e3 * after:.2g} mm"
                best = after, serious(kind, f"{text}, {fall}")
        return best[1]

    def _candidates(self) -> Iterator[tuple[str, str, Rotation]]:
        """Kind of each mistake that is tried, its words, and the rotation without it."""
        for gauge in self.gauges:
            others = _names(each for each in self.gauges if each is not gauge)
            text = f"channel {gauge.name} turns opposite to {others}: with its sign reversed (`direction` or gain)"
            yield "sign", text, self.with_gauges(replace(gauge, reading=-gauge.reading))
        for first, second in combinations(self.gauges, 2):
            text = f"channels {first.name} and {second.name} look swapped: with their columns exchanged"
            yield "swapped channels", text, self.exchanged(first, second)

    @property
    def residual(self) -> float:
        """RMS of the readings less those of one common rotation."""
        levers, readings = (np.array([getattr(each, name) for each in self.gauges]) for name in ("lever", "reading"))
        angle, misfit = np.zeros(readings.shape[1]), readings
        # The responses are nearly straight, so that steps along their levers settle at once.
        for _ in range(ITERATIONS):
            angle = angle + levers @ misfit / float(levers @ levers)
            misfit = readings - np.array([np.interp(angle, ANGLES, each.response) for each in self.gauges])
        return float(np.sqrt(np.nanmean(misfit**2)))

    def with_gauges(self, *changed: Gauge) -> Rotation:
        """The same with gauges in place of those of the same names."""
        named = {each.name: each for each in changed}
        return replace(self, gauges=tuple(named.get(each.name, each) for each in self.gauges))

    def exchanged(self, one: Gauge, other: Gauge) -> Rotation:
        """The same with the columns of two exchanged, under their own gains."""
        factor = one.gain / other.gain
        return self.with_gauges(
            replace(one, reading=factor * other.reading, noise=abs(factor) * other.noise),
            replace(other, reading=one.reading / factor, noise=one.noise / abs(factor)),
        )


Seen = list[tuple[Gauge, Scale]]
"""Transducers with their scales."""


def suspicions(rotation: Rotation) -> list[Finding]:
    """
    Say which transducers cannot be right, with the probable cause.

    Empty if all agree, or if the specimen does not rock enough to show it. Each transducer's scale is found separately,
    see `scale_of`, so that a wrong one can be named.
    """
    seen = list(zip(rotation.gauges, rotation.scales, strict=True))
    if rotation.mistake:
        return [rotation.mistake]
    return [*_gains([(each, scale) for each, scale in seen if scale.is_known], rotation.block), *_dead(seen)]


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
        why = cause(scale.value, each.quantity)
        if why == UNKNOWN:
            lever = 1e3 * scale.value * each.lever
            place = "" if each.quantity == "angle" else f", or a place (`at`) whose lever is {lever:.3g} mm,"
            why = f"its gain × {1 / scale.value:.3g}{place} would make them agree"
        text = f"channel {each.name} shows {scale.value:.3g} times the rotation that the equation of motion gives"
        build = serious if scale.misleads else warning
        yield build("gain", f"{text}{shown}: {why}", follows=("unit",))


def _is_near(scale: Scale, value: float) -> bool:
    """Whether a scale may be another one, and rather that than one."""
    departure = abs(scale.value / value - 1)
    return departure < max(ALIKE, SURE * scale.error / scale.value) and departure < abs(scale.value - 1)


def _of_all(wrong: list[Gauge], scale: Scale, block: Block) -> Finding:
    """
    Say what all transducers show, and which mistakes explain it, the likeliest first.

    A wrong critical angle leaves alone what the table does to the specimen, a gain does not; a clock changes p, too.
    """
    value, side, several = scale.value, block.governing, len(wrong) > 1
    names = f"channel{'s' if several else ''} {_names(wrong, ' and ')}{' all show' if several else ' shows'}"
    height = side.pole_distance * cos(side.critical_angle)
    critical = min(value * side.critical_angle, 1.5)
    wide, high = height * tan(critical), side.half_width / tan(critical) / height
    causes = {
        "gain": f"{'all gains' if several else 'its gain'} × {1 / value:.3g} (all angles change alike)",
        "specimen": f"sizes that make α {critical:.3g} rad and not {side.critical_angle:.3g} rad, as a base of "
        f"{2e3 * wide:.3g} mm for {2e3 * side.half_width:.3g} mm or a height × {high:.3g}",
        "clock": "another sampling rate",
    }
    kind, why = "gain", cause(value, wrong[0].quantity)
    if isfinite(scale.rate):
        kind, rate = "clock", scale.rate
        causes[kind] = f"a sampling rate × {1 / rate:.3g} (all times change alike), or all sizes × {rate**-2:.3g}"
    elif scale.base > 0 and abs(log(scale.base)) < abs(log(scale.base / value)):
        kind = "specimen"
    elif why != UNKNOWN:
        causes["gain"] += f", as of {why}"
    text = f"{names} {value:.3g} times the rotation that the equation of motion gives for this specimen: "
    text += "; or ".join((causes.pop(kind), *causes.values()))
    return (serious if scale.misleads else warning)(kind, f"{text}, would make them agree", follows=("unit",))


def _dead(seen: Seen) -> Iterator[Finding]:
    """Name transducers that stand still while others turn."""
    right = [each for each, scale in seen if scale.is_known and not scale.differs]
    if not right:
        return
    angle = np.median([filled_in(each.reading) / each.lever for each in right], axis=0)
    for each, scale in seen:
        due, shown = float(np.std(each.lever * angle)), float(np.nanstd(each.reading))
        if not scale.is_known and due > STANDING * max(each.noise, 1e-12) and shown < DEAD * due:
            yield serious(
                "dead channel",
                f"channel {each.name} hardly moves ({1e3 * shown:.2g} mm RMS), although the rotation measured by "
                f"{_names(right)} would give {1e3 * due:.2g} mm: it is dead, or its gain is far too small. Check cable "
                "and sensor",
            )
