"""Which points of the base may touch the table within a step, and how they move."""

from __future__ import annotations

from math import sqrt

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.state import Body, Near, State
from colonnade.dynamics.kernel import kernel


@kernel
def fastest(body: Body, state: State, reach: float, bend: float) -> float:
    """Bound the speed of a node: one that is higher than it moves in a step neither touched before nor does now."""
    bound, flutter = abs(state.rigid[5]), 0.0
    for axis in range(3):
        bound += reach * abs(state.rigid[10 + axis]) / body.inertia[axis]
    for mode in range(state.strain.shape[1]):
        flutter += state.strain[1, mode] ** 2
    return float(bound + bend * sqrt(flutter))


@kernel
def place_nodes(body: Body, state: State, near: Near, margin: float) -> int:
    """List the point nodes lower than `margin`, with their levers (in table and in body axes) and depths."""
    nodes, modes, strain = body.nodes, body.modes, state.strain
    count, height = 0, state.rigid[2]
    for node in range(nodes.shape[0]):
        if body.radii[node] > 0.0:
            continue
        # Where the node is in the body's axes, as the modes displace it.
        x, y, z = nodes[node, 0], nodes[node, 1], nodes[node, 2]
        for mode in range(strain.shape[1]):
            x += modes[node, 0, mode] * strain[0, mode]
            y += modes[node, 1, mode] * strain[0, mode]
            z += modes[node, 2, mode] * strain[0, mode]
        above = state.matrix[2, 0] * x + state.matrix[2, 1] * y + state.matrix[2, 2] * z
        if height + above < margin:
            put(state.matrix, near.lever, count, x, y, z)
            near.depth[count] = -(height + above)
            near.node[count], near.slot[count], near.share[count] = node, body.slots[node], 1.0
            count += 1
    return count


@kernel
def put(matrix: Array, lever: Array, row: int, x: float, y: float, z: float) -> None:
    """Fill the lever of a point at (x, y, z) in the body's axes: in the table's axes, then in the body's."""
    for axis in range(3):
        lever[row, axis] = matrix[axis, 0] * x + matrix[axis, 1] * y + matrix[axis, 2] * z
    lever[row, 3], lever[row, 4], lever[row, 5] = x, y, z


@kernel
def fill_velocities(body: Body, state: State, near: Near, count: int) -> None:
    """Fill the velocities of the near points, v + ω × r + R Φ η̇."""
    speeds, rates, modes, matrix = near.speeds, near.rates, body.modes, state.matrix
    lever, load = near.lever, near.load
    for index in range(count):
        x, y, z = lever[index, 0], lever[index, 1], lever[index, 2]
        load[index, 9] = speeds[0] + speeds[4] * z - speeds[5] * y
        load[index, 10] = speeds[1] + speeds[5] * x - speeds[3] * z
        load[index, 11] = speeds[2] + speeds[3] * y - speeds[4] * x
        if rates.size > 0:
            # The modes' own velocity, turned from the body's axes to the table's.
            node, u, v, w = near.node[index], 0.0, 0.0, 0.0
            for mode in range(rates.size):
                u += modes[node, 0, mode] * rates[mode]
                v += modes[node, 1, mode] * rates[mode]
                w += modes[node, 2, mode] * rates[mode]
            for axis in range(3):
                load[index, 9 + axis] += matrix[axis, 0] * u + matrix[axis, 1] * v + matrix[axis, 2] * w
