"""What is drawn: a specimen's outline and what it rocks about, and its transducers."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos
from typing import Literal, NamedTuple

from colonnade.dynamics.block import Block

Point = tuple[float, float, float]
"""x, y, z in m from the centre of the base, or a direction."""


class Body(NamedTuple):
    """
    A specimen.

    Attributes
    ----------
    base : {"rectangle", "circle"}
    width, depth : (float, float)
        Along x and y, of the base and of the top, m; of a round body its diameters.
    height : float
        m.
    is_known : bool
        Whether this is its outline, and not one that stands in for it.
    rocking : Rocking or None
        None if it is not known.
    words : sequence of str
        What is written beside it.
    """

    base: Literal["rectangle", "circle"]
    width: tuple[float, float]
    depth: tuple[float, float]
    height: float
    is_known: bool
    rocking: Rocking | None
    words: Sequence[str] = ()


class Rocking(NamedTuple):
    """Where it rocks: x of the poles for θ < 0 and θ > 0, and the centre of mass (x, z), m; α of both sides, rad."""

    poles: tuple[float, float]
    centre: tuple[float, float]
    critical_angles: tuple[float, float]

    @classmethod
    def of(cls, block: Block) -> Rocking:
        """Lay a block out about the middle between its poles."""
        left, right = block.negative.half_width, block.positive.half_width
        height = sum(side.pole_distance * cos(side.critical_angle) for side in block.sides) / 2
        angles = (block.negative.critical_angle, block.positive.critical_angle)
        return cls((-(left + right) / 2, (left + right) / 2), ((left - right) / 2, height), angles)


MARKER = "marker"
"""Quantity of a point that is followed along three axes."""


class Transducer(NamedTuple):
    """
    A channel, as it is fixed and reads.

    Attributes
    ----------
    name, quantity : str
    on : str
        "specimen", "table" or "ground".
    direction : Point or None
        Of a positive reading; of an angle its axis. None if it is not known, or of a marker.
    at : Point or None
        None if it is not known.
    relative_to : str
        "table" or "ground", empty if it is absolute or not known.
    normal, anchor : Point or None
        Of the face that a laser looks at; the fixed end of a wire.
    is_laser : bool
    """

    name: str
    quantity: str
    on: str
    direction: Point | None
    at: Point | None = None
    relative_to: str = ""
    normal: Point | None = None
    anchor: Point | None = None
    is_laser: bool = False

    @property
    def is_turn(self) -> bool:
        """Whether it reads a rotation about its direction."""
        return self.quantity in ("angle", "angular_velocity")
