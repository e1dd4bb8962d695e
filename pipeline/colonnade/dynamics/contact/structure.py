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
    load : float
        What it bears at rest, N.
    """

    sides: list[Interface]
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
        joint = _on_table(body, 0, law, rest[0], body.mass * gravity, body.height)
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
                own.append(_on_table(body, row, law, rest[row], mass * assembly.gravity, height))
            for below, share in supports(assembly, name).items():
                load, (base, top) = mass * share * assembly.gravity, _faces(placed, assembly.bodies[below])
                ends = (row, base, numbers[below], top), (numbers[below], top, row, base)
                sides = [_side(*each, law, grid) for each in ends]
                area = sum(float(side.at.node_area @ side.on_face) for side in sides)
                for k, side in enumerate(sides):
                    at = replace(side.at, node_mass=share * body.mass * side.at.node_area / area)
                    sides[k] = replace(side, at=at, law=law.under(load / area, height))
                own.append(Joint(sides, load))
            joints.append(own)
        together = [[numbers[other] for other in standing_on(assembly, name)] for name in numbers]
        angles = list(assembly.critical_angles.values())
        return cls(assembly.gravity, list(numbers), bodies, rest, joints, together, angles)

    def system(self, step: float) -> System:
        """Give the engine's arrays for a step, s."""
        sides, first = self.interfaces, self.bodies[0]
        radii = np.concatenate([side.at.ring_radii for side in sides])
        nodes = np.concatenate([side.at.nodes for side in sides])
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
            np.ascontiguousarray(first.modes),
            first.frequencies,
            propagators(first, 0.5 * step),
            float(np.sqrt((first.modes**2).sum(axis=(1, 2)).max(initial=0.0))),
        )


class _Face(NamedTuple):
    """
    A face in a joint: half lengths and middle along x and y in the upper body's axes, m; whether it is a circle; its
    height over its body's centre of mass, m; whether the nodes within the joint are its own, or only those of its edge.
    """

    sizes: Array
    middle: Array
    is_round: bool
    height: float
    bears: bool

    def at_edge(self, places: Array) -> Mask:
        """Say which places are at the edge, of a rectangle."""
        inside = self.sizes - np.abs(places - self.middle)
        return np.asarray((inside.min(axis=1) < 1e-6 * self.sizes.min()) & (not self.is_round))

    def nodes(self, other: _Face, grid: int) -> Nodes:
        """Give the nodes that can touch the other face, about the own centre of mass."""
        if self.is_round:
            places, areas = round_nodes(float(self.sizes[0]), RINGS)
            rings = slice(0 if self.bears else -1, None)
            places, areas, radii = places[rings], areas[rings], places[rings, 0]
        else:
            low = np.maximum(self.middle - self.sizes, other.middle - other.sizes)
            high = np.minimum(self.middle + self.sizes, other.middle + other.sizes)
            shared, shared_areas = grid_nodes(low, high, grid)
            kept = self.at_edge(shared) | (self.bears & ~other.at_edge(shared))
            # And those of its edges that bear only once it has slid onto another rectangle.
            whole, whole_areas = grid_nodes(self.middle - self.sizes, self.middle + self.sizes, grid)
            beyond = (np.abs(whole - other.middle) / other.sizes).max(axis=1)
            slides = self.at_edge(whole) & (beyond > 1.0 + 1e-6) & (beyond < (0.0 if other.is_round else SLIDES))
            places = np.concatenate((shared[kept], whole[slides])) - self.middle
            areas, radii = np.concatenate((shared_areas[kept], whole_areas[slides])), np.zeros(len(places))
        return Nodes(np.column_stack((places, np.full(len(places), self.height))), areas, areas, radii)


def _faces(upper: Placed, lower: Placed) -> tuple[_Face, _Face]:
    """Give the base of a block and the top of the one on which it stands."""
    above, below = upper.block.solid, lower.block.solid
    assert above is not None  # the assembly has seen to it
    assert below is not None
    base, top = np.array([upper.block.governing.half_width, above.half_depth]), np.array(below.top)
    offset = np.subtract(lower.position, upper.position)
    # The upper one has the nodes within, unless the lower one alone lies wholly in the joint.
    fits = [bool((np.abs(offset) + own <= other * (1.0 + 1e-6)).all()) for own, other in ((base, top), (top, base))]
    bears = fits[0] or not fits[1]
    return (
        _Face(base, np.zeros(2), above.base == "circle", -upper.centre_height, bears),
        _Face(top, offset, below.base == "circle", below.height - lower.centre_height, not bears),
    )


def _side(carrier: int, face: _Face, target: int, other: _Face, law: ContactLaw, grid: int) -> Interface:
    """Let the nodes of a body's face meet the face of another, which is turned over if that is the upper one."""
    turned = 1.0 if carrier > target else -1.0
    band = BAND * float(min(face.sizes.min(), other.sizes.min()))
    return Interface(
        at=face.nodes(other, grid),
        carrier=carrier,
        target=target,
        law=law,
        face=(*other.sizes, band, float(other.is_round), turned * other.height),
        apart=np.append(face.middle - other.middle, other.height - face.height),
    )


def _on_table(body: ContactBody, number: int, law: ContactLaw, rest: Array, load: float, height: float) -> Joint:
    law = law.under(load / float(body.node_area.sum()), height)
    side = Interface(at=body, carrier=number, target=TABLE, law=law, face=(inf, inf, 0.0, 0.0, 0.0), apart=rest)
    return Joint([side], load)


def _begins(counts: Sequence[int] | NDArray[np.int64]) -> NDArray[np.int64]:
    return np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
