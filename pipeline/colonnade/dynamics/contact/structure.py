"""Bodies and the interfaces between them, as the engine takes them: one body on the table, or an assembly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import atan2, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.dynamics.assembly import Assembly, Placed, carried, standing_on, supports
from colonnade.dynamics.contact.body import (
    GRID,
    RINGS,
    ContactBody,
    ContactLaw,
    Nodes,
    grid_nodes,
    propagators,
    rigid_body,
    round_nodes,
)
from colonnade.dynamics.contact.state import POINTS, TABLE, System
from colonnade.dynamics.contact.touch import inside

BAND = 2e-3
"""Of the smaller half length of two faces: the width in which a node fades at the edge of the other face."""

SLIDES = 1.5
"""Of the half widths of the other face: an edge that is further off its middle at rest does not slide onto it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Interface:
    """
    Nodes of one body against a face of another, or against the table.

    Attributes
    ----------
    at : Nodes
    carrier, target : int
        Of the bodies; the target may be `TABLE`.
    law : ContactLaw
        With its stiffness.
    face : tuple of float
        Half lengths of the target's face along x and y, m, the width of the band in which a node fades at its edge, 1
        if it is a circle, and its height over the target's centre of mass, out of the face, m.
    apart : ndarray, shape (3,)
        From the target's centre of mass to the carrier's at rest, m.
    """

    at: Nodes
    carrier: int
    target: int
    law: ContactLaw
    face: tuple[float, float, float, float, float]
    apart: Array

    @property
    def on_face(self) -> Array:
        """How much of each node is on the target's face at rest, shape (n,), of a ring in the mean over its circle."""
        circles = self.at.around(64) + self.apart
        return np.array([np.mean([inside(*self.face[:4], x, y) for x, y, _ in circle]) for circle in circles])


class Joint(NamedTuple):
    """
    Where one body stands on another or on the table.

    Attributes
    ----------
    sides : list of Interface
        Its nodes on what is below, and the nodes of that on its base.
    pole : tuple of float
        In the upper body's axes, m: the middle of the contact along x, its half width, and how far the base is below
        the centre of mass.
    load : float
        What it bears at rest, N.
    """

    sides: list[Interface]
    pole: tuple[float, float, float]
    load: float


