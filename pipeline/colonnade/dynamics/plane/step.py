"""One step of a block that rocks between two samples of a base motion, for either equation."""

from __future__ import annotations

from typing import NamedTuple


class Interval(NamedTuple):
    """
    From one sample of the base motion to the next.

    Attributes
    ----------
    begin, length : float
        s on the clock of the motion; s.
    base, next_base : float
        a/g at its ends, linear in between.
    weight, next_weight : float
        1 + v/g with the vertical acceleration v, likewise.
    """

    begin: float
    length: float
    base: float
    next_base: float
    weight: float
    next_weight: float


class Step(NamedTuple):
    """
    What a step comes to.

    Attributes
    ----------
    has_landed : bool
        Whether it ends in an impact.
    elapsed : float
        s into the interval, where it ends.
    angle, velocity : float
        θ (rad) and ω (rad/s) there; before the impact.
    passed : float
        s on the clock of the motion, when |θ| last passed α outwards; NaN if it did not in this step.
    is_past : bool
        Whether the block cannot come back.
    """

    has_landed: bool
    elapsed: float
    angle: float
    velocity: float
    passed: float
    is_past: bool
