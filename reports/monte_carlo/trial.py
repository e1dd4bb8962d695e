"""One record through the identification, beside its truth, its bound and the naive way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import colonnade
from monte_carlo.bound import cramer_rao_error
from monte_carlo.design import LEVELS, Draw, draw
from monte_carlo.naive import naive_restitution


@dataclass(frozen=True)
class Trial:
    """
    What became of one record.

    Attributes
    ----------
    draw : Draw
    value, low, high : float
        The recommended e and its interval; NaN where refused.
    naive, bound : float
        e read off naively; the Cramér–Rao error.
    estimates : dict of str to (float, float, float)
        Value and interval of every estimator; NaN where it refused.
    recommended, reason : str
        Name of the recommended estimator; why refused.
    """

    draw: Draw
    value: float
    low: float
    high: float
    naive: float
    bound: float
    estimates: dict[str, tuple[float, float, float]]
    recommended: str
    reason: str

    @property
    def error(self) -> float:
        """Of the recommended e."""
        return self.value - self.draw.restitution

    @property
    def holds(self) -> bool:
        """Whether the interval holds the truth."""
        return self.low <= self.draw.restitution <= self.high

    @property
    def answered(self) -> bool:
        """Whether an e was recommended."""
        return bool(np.isfinite(self.value))


def run(seed: int, number: int, levels: dict[str, tuple[float, ...]] = LEVELS) -> Trial:
    """Draw a record, identify its e, and keep what is needed to judge that."""
    drawn = draw(seed, number, levels)
    time, angle = drawn.record()
    found = colonnade.identify_restitution(time, angle, drawn.block, lowpass=drawn.cutoff)
    return Trial(
        drawn,
        *(_number(value) for value in (found.value, found.low, found.high)),
        naive_restitution(angle, drawn.block.critical_angle),
        cramer_rao_error(drawn),
        {each.name: tuple(_number(value) for value in (each.value, each.low, each.high)) for each in found.estimates},
        found.recommended,
        found.reason,
    )


def _number(value: float | None) -> float:
    return np.nan if value is None else value
