"""Meshes of eight-node bricks for prism, cylinder and truncated cone, standing on a base whose rim is shared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import ceil, floor, pi

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody

Whole = NDArray[np.int64]

PRISM_ASPECT = 1.7
"""Longest over shortest edge of a brick that a grid of a prism is allowed for the sake of its number of nodes."""

ROUND_ASPECT = 2.0
"""The same of a round body, whose bricks cannot all be alike."""

CORE_SHARE = 0.55
"""Half width of the square core of a round section over its radius."""

CORE_BULGE = 0.5
"""How far the sides of the core are bent towards a circle: 0 not at all, 1 wholly."""


@dataclass(frozen=True)
class Mesh:
    """
    Bricks in layers from the base upwards.

    Attributes
    ----------
    points : ndarray, shape (n, 3)
        Nodes, m; the base is at z = 0, its centre at the origin. Numbered layer by layer, the lowest first.
    cells : ndarray, shape (e, 8)
        Corners of each brick in scikit-fem's order: top where the first corner is, base where the last one is.
    base : ndarray, shape (b,)
        The nodes at z = 0.
    description : str
    """

    points: Array
    cells: Whole
    base: Whole
    description: str


def prism_mesh(width: float, depth: float, height: float, divisions: tuple[int, int, int]) -> Mesh:
    """Divide a rectangular block (lengths in m) into equal bricks, so many along x, y and z."""
    along_x, along_y, layers = divisions
    edges = (np.linspace(-size / 2, size / 2, bricks + 1) for size, bricks in ((width, along_x), (depth, along_y)))
    section = np.stack(np.meshgrid(*edges, indexing="ij"), axis=-1).reshape(-1, 2)
    levels, description = np.linspace(0.0, height, layers + 1), f"prism of {along_x} × {along_y} × {layers} bricks"
    return _raise(section, _grid_quadrilaterals(along_x, along_y), levels, np.ones(layers + 1), description)


def round_mesh(base_diameter: float, top_diameter: float, height: float, divisions: tuple[int, int, int]) -> Mesh:
    """
    Divide a cylinder or truncated cone (lengths in m) into bricks: a square core within rings; divisions are bricks
    along a side of the core (the rim has four times as many), rings around it, and layers.

    The nodes of the rim lie on the true circle, so that the body rocks on its true edge; the section is the polygon
    through them, smaller than the disc by 2 (π/n)²/3 for n nodes (1.6 % with 20, 0.4 % with 40).
    """
    core, rings, layers = divisions
    section, quadrilaterals = _disc(core, rings)
    levels = np.linspace(0.0, 1.0, layers + 1)
    radii = (base_diameter + (top_diameter - base_diameter) * levels) / 2
    description = f"round body of {layers} layers, core {core} × {core}, {rings} rings of {4 * core}"
    return _raise(section, quadrilaterals, height * levels, radii, description)


def prism_divisions(width: float, depth: float, height: float, degrees_of_freedom: int) -> tuple[int, int, int]:
    """
    Find the bricks along x, y, z of the prism's grid whose number of degrees of freedom is nearest to one asked for.

    Among grids of bricks no longer than `PRISM_ASPECT` times their shortest edge the one with the nearest number; of
    equals the one with the most cubic bricks, then the finer one along x. Where the body's proportions allow no such
    brick, the most cubic ones.
    """
    nodes = degrees_of_freedom / 3
    grids = (
        ((x + 1) * (y + 1), (width / x, depth / y), (x, y))
        for x in range(1, ceil(nodes / 4))
        for y in range(1, ceil(nodes / (2 * (x + 1))))
    )
    return _nearest(grids, nodes, height, PRISM_ASPECT)


def round_divisions(
    base_diameter: float, top_diameter: float, height: float, degrees_of_freedom: int
) -> tuple[int, int, int]:
    """Find core, rings and layers of a round body likewise, with edges at half height and `ROUND_ASPECT`."""
    radius, nodes = (base_diameter + top_diameter) / 4, degrees_of_freedom / 3
    discs = (
        (
            (core + 1) ** 2 + 4 * core * rings,
            (2 * CORE_SHARE * radius / core, pi * radius / (2 * core), (1 - CORE_SHARE) * radius / rings),
            (core, rings),
        )
        for core in range(1, ceil(nodes**0.5))
        for rings in range(1, core + 1)
    )
    return _nearest(discs, nodes, height, ROUND_ASPECT)


def _nearest(
    sections: Iterable[tuple[int, tuple[float, ...], tuple[int, int]]], nodes: float, height: float, allowed: float
) -> tuple[int, int, int]:
    """Find the best of sections, each with its nodes, edges (m) and divisions, and its number of layers."""
    found = []
    for section, edges, (first, second) in sections:
        around = nodes / section - 1
        for layers in {floor(around), ceil(around)} - {-1, 0}:
            every = (*edges, height / layers)
            aspect, missing = max(every) / min(every), abs(section * (layers + 1) - nodes)
            rank = max(aspect, allowed), round(missing, 9), round(aspect, 9)
            found.append((rank, -first, (first, second, layers)))
    return min(found)[-1] if found else (1, 1, 1)


def _grid_quadrilaterals(along_x: int, along_y: int) -> Whole:
    """Corners (0,0), (1,0), (0,1), (1,1) of each square of a grid numbered with y fastest."""
    i, j = np.meshgrid(np.arange(along_x), np.arange(along_y), indexing="ij")
    first = (i * (along_y + 1) + j).ravel()
    return np.column_stack((first, first + along_y + 1, first + 1, first + along_y + 2)).astype(np.int64)


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
    within, without = loops[:-1], loops[1:]
    around = np.stack((within, without, np.roll(within, -1, axis=1), np.roll(without, -1, axis=1)), axis=-1)
    return section, np.concatenate((_grid_quadrilaterals(core, core), around.reshape(-1, 4)))


def _raise(section: Array, quadrilaterals: Whole, levels: Array, scales: Array, description: str) -> Mesh:
    """Stack a section, scaled at each level, into bricks."""
    count = len(section)
    plane = section[None] * scales[:, None, None]
    heights = np.broadcast_to(levels[:, None, None], (levels.size, count, 1))
    points = np.concatenate((plane, heights), axis=2).reshape(-1, 3)
    lower = (quadrilaterals[None] + count * np.arange(levels.size - 1)[:, None, None]).reshape(-1, 4)
    near, right, left, far = lower.T
    cells = np.column_stack((far + count, far, right + count, left + count, right, left, near + count, near))
    return Mesh(points, cells, np.arange(count), f"{description}, {3 * len(points)} degrees of freedom")


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
    radii = np.hypot(body.nodes[:, 0], body.nodes[:, 1])
    rim = np.flatnonzero(radii > (1.0 - 1e-6) * radii.max())
    if rim.size < 3:
        raise ValueError(f"The rim has {rim.size} nodes; at least 3 were expected")
    angle = np.arctan2(body.nodes[rim, 1], body.nodes[rim, 0])
    rim, angle = rim[np.argsort(angle)], np.sort(angle)
    parts = max(1, ceil(around / rim.size))
    share = np.tile(np.arange(parts) / parts, rim.size)
    first, second = np.repeat(rim, parts), np.repeat(np.roll(rim, -1), parts)
    width = np.repeat(np.diff(angle, append=angle[0] + 2.0 * np.pi), parts)
    turned = np.repeat(angle, parts) + share * width
    height = (1.0 - share) * body.nodes[first, 2] + share * body.nodes[second, 2]
    points = np.column_stack((radii.max() * np.cos(turned), radii.max() * np.sin(turned), height))

    inner = np.setdiff1d(np.arange(len(radii)), rim)

    def spread(values: Array) -> Array:
        return np.concatenate((values[inner], ((1.0 - share) * values[first] + share * values[second]) / parts))

    along = share[:, None, None]
    modes = (1.0 - along) * body.modes[first] + along * body.modes[second]
    return replace(
        body,
        nodes=np.vstack((body.nodes[inner], points)),
        node_mass=spread(body.node_mass),
        node_area=spread(body.node_area),
        ring_radii=np.zeros(inner.size + len(points)),
        modes=np.concatenate((body.modes[inner], modes)),
        description=f"{body.description}; {points.shape[0]} nodes on the rim",
    )


def mesh_of(sizes: Mapping[str, float], degrees_of_freedom: int) -> Mesh:
    """
    Mesh a body by its outer dimensions, m, with about so many degrees of freedom, three a node.

    Of a prism they are "width", "depth", "height", of a cylinder "diameter", "height", of a truncated cone
    "base_diameter", "top_diameter", "height".
    """
    if sizes.keys() == {"width", "depth", "height"}:
        edges = sizes["width"], sizes["depth"], sizes["height"]
        return prism_mesh(*edges, prism_divisions(*edges, degrees_of_freedom))
    if sizes.keys() == {"diameter", "height"}:
        lengths = sizes["diameter"], sizes["diameter"], sizes["height"]
    elif sizes.keys() == {"base_diameter", "top_diameter", "height"}:
        lengths = sizes["base_diameter"], sizes["top_diameter"], sizes["height"]
    else:
        raise ValueError(f"The dimensions are {', '.join(sizes)}; those of a prism, a cylinder or a cone were expected")
    return round_mesh(*lengths, round_divisions(*lengths, degrees_of_freedom))
