"""The rim of an elastic round body between the nodes of its mesh."""

from __future__ import annotations

from dataclasses import replace
from math import ceil

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody

RIM_NODES = 288
"""Nodes at which the rim of a meshed round body can touch: converged to a hundredth of α in its free rocking."""


def refine_rim(body: ContactBody, around: int = RIM_NODES) -> ContactBody:
    """
    Put more nodes on the rim of a round body than its mesh has there.

    Parameters
    ----------
    body : ContactBody
        Whose outermost nodes are on a circle about its axis.
    around : int, optional
        Nodes on the rim; the next multiple of the mesh's own.

    Returns
    -------
    body : ContactBody
        Its rim's nodes stand on the circle at equal parts of each edge of the mesh. Between two of the mesh's nodes the
        modes are linear, as the displacements of its bricks are, and area and mass are those of the two in proportion:
        the rim's stiffness and damping are spread, not changed. The other nodes are as they were.

    Raises
    ------
    ValueError
        If the rim has less than three nodes.
    """
    radii = np.hypot(body.nodes[:, 0], body.nodes[:, 1])
    rim = np.flatnonzero(radii > (1.0 - 1e-6) * radii.max())
    if rim.size < 3:
        raise ValueError(f"The rim has {rim.size} nodes; at least 3 were expected")
    angle = np.arctan2(body.nodes[rim, 1], body.nodes[rim, 0])
    rim, angle = rim[np.argsort(angle)], np.sort(angle)
    parts = max(1, ceil(around / rim.size))
    share = np.tile(np.arange(parts) / parts, rim.size)
    first = np.repeat(rim, parts)
    second = np.repeat(np.roll(rim, -1), parts)
    width = np.repeat(np.diff(angle, append=angle[0] + 2.0 * np.pi), parts)
    turned = np.repeat(angle, parts) + share * width
    height = (1.0 - share) * body.nodes[first, 2] + share * body.nodes[second, 2]
    points = np.column_stack((radii.max() * np.cos(turned), radii.max() * np.sin(turned), height))

    def spread(values: Array) -> Array:
        return np.asarray(((1.0 - share) * values[first] + share * values[second]) / parts)

    along = share[:, None, None]
    modes = (1.0 - along) * body.modes[first] + along * body.modes[second]
    inner = np.setdiff1d(np.arange(len(radii)), rim)
    return replace(
        body,
        nodes=np.vstack((body.nodes[inner], points)),
        node_mass=np.concatenate((body.node_mass[inner], spread(body.node_mass))),
        node_area=np.concatenate((body.node_area[inner], spread(body.node_area))),
        ring_radii=np.zeros(inner.size + points.shape[0]),
        modes=np.concatenate((body.modes[inner], modes)),
        description=f"{body.description}; {points.shape[0]} nodes on the rim",
    )
