"""Free rocking from release to rest as a function of a few unknowns, with its derivatives."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import exp

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.rocking_arc import LOCAL, angle_of_arcs, course_of, follow_arcs

Array = NDArray[np.float64]

ALWAYS = ("restitution", "peak", "time", "zero_offset")
"""Unknowns of every fit: ln e, |θ| of the first peak (rad), its time (s), zero offset (rad)."""

OPTIONAL = ("critical_angle", "p")
"""Unknowns that may be freed: the logarithm of the factor on the block's α, and on its p."""

STEPS = {"restitution": 1e-6, "peak": 1e-6, "critical_angle": 1e-6, "p": 1e-6}
"""Of the differences that give derivatives; that of the peak relative to it."""


@dataclass(frozen=True)
class Decay:
    """
    Unknowns of a free rocking, and what is known of it.

    Attributes
    ----------
    values : dict of str to float
        By name, of all of `ALWAYS` and `OPTIONAL`.
    side : int
        Of the first peak: 0 for θ < 0, 1 for θ > 0.
    count : int
        Number of arcs.
    block : Block
    linearised : bool
    """

    values: dict[str, float]
    side: int
    count: int
    block: Block
    linearised: bool

    def moved(self, steps: dict[str, float]) -> Decay:
        """Return the decay with steps added to its unknowns."""
        return replace(self, values={name: value + steps.get(name, 0.0) for name, value in self.values.items()})

    @property
    def critical(self) -> Array:
        """Critical angles of the sides θ < 0 and θ > 0, rad, shape (2,)."""
        sides = (self.block.negative, self.block.positive)
        return np.array([side.critical_angle for side in sides]) * exp(self.values["critical_angle"])

    @property
    def p(self) -> Array:
        """Frequency parameters of both sides, rad/s, shape (2,)."""
        sides = (self.block.negative, self.block.positive)
        return np.array([self.block.side_p(side) for side in sides]) * exp(self.values["p"])

    def arcs(self) -> tuple[Array, Array, Array]:
        """Peaks (|θ|, rad), their times and the ends of the arcs (s), shape (count,)."""
        restitution = np.full(self.count - 1, exp(self.values["restitution"]))
        return course_of(
            restitution,
            self.values["peak"],
            self.values["time"],
            self.side,
            self.critical,
            self.p,
            self.count,
            self.linearised,
        )

    def angle(self, time: Array) -> tuple[Array, Array, NDArray[np.int64]]:
        """Angle (rad), its sensitivity to the unknowns of its arc, and the number of that arc, at times (s)."""
        return follow_arcs(
            time,
            *self.arcs(),
            self.side,
            self.values["zero_offset"],
            self.critical,
            self.p,
            self.linearised,
        )

    def angle_alone(self, time: Array) -> Array:
        """Angle at times (s), rad."""
        return angle_of_arcs(
            time,
            *self.arcs(),
            self.side,
            self.values["zero_offset"],
            self.critical,
            self.p,
            self.linearised,
        )

    def derivatives(self, names: tuple[str, ...]) -> Array:
        """Derivatives of the unknowns of each arc with respect to those named, shape (count, 5, len(names))."""
        result = np.zeros((self.count, LOCAL, len(names)))
        for column, name in enumerate(names):
            if name == "zero_offset":
                result[:, 2, column] = 1.0
                continue
            if name == "time":
                result[:, 1, column] = 1.0
                continue
            step = STEPS[name] * (self.values["peak"] if name == "peak" else 1.0)
            (high, late, _), (low, early, _) = (self.moved({name: sign * step}).arcs() for sign in (1, -1))
            result[:, 0, column] = (high - low) / (2 * step)
            result[:, 1, column] = (late - early) / (2 * step)
            if name in OPTIONAL:
                result[:, 3 + OPTIONAL.index(name), column] = 1.0
        return result
