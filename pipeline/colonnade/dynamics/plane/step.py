"""One step of a block that rocks under a sampled base motion, for either equation."""

from __future__ import annotations

from typing import NamedTuple


class Step(NamedTuple):
    """
    What a step comes to.

    Attributes
    ----------
    has_landed : bool
        Whether it ends in an impact.
    elapsed : float
        s into the sample, where it ends.
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
