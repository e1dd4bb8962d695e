"""Transducers that see the rotation of a specimen: what each reads, and has to read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.plausibility.scale import UNKNOWN_SCALE, Scale, cause, scale_of
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


@dataclass(frozen=True)
class Rotation:
    """
    Transducers that see the rotation.

    Attributes
    ----------
    names : tuple of str
        Of their channels, m.
    readings, responses : ndarray, shapes (m, n) and (m, k)
        Relative to the table, and as they have to be at `angles`; m or rad.
    angles : ndarray, shape (k,)
        θ, rad, increasing through 0.
    noise : ndarray, shape (m,)
        Standard deviation.
    gains : ndarray, shape (m,)
        Physical over recorded value.
    quantities : tuple of {"displacement", "angle"}
        What each measures; empty where all are displacements.
    refixed : ndarray, shape (m, n), or None
        What each reads more if it is fixed to the ground and said to be on the table, or the reverse; None if unknown.
    blur : float
        What a low-pass rounds on either side of an impact, s.
    flagged : ndarray of bool, shape (m, n), or None
        Samples that were found suspect before, as those at the end of a range that is known.
    """

    names: tuple[str, ...]
    readings: Array
    responses: Array
    angles: Array
    noise: Array
    gains: Array
    quantities: tuple[Literal["displacement", "angle"], ...] = ()
    refixed: Array | None = None
    blur: float = 0.0
    flagged: Mask | None = None

    @cached_property
    def levers(self) -> Array:
        """Reading over angle about rest, shape (m,)."""
        return np.array([lever(self.angles, response) for response in self.responses])

    def measures_angle(self, index: int) -> bool:
        """Whether one is an inclinometer."""
        return bool(self.quantities) and self.quantities[index] == "angle"

    def angle(self, index: int, scale: float = 1.0) -> Array:
        """θ (n,) by one transducer whose readings are `scale` times too large; beyond `angles` by its lever."""
        reading, response, lever = self.readings[index] / scale, self.responses[index], self.levers[index]
        order = np.argsort(response)
        inside = (reading >= response.min()) & (reading <= response.max())
        return np.asarray(np.where(inside, np.interp(reading, response[order], self.angles[order]), reading / lever))

    def scales(self, interval: float, acceleration: Array | None, block: Block) -> list[Scale]:
        """Scale of each by the equation of motion; unknown of one that ends at rest far from its zero."""
        return [self._scale(index, interval, acceleration, block) for index in range(len(self.names))]

    def _scale(self, index: int, interval: float, acceleration: Array | None, block: Block) -> Scale:
        lever = self.levers[index]
        noise = float(self.noise[index] / abs(lever))
        straight = self.readings[index] / lever
        end = filled_in(straight)[-max(round(AT_REST / block.p / interval), 2) :]
        largest, middle = float(np.nanmax(np.abs(straight))), abs(float(end.max() + end.min())) / 2
        if ELSEWHERE * largest < middle < block.critical_angle and float(np.ptp(end)) < largest / 2:
            return UNKNOWN_SCALE
        rough = scale_of(interval, straight, noise, acceleration, block, blur=self.blur)
        if not rough.value > 0:
            return rough
        # The response is not straight: where it bends depends on the scale.
        angle = self.angle(index, rough.value)
        fine = scale_of(interval, angle, noise / rough.value, acceleration, block, blur=self.blur)
        return fine.times(rough.value)

    def cause(self, index: int, scale: float) -> str:
        """Probable cause of the scale of one."""
        return cause(scale, "angle" if self.measures_angle(index) else "displacement")

    def only(self, chosen: Sequence[int]) -> Rotation:
        """Some of them."""
        picked = list(chosen)
        arrays = ("readings", "responses", "noise", "gains", "refixed", "flagged")
        of_each = {name: values[picked] for name in arrays if (values := getattr(self, name)) is not None}
        quantities = tuple(self.quantities[index] for index in picked) if self.quantities else ()
        return replace(self, names=tuple(self.names[index] for index in picked), quantities=quantities, **of_each)

    def exchanged(self, first: int, second: int, *, with_gains: bool) -> Rotation:
        """The same with the readings of two exchanged: as recorded, or with the gains that made them."""
        order = list(range(len(self.names)))
        order[first], order[second] = second, first
        factors = np.ones(len(order)) if with_gains else self.gains / self.gains[order]
        return replace(
            self, readings=factors[:, None] * self.readings[order], noise=np.abs(factors) * self.noise[order]
        )

    def misfit(self) -> Array:
        """Readings less those of one common rotation, shape (m, n)."""
        levers, angle = self.levers, np.zeros(self.readings.shape[1])
        # The responses are nearly straight, so that steps along their levers settle at once.
        for _ in range(STEPS):
            misfit = self.readings - np.array([np.interp(angle, self.angles, each) for each in self.responses])
            angle = angle + levers @ misfit / float(levers @ levers)
        return np.asarray(misfit)

    def residual(self) -> float:
        """RMS of the misfit."""
        return float(np.sqrt(np.nanmean(self.misfit() ** 2)))
