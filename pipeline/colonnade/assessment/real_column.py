"""The real column, what is uncertain about it, and the values that are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.uncertainty import member_block, member_restitution
from colonnade.validation import instance, number, sided

Limits = tuple[float, float]

UNCERTAIN = ("restitution", "critical_angle", "p", "friction")
"""What may have a range, in the order in which it is drawn."""

MOST_DRAWS = 1_000_000


@dataclass(frozen=True)
class RealColumn:
    """
    A real column and the ranges of what is not exactly known.

    Attributes
    ----------
    block : Block
        With nothing varied.
    restitution : float or pair of float
        e, the pair for impacts that end an arc at (θ < 0, θ > 0).
    friction : float or None
        Coefficient of friction on its base; None if sliding is not judged.
    restitution_range, critical_angle_range, p_range, friction_range : pair of float or None
        Limits between which it is drawn uniformly; None for an exact value. α in rad and p in rad/s of the governing
        side: the other side changes in proportion. Of a pair e, the mean: both sides change alike.

    Raises
    ------
    ValueError
        If a value or a limit is out of its range, or limits do not rise.
    """

    block: Block
    restitution: Sided
    friction: float | None = None
    restitution_range: Limits | None = None
    critical_angle_range: Limits | None = None
    p_range: Limits | None = None
    friction_range: Limits | None = None

    def __post_init__(self) -> None:
        instance("block", self.block, Block)
        sided("restitution", self.restitution, "a number between 0 and 1", low=0.0, high=1.0)
        if self.friction is not None:
            number("friction", self.friction, "a coefficient from 0 on", low=0.0)
        _limits("restitution_range", self.restitution_range, "numbers between 0 and 1", low=0.0, high=1.0)
        angles = "angles between 0 and π/2 rad"
        _limits("critical_angle_range", self.critical_angle_range, angles, above=0.0, below=pi / 2)
        _limits("p_range", self.p_range, "positive numbers of rad/s", above=0.0)
        _limits("friction_range", self.friction_range, "coefficients from 0 on", low=0.0)

    @property
    def is_symmetric(self) -> bool:
        """Whether a motion and its opposite do the same to it."""
        negative, positive = pair(self.restitution)
        return self.block.is_symmetric and negative == positive

    @property
    def central(self) -> tuple[float, float, float, float]:
        """What is drawn from, with nothing varied, in the order of `UNCERTAIN`; NaN without friction."""
        e = 0.5 * sum(pair(self.restitution))
        return e, self.block.critical_angle, self.block.p, np.nan if self.friction is None else self.friction

    @property
    def ranges(self) -> tuple[Limits | None, ...]:
        """In the order of `UNCERTAIN`."""
        return self.restitution_range, self.critical_angle_range, self.p_range, self.friction_range


def draw(column: RealColumn, count: int, seed: int = 0, *, record: int = 0) -> Array:
    """
    Draw columns within the ranges of a real one.

    Parameters
    ----------
    column : RealColumn
    count : int
        Columns besides that with nothing varied; none are drawn if nothing has a range.
    seed : int, optional
        Column k draws from a stream of its own, of (seed, record, k): the same whatever the count, and whichever ranges
        the others have.
    record : int, optional
        Number of the record under which they are run: each has columns of its own.

    Returns
    -------
    draws : ndarray, shape (1 + count, 4)
        By `UNCERTAIN`: e, α (rad), p (rad/s), coefficient of friction (NaN if there is none). In the first row nothing
        is varied.
    """
    central = column.central
    keys = [(record, number_) for number_ in range(1, count + 1 if any(column.ranges) else 1)]
    streams = [np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key)) for key in keys]
    shares = np.array([stream.random(len(UNCERTAIN)) for stream in streams]).reshape(-1, len(UNCERTAIN))
    low, high = np.transpose([limits or (value, value) for value, limits in zip(central, column.ranges, strict=True)])
    return np.vstack((central, low + shares * (high - low)))


def drawn_column(column: RealColumn, values: Array) -> tuple[Block, tuple[float, float]]:
    """Return the block of one draw, shape (4,), and its e on both sides."""
    e, critical_angle, p, _friction = values.tolist()
    usual_e, usual_angle, usual_p, _friction = column.central
    block = member_block(column.block, critical_angle / usual_angle, p / usual_p)
    return block, member_restitution(column.restitution, e - usual_e)


def _limits(name: str, limits: Limits | None, expected: str, **bounds: float) -> None:
    if limits is None:
        return
    low, high = sided(name, limits, expected, **bounds)
    if not low <= high:
        raise ValueError(f"{name} goes from {low:g} to {high:g}; limits in rising order were expected")