@dataclass(frozen=True, eq=False)
class Structure:
    """
    What a run is made of.

    Attributes
    ----------
    gravity : float
        m/s².
    names : list of str
    bodies : list of ContactBody
        Their mass and inertia, and on the table their nodes.
    rest : ndarray, shape (b, 3)
        Where their centres of mass are at rest, m.
    joints : list of list of Joint
        Of each body, on what it stands.
    together : list of list of int
        The bodies that turn with each: itself and what stands on it alone.
    critical_angles : list of float
        α of each with these, rad.
    """

    gravity: float
    names: list[str]
    bodies: list[ContactBody]
    rest: Array
    joints: list[list[Joint]]
    together: list[list[int]]
    critical_angles: list[float]

    @property
    def interfaces(self) -> list[Interface]:
        """Of all joints."""
        return [side for joints in self.joints for joint in joints for side in joint.sides]

    @classmethod
    def of_body(cls, body: ContactBody, law: ContactLaw, gravity: float) -> Structure:
        """Let one body stand on the table."""
        rest = np.array([[0.0, 0.0, body.height]])
        joint = _on_table(body, 0, law.bearing(body, gravity), rest[0], body.mass * gravity)
        return cls(gravity, [""], [body], rest, [[joint]], [[0]], [atan2(body.half_width, body.height)])

    @classmethod
    def of_assembly(cls, assembly: Assembly, law: ContactLaw, *, grid: int = GRID) -> Structure:
        """Let the bodies of an assembly stand on each other, with nodes as `rigid_body` places them."""
        numbers = {name: number for number, name in enumerate(assembly.bodies)}
        bodies = [rigid_body(placed.block, grid=grid) for placed in assembly.bodies.values()]
        places = [placed.position for placed in assembly.bodies.values()]
        rest = np.column_stack((places, list(assembly.levels.values()) + np.array([body.height for body in bodies])))
        joints = []
        for row, (name, placed) in enumerate(assembly.bodies.items()):
            body, (mass, height), own = bodies[row], carried(assembly, name), []
            if not placed.on:
                weight = mass * assembly.gravity
                stiff = law.under(weight / float(body.node_area.sum()), height)
                own.append(_on_table(body, row, stiff, rest[row], weight))
            for below, share in supports(assembly, name).items():
                patch, load = _Patch(placed, assembly.bodies[below], grid), mass * share * assembly.gravity
                sides = patch.sides((row, numbers[below]), law)
                area = sum(float(side.at.node_area @ side.on_face) for side in sides)
                for k, side in enumerate(sides):
                    at = replace(side.at, node_mass=share * body.mass * side.at.node_area / area)
                    sides[k] = replace(side, at=at, law=law.under(load / area, height))
                own.append(Joint(sides, (*patch.across, body.height), load))
            joints.append(own)
        return cls(
            assembly.gravity,
            list(numbers),
            bodies,
            rest,
            joints,
            [[numbers[other] for other in standing_on(assembly, name)] for name in numbers],
            list(assembly.critical_angles.values()),
        )

    def system(self, step: float) -> System:
        """Give the engine's arrays for a step, s."""
        sides, joints, first = self.interfaces, [joint for own in self.joints for joint in own], self.bodies[0]
        radii = np.concatenate([side.at.ring_radii for side in sides])
        nodes = np.concatenate([side.at.nodes for side in sides])
        modes = first.modes if first.frequencies.size else np.zeros((len(nodes), 3, 0))
        on_table = [own[0].sides[0].target == TABLE for own in self.joints]
        bases = self.rest[:, 2] - [body.height for body in self.bodies]
        return System(
            float(self.gravity),
            float(sides[0].law.friction),
            np.array([body.mass for body in self.bodies]),
            np.array([body.inertia for body in self.bodies]),
            np.where(on_table, -inf, bases),
            np.array([side.carrier for side in sides]),
            np.array([side.target for side in sides]),
            np.array([side.face for side in sides]),
            _begins([len(side.at.nodes) for side in sides]),
            np.array([np.sqrt((side.at.nodes**2).sum(axis=1)).max(initial=0.0) for side in sides]),
            np.ascontiguousarray(nodes),
            radii,
            _begins(np.where(radii > 0.0, POINTS, 1)),
            np.concatenate([side.law.node_stiffness(side.at) for side in sides]),
            np.concatenate([side.law.node_damping(side.at) for side in sides]),
            np.array(np.polynomial.legendre.leggauss(POINTS)),
            _begins([len(joint.sides) for joint in joints]),
            np.array([joint.pole for joint in joints]),
            np.ascontiguousarray(modes),
            first.frequencies,
            propagators(first, 0.5 * step),
            float(np.sqrt((modes**2).sum(axis=(1, 2)).max(initial=0.0))),
        )


