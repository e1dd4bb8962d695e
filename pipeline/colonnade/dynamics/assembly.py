"""Blocks that stand on each other: a column of drums, a frame, a colonnade."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from math import cos

import numpy as np

from colonnade.dynamics.block import MOST_COLUMNS, Block
from colonnade.units.text import Digested
from colonnade.validation import described, instance, number, samples, whole

LEVEL = 1e-6
"""m: tops that one block stands on may differ by as much."""


@dataclass(frozen=True)
class Placed:
    """
    A block and where it stands.

    Attributes
    ----------
    block : Block
    on : tuple of str, optional
        Names of the blocks that it stands on; none: the table.
    position : (float, float), optional
        Of the middle of its base at rest, along x and y of the table, m.

    Examples
    --------
    >>> drum = Block.cylinder(diameter=0.3, height=0.2, mass=34.0)
    >>> upper = Placed(drum, on="low", position=(0.01, 0.0))
    >>> upper.on, upper.position, round(upper.centre_height, 3)
    (('low',), (0.01, 0.0), 0.1)
    >>> Assembly({"low": Placed(drum), "high": upper}).levels
    {'low': 0.0, 'high': 0.2}
    """

    block: Block
    on: tuple[str, ...] = ()
    position: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        instance("block", self.block, Block)
        on = (self.on,) if isinstance(self.on, str) else self.on
        if not isinstance(on, tuple | list) or not all(isinstance(name, str) for name in on):
            raise ValueError(f"on is {described(on)}; names of bodies were expected")
        object.__setattr__(self, "on", tuple(on))
        position = samples("position", self.position, fewest=2)
        if position.size != 2:
            raise ValueError(f"position has {position.size} numbers; x and y in m were expected")
        object.__setattr__(self, "position", (float(position[0]), float(position[1])))

    @property
    def centre_height(self) -> float:
        """Height of the centre of mass above the base, m."""
        sides = self.block.sides
        return sum(side.pole_distance * cos(side.critical_angle) for side in sides) / len(sides)


@dataclass(frozen=True, repr=False, eq=False)
class Assembly(Digested):
    """
    Blocks on each other and on the table.

    Attributes
    ----------
    bodies : mapping of str to Placed
        By name, in any order.

    Raises
    ------
    ValueError
        If a name that a block stands on is unknown, blocks stand on each other in a circle, tops are not at one level,
        a top is not known or does not reach under the block, or gravity differs.

    Examples
    --------
    >>> drum = Block.cylinder(diameter=0.3, height=0.2, mass=34.0)
    >>> column = Assembly.stack(d1=drum, d2=drum, d3=drum)
    >>> list(column.bodies), round(column.height, 3)
    (['d1', 'd2', 'd3'], 0.6)
    >>> round(column.critical_angles["d1"], 4), round(column.critical_angles["d3"], 4)
    (0.4636, 0.9828)
    >>> column.gravity, column.levels["d2"], column
    (9.81, 0.2, <Assembly: bodies d1; d2; d3, height 0.6 m, gravity 9.81 m/s²>)
    >>> beam = Block.prism(width=1.0, depth=0.3, height=0.2, mass=150.0)
    >>> list(Assembly.frame(drum, beam, span=0.9).bodies)
    ['left', 'right', 'beam']
    >>> row = Assembly.colonnade(drum, beam, columns=3, spacing=1.0)
    >>> list(row.bodies), row.bodies["beam2"].on
    (['column1', 'column2', 'column3', 'beam1', 'beam2'], ('column2', 'column3'))
    """

    _ESSENCE = "bodies, height m, gravity m/s²"

    bodies: Mapping[str, Placed]

    def __post_init__(self) -> None:
        if not isinstance(self.bodies, Mapping) or not self.bodies:
            raise ValueError(
                f"bodies is {described(self.bodies)}; at least one block by name was expected, as stack(drum=block)"
            )
        for name, body in self.bodies.items():
            instance(name, body, Placed)
            for below in body.on:
                if below not in self.bodies:
                    raise ValueError(
                        f'"{name}" stands on "{below}", which is not a body of this assembly. '
                        f"Expected one of: {', '.join(self.bodies)}"
                    )
                self._expect_top(name, below)
        if len({body.block.gravity for body in self.bodies.values()}) > 1:
            raise ValueError("The blocks have different values of gravity; one was expected")
        try:
            order = list(TopologicalSorter({name: body.on for name, body in self.bodies.items()}).static_order())
        except CycleError as error:
            rest = ", ".join(sorted(set(error.args[1])))
            raise ValueError(f"{rest} stand on each other in a circle; one on the table was expected") from None
        object.__setattr__(self, "bodies", {name: self.bodies[name] for name in order})
        for name, body in self.bodies.items():
            tops = [self.levels[below] + self._height(below) for below in body.on]
            if tops and max(tops) - min(tops) > LEVEL:
                found = ", ".join(f"{top:.6g}" for top in tops)
                raise ValueError(f'The tops under "{name}" are at {found} m; one level was expected')

    def _height(self, name: str) -> float:
        solid = self.bodies[name].block.solid
        return 0.0 if solid is None else solid.height

    def _expect_top(self, name: str, below: str) -> None:
        """Refuse a block on one whose top is not known, or does not reach under it."""
        upper, lower = self.bodies[name].block, self.bodies[below].block
        if lower.solid is None or upper.solid is None or not lower.solid.height > 0.0:
            raise ValueError(
                f'"{name}" stands on "{below}", and the height or depth of one is not known. '
                "Blocks from their dimensions were expected: Block.prism, Block.cylinder or Block.cone"
            )
        half = upper.governing.half_width, upper.solid.half_depth
        for axis, own, other in zip(range(2), half, lower.solid.top, strict=True):
            apart = abs(self.bodies[name].position[axis] - self.bodies[below].position[axis])
            if not apart < own + other:
                raise ValueError(
                    f'"{name}" stands on "{below}", whose top does not reach under it: their middles are {apart:.4g} m '
                    f"apart along {'xy'[axis]}, and less than {own + other:.4g} m was expected"
                )

    @classmethod
    def stack(cls, **blocks: Block) -> Assembly:
        """
        Put blocks on each other.

        Parameters
        ----------
        **blocks : Block
            By name, from the bottom to the top.

        Returns
        -------
        assembly : Assembly
        """
        names = [name for name in blocks if instance(name, blocks[name], Block)]
        return cls({name: Placed(blocks[name], tuple(names[max(i - 1, 0) : i])) for i, name in enumerate(names)})

    @classmethod
    def frame(cls, column: Block | Assembly, beam: Block, *, span: float) -> Assembly:
        """
        Put a beam on two equal columns.

        Parameters
        ----------
        column : Block or Assembly
            A block, or a stack of blocks.
        beam : Block
        span : float
            Distance of the axes of the columns, m.

        Returns
        -------
        assembly : Assembly
            Of "left", "right" and "beam"; of columns of several blocks "left.NAME" and "right.NAME".
        """
        span = number("span", span, "a positive length in m", above=0.0)
        return cls(_under_beams(column, {"left": -0.5 * span, "right": 0.5 * span}, beam, ["beam"]))

    @classmethod
    def colonnade(cls, column: Block | Assembly, beam: Block, *, columns: int, spacing: float) -> Assembly:
        """
        Put beams on a row of equal columns, each from the axis of one column to that of the next.

        Parameters
        ----------
        column : Block or Assembly
            A block, or a stack of blocks.
        beam : Block
        columns : int
            At least 2.
        spacing : float
            Distance of the axes of neighbours, m.

        Returns
        -------
        assembly : Assembly
            Of "column1", "column2", … and "beam1", … between them; of columns of several blocks "column1.NAME".
        """
        columns = whole("columns", columns, 2, MOST_COLUMNS)
        spacing = number("spacing", spacing, "a positive length in m", above=0.0)
        places = {f"column{i + 1}": (i - 0.5 * (columns - 1)) * spacing for i in range(columns)}
        return cls(_under_beams(column, places, beam, [f"beam{i}" for i in range(1, columns)]))

    @property
    def gravity(self) -> float:
        """m/s²."""
        return next(iter(self.bodies.values())).block.gravity

    @cached_property
    def levels(self) -> dict[str, float]:
        """Height of the base of each body above the table at rest, m."""
        levels: dict[str, float] = {}
        for name in self.bodies:
            levels[name] = max((levels[below] + self._height(below) for below in self.bodies[name].on), default=0.0)
        return levels

    @property
    def height(self) -> float:
        """Of all, m: of the highest top."""
        return max(self.levels[name] + self._height(name) for name in self.bodies)

    @cached_property
    def critical_angles(self) -> dict[str, float]:
        """α of each body with all that stands on it alone, rad: the turn that brings their centre above the edge."""
        return {name: as_one(self, name).critical_angle for name in self.bodies}


def supports(assembly: Assembly, name: str) -> dict[str, float]:
    """
    Return what a body stands on, and the share of its weight that each bears.

    Notes
    -----
    By statics with two of them; with more, the shares of least squares among those in balance.
    """
    on, place = assembly.bodies[name].on, assembly.bodies[name].position
    if len(on) < 2:
        return dict.fromkeys(on, 1.0)
    arms = np.array([assembly.bodies[below].position for below in on]) - place
    shares = np.linalg.lstsq(np.vstack((np.ones(len(on)), arms.T)), np.array([1.0, 0.0, 0.0]), rcond=None)[0]
    return dict(zip(on, np.clip(shares, 0.05, 1.0).tolist(), strict=True))


def carried(assembly: Assembly, name: str) -> tuple[float, float]:
    """Return the mass (kg) of a body with its share of all on it, and the height (m) of their centre above its base."""
    body = assembly.bodies[name]
    mass, moment = body.block.mass, body.block.mass * body.centre_height
    for other, placed in assembly.bodies.items():
        if name in placed.on:
            above, height = carried(assembly, other)
            share = supports(assembly, other)[name] * above
            mass, moment = mass + share, moment + share * (assembly.levels[other] - assembly.levels[name] + height)
    return mass, moment / mass


def standing_on(assembly: Assembly, name: str) -> tuple[str, ...]:
    """Return a body and all that stands on it alone, from the bottom to the top."""
    found = [name]
    for other, body in assembly.bodies.items():
        if body.on and set(body.on) <= set(found):
            found.append(other)
    return tuple(found)


def is_frame(assembly: Assembly) -> bool:
    """Whether it is one beam on equal columns of one block each, which rock as one block."""
    columns = [name for name, body in assembly.bodies.items() if not body.on]
    beams = [body for body in assembly.bodies.values() if body.on]
    blocks = [assembly.bodies[name].block for name in columns]
    alike = len(beams) == 1 and set(beams[0].on) == set(columns) and all(block == blocks[0] for block in blocks)
    return alike and len(columns) > 1


def as_one(assembly: Assembly, name: str | None = None) -> Block:
    """
    Return the block as which bodies rock that keep together.

    Parameters
    ----------
    assembly : Assembly
    name : str, optional
        A body, which turns with all that stands on it alone as one rigid block. Default: the first on the table, or of
        a frame the block of `Block.frame`.

    Raises
    ------
    ValueError
        If the columns of a frame are not upright prisms or cylinders.

    Examples
    --------
    >>> drum = Block.prism(width=0.3, depth=0.3, height=0.2, mass=40.0)
    >>> column = Assembly.stack(low=drum, high=drum)
    >>> whole = Block.prism(width=0.3, depth=0.3, height=0.4, mass=80.0)
    >>> abs(as_one(column).p / whole.p - 1) < 1e-12, as_one(column, "high").p == drum.p
    (True, True)
    >>> beam = Block.prism(width=1.0, depth=0.3, height=0.1, mass=80.0)
    >>> as_one(Assembly.frame(drum, beam, span=0.9)) == Block.frame(drum, beam_mass=80.0)
    True
    """
    lowest = next(iter(assembly.bodies)) if name is None else name
    if name is None and is_frame(assembly):
        *columns, beam = assembly.bodies.values()
        return Block.frame(columns[0].block, beam_mass=beam.block.mass, columns=len(columns))
    together = standing_on(assembly, lowest)
    base = assembly.bodies[lowest]
    if len(together) == 1:
        return base.block
    parts = [(assembly.bodies[each], assembly.levels[each] - assembly.levels[lowest]) for each in together]
    places = np.array([(body.position[0] - base.position[0], level + body.centre_height) for body, level in parts])
    masses = np.array([body.block.mass for body, _ in parts])
    x, z = (masses @ places / masses.sum()).tolist()
    own = [body.block.governing.inertia - body.block.mass * body.block.governing.pole_distance**2 for body, _ in parts]
    poles = base.block.governing.half_width * np.array([-1.0, 1.0])
    around = [sum(own) + float(masses @ (((places - (pole, 0.0)) ** 2).sum(axis=1))) for pole in poles]
    if abs(x) < LEVEL:
        x, around[1] = 0.0, around[0]
    arms = np.abs(poles - x)
    return Block.measured(
        mass=float(masses.sum()),
        critical_angle=np.arctan2(arms, z),
        pole_distance=np.hypot(arms, z),
        inertia=(around[0], around[1]),
        gravity=assembly.gravity,
    )


def _under_beams(
    column: Block | Assembly, places: Mapping[str, float], beam: Block, beams: Iterable[str]
) -> dict[str, Placed]:
    """Place columns, or their blocks, at x by name, and beams from the top of each to that of the next."""
    bodies: dict[str, Placed] = {}
    tops: list[str] = []
    for name, x in places.items():
        if isinstance(column, Block):
            bodies[name] = Placed(column, (), (x, 0.0))
        else:
            for own, body in instance("column", column, Assembly).bodies.items():
                on = tuple(f"{name}.{below}" for below in body.on)
                bodies[f"{name}.{own}"] = Placed(body.block, on, (body.position[0] + x, body.position[1]))
        tops.append(list(bodies)[-1])
    instance("beam", beam, Block)
    for name, on, ends in zip(beams, pairwise(tops), pairwise(places.values()), strict=True):
        bodies[name] = Placed(beam, on, (0.5 * sum(ends), 0.0))
    return bodies
