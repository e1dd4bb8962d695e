"""Transducers that see the rotation of a specimen: what each reads, and has to read."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.plausibility.scale import UNKNOWN_SCALE, Scale, scale_of
from colonnade.signals.samples import filled_in

SMALL = 0.05
"""rad; slope of a transducer's reading over the angle is taken between ± this."""

STEPS = 5
"""Towards the rotation that two transducers share."""

AT_REST = 3.0
"""Over p: length of the end of a record on which a transducer shows whether it rests where it began, ..."""

ELSEWHERE = 0.1
"""... which is less than this share of its largest angle away."""


def lever(angles: Array, response: Array) -> float:
    """Give the slope about rest of what a transducer reads (m or rad) over the angle (rad)."""
    low, high = np.interp((-SMALL, SMALL), angles, response)
    return float(high - low) / (2 * SMALL)


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
    angles, response : ndarray, shape (k,)
        θ, rad, increasing through 0, and its reading as it has to be there.
    noise, gain : float
        Standard deviation; physical over recorded value.
    quantity : {"displacement", "angle"}
    refixed : ndarray, shape (n,), or None
        What it reads more if it is fixed to the ground and said to be on the table, or the reverse; None if unknown.
    flagged : ndarray of bool, shape (n,), or None
        Samples that were found suspect before, as those at the end of a range that is known.
    """

    name: str
    reading: Array
    angles: Array
    response: Array
    noise: float
    gain: float = 1.0
    quantity: Literal["displacement", "angle"] = "displacement"
    refixed: Array | None = None
    flagged: Mask | None = None

    @cached_property
    def lever(self) -> float:
        """Reading over angle about rest."""
        return lever(self.angles, self.response)

    def angle(self, scale: float = 1.0) -> Array:
        """θ (n,) if its readings are `scale` times too large; beyond `angles` by its lever."""
        reading, order = self.reading / scale, np.argsort(self.response)
        inside = (reading >= self.response.min()) & (reading <= self.response.max())
        curved = np.interp(reading, self.response[order], self.angles[order])
        return np.asarray(np.where(inside, curved, reading / self.lever))

    def written(self, value: float) -> str:
        """Write a reading with its unit."""
        return f"{1e3 * value:.3g} {'mrad' if self.quantity == 'angle' else 'mm'}"


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
        noise, straight = gauge.noise / abs(gauge.lever), gauge.reading / gauge.lever
        end = filled_in(straight)[-max(round(AT_REST / self.block.p / self.interval), 2) :]
        largest, middle = float(np.nanmax(np.abs(straight))), abs(float(end.max() + end.min())) / 2
        if ELSEWHERE * largest < middle < self.block.critical_angle and float(np.ptp(end)) < largest / 2:
            return UNKNOWN_SCALE
        rough = scale_of(self.interval, straight, noise, self.acceleration, self.block, blur=self.blur)
        if not rough.value > 0:
            return rough
        # The response is not straight: where it bends depends on the scale.
        angle, noise = gauge.angle(rough.value), noise / rough.value
        fine = scale_of(self.interval, angle, noise, self.acceleration, self.block, blur=self.blur)
        return fine.times(rough.value)

    def with_gauges(self, *changed: Gauge) -> Rotation:
        """The same with gauges in place of those of the same names."""
        named = {each.name: each for each in changed}
        return replace(self, gauges=tuple(named.get(each.name, each) for each in self.gauges))

    def added(self, gauge: Gauge, more: Array) -> Rotation:
        """The same with something added to the readings of one."""
        return self.with_gauges(replace(gauge, reading=gauge.reading + more))

    def exchanged(self, one: Gauge, other: Gauge, *, with_gains: bool) -> Rotation:
        """The same with the readings of two exchanged: as recorded, or with the gains that made them."""
        factor = 1.0 if with_gains else one.gain / other.gain
        return self.with_gauges(
            replace(one, reading=factor * other.reading, noise=abs(factor) * other.noise),
            replace(other, reading=one.reading / factor, noise=one.noise / abs(factor)),
        )

    def misfit(self) -> Array:
        """Readings less those of one common rotation, shape (m, n)."""
        levers, readings = (np.array([getattr(each, name) for each in self.gauges]) for name in ("lever", "reading"))
        angle = np.zeros(readings.shape[1])
        # The responses are nearly straight, so that steps along their levers settle at once.
        for _ in range(STEPS):
            misfit = readings - np.array([np.interp(angle, each.angles, each.response) for each in self.gauges])
            angle = angle + levers @ misfit / float(levers @ levers)
        return np.asarray(misfit)

    def residual(self) -> float:
        """RMS of the misfit."""
        return float(np.sqrt(np.nanmean(self.misfit() ** 2)))