class _Patch:
    """Where a block stands on another: nodes of each on the face of the other, in the upper one's axes."""

    def __init__(self, upper: Placed, lower: Placed, grid: int) -> None:
        above, below = upper.block.solid, lower.block.solid
        assert above is not None  # the assembly has seen to it
        assert below is not None
        self._grid = grid
        self._offset = np.subtract(lower.position, upper.position)
        self._sizes = np.array([[upper.block.governing.half_width, above.half_depth], below.top])
        self._round = above.base == "circle", below.base == "circle"
        self._depths = -upper.centre_height, below.height - lower.centre_height
        self._low = np.maximum(-self._sizes[0], self._offset - self._sizes[1])
        self._high = np.minimum(self._sizes[0], self._offset + self._sizes[1])

    @property
    def across(self) -> tuple[float, float]:
        """Middle of the patch along x in the upper body's axes, and its half width, m."""
        return 0.5 * float(self._low[0] + self._high[0]), 0.5 * float(self._high[0] - self._low[0])

    def sides(self, bodies: tuple[int, int], law: ContactLaw) -> list[Interface]:
        """Give the nodes of the upper body on the lower one's top, those of that on the upper one's base."""
        band, apart = BAND * float(self._sizes.min()), np.append(self._offset, self._depths[0] - self._depths[1])
        found = []
        for which, other in ((0, 1), (1, 0)):
            nodes, areas = self._nodes(which)
            heights = np.full(len(nodes), self._depths[which])
            radii = nodes[:, 0] if self._round[which] else np.zeros(len(nodes))
            side = Interface(
                at=Nodes(np.column_stack((nodes, heights)), areas, areas, radii),
                carrier=bodies[which],
                target=bodies[other],
                law=law,
                face=(*self._sizes[other], band, float(self._round[other]), (self._depths[1], -self._depths[0])[which]),
                apart=(2.0 * which - 1.0) * apart,
            )
            found.append(side)
        return found

    def _nodes(self, which: int) -> tuple[Array, Array]:
        """Give the nodes along x and y of the upper (0) or the lower body (1) about its own middle, and their areas."""
        reach, size, origin = self._high - self._low, self._sizes[which], which * self._offset
        fits = [bool(np.allclose(reach, 2.0 * own, rtol=1e-6)) for own in self._sizes]
        if self._round[which]:
            nodes, areas = round_nodes(float(size[0]), RINGS)
            # Only the rim of one that is not the smaller face.
            return (nodes, areas) if fits[which] and not (which == 1 and fits[0]) else (nodes[-1:], areas[-1:])
        if which == 1 and self._round[0] and fits[0]:
            nodes, areas = grid_nodes(-size[0], size[0], size[1], self._grid)
            edge = self._at_edge(nodes + origin, 1)
            return nodes[edge], areas[edge]
        places, areas = grid_nodes(-0.5 * reach[0], 0.5 * reach[0], 0.5 * reach[1], self._grid)
        places = places + 0.5 * (self._low + self._high)
        # A node within the patch is the one's whose face is the patch; one at an edge is whose edge it is, or of both.
        on_upper, on_lower = self._at_edge(places, 0), self._at_edge(places, 1)
        own = on_lower | (fits[1] & ~on_upper) if which else on_upper | ~(on_lower | fits[1])
        nodes, areas = places[own], areas[own]
        if not any(self._round):
            # And those of its edges that bear only once it has slid onto the other.
            off, off_areas = grid_nodes(-size[0], size[0], size[1], self._grid)
            off = off + origin
            beyond = (np.abs(off - (1 - which) * self._offset) / self._sizes[1 - which]).max(axis=1)
            kept = self._at_edge(off, which) & (beyond > 1.0 + 1e-6) & (beyond < SLIDES)
            nodes, areas = np.concatenate((nodes, off[kept])), np.concatenate((areas, off_areas[kept]))
        return nodes - origin, areas

    def _at_edge(self, places: Array, which: int) -> Mask:
        """Say which places are at the edge of a rectangular face, the upper's (0) or the lower's (1)."""
        if self._round[which]:
            return np.zeros(len(places), dtype=bool)
        inside = self._sizes[which] - np.abs(places - which * self._offset)
        return np.asarray(inside.min(axis=1) < 1e-6 * self._sizes.min())


def _on_table(body: ContactBody, number: int, law: ContactLaw, rest: Array, load: float) -> Joint:
    side = Interface(at=body, carrier=number, target=TABLE, law=law, face=(inf, inf, 0.0, 0.0, 0.0), apart=rest)
    return Joint([side], (0.0, body.half_width, body.height), load)


def _begins(counts: Sequence[int] | NDArray[np.int64]) -> NDArray[np.int64]:
    return np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
