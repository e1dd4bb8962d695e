"""One row of the result: the state at a sample of the motion, with its energies."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.points import place_nodes
from colonnade.dynamics.contact.engine.rings import lowest_and_energy
from colonnade.dynamics.contact.engine.state import Body, Near, State
from colonnade.dynamics.kernel import kernel


@kernel
def fill_sample(body: Body, state: State, near: Near, row: Array) -> None:
    """Fill the columns of a sample except those that are accumulated along the run."""
    rigid, strain, contact, slip, depth = state.rigid, state.strain, body.contact, state.slip, near.depth
    row[:10] = rigid[:10]
    # Kinetic energy of translation, rotation and modes; potential energy; strain energy.
    row[17] = 0.5 * body.mass * (rigid[3] ** 2 + rigid[4] ** 2 + rigid[5] ** 2)
    for axis in range(3):
        row[10 + axis] = rigid[10 + axis] / body.inertia[axis]
        row[17] += 0.5 * rigid[10 + axis] * row[10 + axis]
    row[18] = body.mass * body.gravity * rigid[2]
    for mode in range(strain.shape[1]):
        row[17] += 0.5 * strain[1, mode] ** 2
        row[19] += 0.5 * (body.frequencies[mode] * strain[0, mode]) ** 2
    # The lowest point of the base, and the energy in the springs of all nodes and rings.
    row[13] = np.inf
    for index in range(place_nodes(body, state, near, np.inf)):
        node, slot = near.node[index], near.slot[index]
        row[13] = min(row[13], -depth[index])
        row[20] += 0.5 * contact[node, 0] * max(depth[index], 0.0) ** 2
        if state.touched[slot] == 1:
            row[20] += 0.5 * contact[node, 2] * (slip[slot, 0] ** 2 + slip[slot, 1] ** 2)
    for node in range(body.nodes.shape[0]):
        if body.radii[node] > 0.0:
            lowest, energy = lowest_and_energy(body, state, node)
            row[13] = min(row[13], -lowest)
            row[20] += energy
