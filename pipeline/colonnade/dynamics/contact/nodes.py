"""Rigid bodies on nodes: where a prism can touch the table, and on which rings a cylinder or a cone does."""

from __future__ import annotations

from math import cos, pi

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody

GRID = (5, 5)
"""Nodes of a rectangular base along x and y."""

RINGS = (4, None)
"""Rings of a round base, and nodes on each; None for whole circles."""


def rigid_body(block: Block, *, grid: tuple[int, int] = GRID, rings: tuple[int, int | None] = RINGS) -> ContactBody:
    """
    Place nodes on the base of a rigid block.

    Parameters
    ----------
    block : Block
        Half width, height of the centre of mass and inertia about y follow from its α, R and I₀ (of both sides, in the
        mean); depth and the other inertias from its `solid`. A block without one is assumed to be as deep as wide, its
        inertia about x as that about y, and about z as of a prism of that base.
    grid : tuple of int, optional
        Nodes of a rectangular base along x and y, at least 2 along x. Equal spacing with nodes on the edges; corners
        stand for a quarter of the area of an inner node.
    rings : tuple of int and (int or None), optional
        Rings of a round base, outermost on the rim, equally spaced; and nodes on each. None, the default, takes them as
        whole circles. A number makes them polygons, on which a body rolls with a resistance of its own: for comparison.

    Returns
    -------
    body : ContactBody
        Without modes. Each node's mass is the body's, by its share of the area.

    Raises
    ------
    ValueError
        If there are too few nodes.
    """
    solid = block.solid
    sides = (block.negative, block.positive)
    widths = [side.half_width for side in sides]
    half_width = 0.5 * sum(widths)
    height = 0.5 * sum(side.pole_distance * cos(side.critical_angle) for side in sides)
    about_y = 0.5 * sum(side.inertia - block.mass * side.pole_distance**2 for side in sides)
    if not about_y > 0.0:
        raise ValueError(
            f"I₀ − m R² is {about_y:.4g} kg m²; more than 0 was expected: the inertia about the pole "
            "has to exceed that of the mass at the pole distance"
        )
    round_base = solid is not None and solid.base == "circle"
    if solid is None:
        half_depth = half_width
        inertia = np.array([about_y, about_y, block.mass * (half_width**2 + half_depth**2) / 3.0])
    else:
        half_depth = half_width if round_base else solid.half_depth
        inertia = np.array([about_y if round_base else solid.inertia_x, about_y, solid.inertia_z])
    if round_base:
        nodes, area = _round(half_width, *rings)
    else:
        nodes, area = _rectangle(widths, half_depth, *grid)
    whole = round_base and rings[1] is None
    return ContactBody(
        mass=block.mass,
        inertia=inertia,
        nodes=np.column_stack((nodes, np.full(len(nodes), -height))),
        node_mass=block.mass * area / area.sum(),
        node_area=area,
        modes=np.zeros((len(nodes), 3, 0)),
        frequencies=np.zeros(0),
        modal_damping=np.zeros(0),
        description=_describe(block, len(nodes), whole),
        ring_radii=nodes[:, 0] if whole else np.zeros(len(nodes)),
    )


def _describe(block: Block, count: int, whole: bool) -> str:
    if whole:
        return f"rigid, round base, {count} whole {'ring' if count == 1 else 'rings'}"
    if block.solid is None:
        return f"rigid, rectangular base taken to be as deep as wide, {count} nodes"
    return f"rigid, {'round' if block.solid.base == 'circle' else 'rectangular'} base, {count} nodes"


def _rectangle(widths: list[float], half_depth: float, along: int, across: int) -> tuple[Array, Array]:
    if along < 2 or across < 1:
        raise ValueError(f"grid is ({along}, {across}); at least 2 nodes along x and 1 across were expected")
    x = np.linspace(-widths[0], widths[1], along)
    y = np.linspace(-half_depth, half_depth, across) if across > 1 else np.zeros(1)
    share_x, share_y = _shares(along), _shares(across)
    nodes = np.column_stack([part.ravel() for part in np.meshgrid(x, y, indexing="ij")])
    return nodes, np.outer(share_x, share_y).ravel() * sum(widths) * 2.0 * half_depth


def _shares(count: int) -> Array:
    """Shares of equally spaced points, the ends with half of an inner one's."""
    shares = np.ones(count)
    if count > 1:
        shares[[0, -1]] = 0.5
    return np.asarray(shares / shares.sum())


def _round(radius: float, rings: int, around: int | None) -> tuple[Array, Array]:
    if rings < 1 or (around is not None and around < 3):
        raise ValueError(f"rings is ({rings}, {around}); at least 1 ring of 3 nodes, or of None, was expected")
    count = around or 1
    angle = 2.0 * pi * np.arange(count) / count
    radii = radius * np.arange(1, rings + 1) / rings
    # A ring takes the area up to midway to its neighbours, the innermost all within, the outermost up to the rim.
    edges = np.concatenate(([0.0], 0.5 * (radii[:-1] + radii[1:]), [radius]))
    area = pi * np.diff(edges**2) / count
    nodes = np.column_stack((np.outer(radii, np.cos(angle)).ravel(), np.outer(radii, np.sin(angle)).ravel()))
    return nodes, np.repeat(area, count)
