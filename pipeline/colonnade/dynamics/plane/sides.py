"""The block in the form that the kernels of the plane models use: the numbers of its two sides."""

from __future__ import annotations

from typing import NamedTuple

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.restitution_law import RestitutionLaw, restitution_table

Pair = tuple[float, float]
"""Of the side θ < 0 and of θ > 0."""


class Sides(NamedTuple):
    """
    The block on its sides θ < 0 and θ > 0: α (rad), p (rad/s); e as of `restitution_of`.

    After an impact whose next arc, under the base acceleration of that instant, would not rise above `rest_angle` α,
    the block is at rest until the base acceleration uplifts it again.
    """

    critical: Pair
    p: Pair
    restitution: Array
    speeds: Array
    rest_angle: float


@kernel
def of_side(pair: Pair, here: int) -> float:
    """Choose by side; compiled, an index that is not constant branches and may raise."""
    return pair[1] if here else pair[0]


def sides_of(block: Block, restitution: Pair | RestitutionLaw, rest_angle: float) -> Sides:
    """Put a block, its restitution and its rule of rest into the form that the kernels take."""
    speeds, values = restitution_table(restitution)
    left, right = block.sides
    critical, p = (left.critical_angle, right.critical_angle), (block.side_p(left), block.side_p(right))
    return Sides(critical, p, values, speeds, rest_angle)
