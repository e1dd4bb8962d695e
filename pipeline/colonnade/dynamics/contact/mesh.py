"""Meshes of eight-node bricks for prism, cylinder and truncated cone, standing on a base whose rim is shared."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Solid
from colonnade.dynamics.contact.body import ContactBody

Whole = NDArray[np.int64]

Mesh = Any
"""A `MeshHex` of scikit-fem, which has no types; lengths in m, the base at z = 0 and its centre at the origin."""

PRISM_ASPECT = 1.7
"""Longest over shortest edge of a brick that a grid of a prism is allowed for the sake of its number of nodes."""

ROUND_ASPECT = 2.0
"""The same of a round body, whose bricks cannot all be alike."""

CORE_SHARE = 0.55
"""Half width of the square core of a round section over its radius."""

CORE_BULGE = 0.5
"""How far the sides of the core are bent towards a circle: 0 not at all, 1 wholly."""


def mesh_of(solid: Solid, degrees_of_freedom: int) -> tuple[Mesh, str]:
    """Mesh a body with about so many degrees of freedom, three a node, and describe the mesh."""
    nodes = degrees_of_freedom / 3
    # What a section may be divided into.
    first, second = np.array(
        [(1, 1)] + [(i, j) for i in range(1, ceil(nodes / 4)) for j in range(1, ceil(nodes / (2 * (i + 1))))]
    ).T
    if solid.base == "rectangle":
        lengths = 2 * solid.top[0], 2 * solid.half_depth, solid.height
        edges = [lengths[0] / first, lengths[1] / second]
        x, y, layers = _nearest(first, second, (first + 1) * (second + 1), edges, nodes, lengths[2], PRISM_ASPECT)
        return prism_mesh(*lengths, (x, y, layers)), f"prism of {x} × {y} × {layers} bricks"
    lengths = 2 * solid.half_depth, 2 * solid.top[0], solid.height
    # No more rings than bricks along the core; edges at half height.
    first, second = first[second <= first], second[second <= first]
    radius = (lengths[0] + lengths[1]) / 4
    edges = [2 * CORE_SHARE * radius / first, pi * radius / (2 * first), (1 - CORE_SHARE) * radius / second]
    section = (first + 1) ** 2 + 4 * first * second
    core, rings, layers = _nearest(first, second, section, edges, nodes, lengths[2], ROUND_ASPECT)
    described = f"round body of {layers} layers, core {core} × {core}, {rings} rings of {4 * core}"
    return round_mesh(*lengths, (core, rings, layers)), described


def _nearest(
    first: Whole, second: Whole, section: Array, edges: list[Array], nodes: float, height: float, allowed: float
) -> tuple[int, int, int]:
    """
    Find the divisions of a section, and the layers, whose number of nodes is nearest to one asked for.

    Among those of bricks no longer than `allowed` times their shortest edge the nearest; of equals the most cubic
    bricks, then the finer ones. Where the body's proportions allow no such brick, the most cubic ones.
    """
    layers = np.maximum(1.0, np.floor(nodes / section - 1) + np.array([[0.0], [1.0]]))
    every = np.stack([*np.broadcast_arrays(*edges, layers)[:-1], height / layers])
    aspect, missing = every.max(axis=0) / every.min(axis=0), np.abs(section * (layers + 1) - nodes)
    rank = -first + 0 * layers, aspect.round(9), missing.round(9), np.maximum(aspect, allowed)
    best = np.lexsort([key.ravel() for key in rank])[0]
    section = best % first.size
    return int(first[section]), int(second[section]), int(layers.ravel()[best])


def prism_mesh(width: float, depth: float, height: float, divisions: tuple[int, int, int]) -> Mesh:
    """Divide a rectangular block into equal bricks, so many along x, y and z."""
    from skfem import MeshHex

    x, y, layers = divisions
    edges = np.linspace(-width / 2, width / 2, x + 1), np.linspace(-depth / 2, depth / 2, y + 1)
    return MeshHex.init_tensor(*edges, np.linspace(0.0, height, layers + 1))


def round_mesh(base_diameter: float, top_diameter: float, height: float, divisions: tuple[int, int, int]) -> Mesh:
    """
    Divide a cylinder or truncated cone into bricks: a square core within rings; divisions are bricks along a side of
    the core (the rim has four times as many), rings around it, and layers.

    The nodes of the rim lie on the true circle, so that the body rocks on its true edge; the section is the polygon
    through them, smaller than the disc by 2 (π/n)²/3 for n nodes (1.6 % with 20, 0.4 % with 40).
    """
    from skfem import MeshHex

    core, rings, layers = divisions
    section, quadrilaterals = _disc(core, rings)
    levels = np.linspace(0.0, 1.0, layers + 1)
    radii = (base_diameter + (top_diameter - base_diameter) * levels) / 2
    heights = np.broadcast_to(height * levels[:, None], (layers + 1, len(section)))
    points = np.stack((*np.moveaxis(section * radii[:, None, None], 2, 0), heights)).reshape(3, -1)
    near, right, left, far = (quadrilaterals + len(section) * np.arange(layers)[:, None, None]).reshape(-1, 4).T
    up = len(section)
    return MeshHex(points, np.stack((far + up, far, right + up, left + up, right, left, near + up, near)))


def _disc(core: int, rings: int) -> tuple[Array, Whole]:
    """Nodes and quadrilaterals of the unit disc; the rays of the rings stand at equal angles."""
    along = np.tan(pi / 4 * np.linspace(-1.0, 1.0, core + 1))
    x, y = (grid.ravel() for grid in np.meshgrid(along, along, indexing="ij"))
    level, distance = np.maximum(np.abs(x), np.abs(y)), np.hypot(x, y)
    bent = np.divide(level, distance, out=np.ones_like(level), where=distance > 0)
    square = CORE_SHARE * ((1 - CORE_BULGE) + CORE_BULGE * bent)[:, None] * np.column_stack((x, y))
    number = np.arange((core + 1) ** 2).reshape(core + 1, core + 1)
    edge = np.concatenate((number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]))
    inner = square[edge]
    rim = inner / np.hypot(*inner.T)[:, None]
    shares = np.arange(1, rings + 1)[:, None, None] / rings
    section = np.concatenate((square, (inner + shares * (rim - inner)).reshape(-1, 2)))
    loops = np.vstack((edge, square.shape[0] + np.arange(rings * edge.size).reshape(rings, -1)))
    inside = np.stack((number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]), axis=-1)
    within, without = loops[:-1], loops[1:]
    around = np.stack((within, without, np.roll(within, -1, axis=1), np.roll(without, -1, axis=1)), axis=-1)
    return section, np.concatenate((inside.reshape(-1, 4), around.reshape(-1, 4)))


RIM_NODES = 288
"""Nodes at which the rim of a meshed round body can touch: converged to a hundredth of α in its free rocking."""


def refine_rim(body: ContactBody, around: int = RIM_NODES) -> ContactBody:
    """
    Put more nodes on the rim of a round body, whose outermost nodes are on a circle, than its mesh has there: at least
    `around`, in a multiple of the mesh's own number.

    They stand on the circle at equal parts of each edge of the mesh. Between two of the mesh's nodes the modes are
    linear, as the displacements of its bricks are, and area and mass are those of the two in proportion: the rim's
    stiffness and damping are spread, not changed. The other nodes are as they were.
    """
    radii, angle = np.hypot(*body.nodes[:, :2].T), np.arctan2(body.nodes[:, 1], body.nodes[:, 0])
    on_rim = radii > (1.0 - 1e-6) * radii.max()
    rim, inner = np.flatnonzero(on_rim)[np.argsort(angle[on_rim])], np.flatnonzero(~on_rim)
    parts = ceil(around / rim.size)
    share = np.tile(np.arange(parts) / parts, rim.size)
    first, second = np.repeat(rim, parts), np.repeat(np.roll(rim, -1), parts)

    def spread(values: Array) -> Array:
        """Values of the inner nodes, then of those on the rim."""
        return np.concatenate((values[inner], ((1.0 - share) * values[first].T + share * values[second].T).T))

    nodes, count = spread(body.nodes), np.concatenate((np.ones(inner.size), np.full(share.size, parts)))
    turned = angle[first] + share * ((angle[second] - angle[first]) % (2.0 * pi))
    nodes[inner.size :, :2] = radii.max() * np.column_stack((np.cos(turned), np.sin(turned)))
    return replace(
        body,
        nodes=nodes,
        node_mass=spread(body.node_mass) / count,
        node_area=spread(body.node_area) / count,
        ring_radii=np.zeros(len(nodes)),
        modes=spread(body.modes),
        description=f"{body.description}; {share.size} nodes on the rim",
    )
