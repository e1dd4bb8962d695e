"""
The steps of the unreduced finite elements.

Every node moves in space by central differences, v(n+½) = v(n−½) + h f(n) / m, x(n+1) = x(n) + h v(n+½), with lumped
masses. Internal forces are −R K (Rᵀ (x − c) − X): small strain in axes that turn with the body, R being the mean
rotation Σ m (x − c) Xᵀ without its stretch. Translation, rotation and all inertia forces follow from the nodes; nothing
is taken from the reduced model.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

Whole = NDArray[np.int32]

COLUMNS = 22
"""Of a step's record: force 0:3, centre 3:6, its velocity 6:9, angular momentum 9:12, rotation vector (skew part of R)
12:15, kinetic 15, potential 16, strain 17, contact 18, dissipated by contact 19, friction 20, bulk viscosity 21."""


@kernel
def _mean_rotation(points: Array, masses: Array, positions: Array, centre: Array, rotation: Array) -> None:
    """Fill the orthogonal part of Σ m (x − c) Xᵀ, by Newton's iteration Q ← (Q + Q⁻ᵀ) / 2."""
    q = np.zeros((3, 3))
    for node in range(masses.size):
        for i in range(3):
            arm = masses[node] * (positions[node, i] - centre[i])
            for j in range(3):
                q[i, j] += arm * points[node, j]
    scale = sqrt((q * q).sum() / 3.0)
    q /= scale
    for _ in range(50):
        change = 0.0
        for i in range(3):
            a, b = (i + 1) % 3, (i + 2) % 3
            for j in range(3):
                c, d = (j + 1) % 3, (j + 2) % 3
                rotation[i, j] = q[a, c] * q[b, d] - q[a, d] * q[b, c]
        determinant = q[0, 0] * rotation[0, 0] + q[0, 1] * rotation[0, 1] + q[0, 2] * rotation[0, 2]
        for i in range(3):
            for j in range(3):
                new = 0.5 * (q[i, j] + rotation[i, j] / determinant)
                change = max(change, abs(new - q[i, j]))
                q[i, j] = new
        if change < 1e-15:
            break
    rotation[:] = q


@kernel
def _internal(
    points: Array,
    starts: Whole,
    neighbours: Whole,
    blocks: Array,
    positions: Array,
    centre: Array,
    rotation: Array,
    strained: Array,
    forces: Array,
) -> float:
    """Fill the elastic forces on the nodes in space; return the strain energy."""
    for node in range(points.shape[0]):
        for i in range(3):
            own = 0.0
            for j in range(3):
                own += rotation[j, i] * (positions[node, j] - centre[j])
            strained[node, i] = own - points[node, i]
    energy = 0.0
    for node in range(points.shape[0]):
        x, y, z = 0.0, 0.0, 0.0
        for place in range(starts[node], starts[node + 1]):
            other = neighbours[place]
            u, v, w = strained[other, 0], strained[other, 1], strained[other, 2]
            x += blocks[place, 0, 0] * u + blocks[place, 0, 1] * v + blocks[place, 0, 2] * w
            y += blocks[place, 1, 0] * u + blocks[place, 1, 1] * v + blocks[place, 1, 2] * w
            z += blocks[place, 2, 0] * u + blocks[place, 2, 1] * v + blocks[place, 2, 2] * w
        energy += 0.5 * (x * strained[node, 0] + y * strained[node, 1] + z * strained[node, 2])
        for i in range(3):
            forces[node, i] = -(rotation[i, 0] * x + rotation[i, 1] * y + rotation[i, 2] * z)
    return energy


@kernel
def _viscous(
    starts: Whole,
    columns: Whole,
    rates: Array,
    bricks: Array,
    rotation: Array,
    velocities: Array,
    own: Array,
    viscous: Array,
) -> None:
    """Fill the forces of the bulk viscosity; `bricks` has volume, linear and quadratic coefficient a row."""
    for node in range(velocities.shape[0]):
        for i in range(3):
            own[node, i] = 0.0
            for j in range(3):
                own[node, i] += rotation[j, i] * velocities[node, j]
    flow = own.ravel()
    pulls = np.zeros(flow.size)
    for brick in range(bricks.shape[0]):
        rate = 0.0
        for place in range(starts[brick], starts[brick + 1]):
            rate += rates[place] * flow[columns[place]]
        pull = bricks[brick, 0] * (bricks[brick, 1] * rate + bricks[brick, 2] * abs(rate) * min(0.0, rate))
        for place in range(starts[brick], starts[brick + 1]):
            pulls[columns[place]] -= pull * rates[place]
    for node in range(velocities.shape[0]):
        for i in range(3):
            viscous[node, i] = 0.0
            for j in range(3):
                viscous[node, i] += rotation[i, j] * pulls[3 * node + j]


@kernel
def _touch(
    law: Array, friction: float, depth: float, flow: Array, slip: Array, step: float, force: Array, damping: Array
) -> float:
    """Fill a node's force and the damping's part of it, move its slip on; return the energy in its springs."""
    force[:] = 0.0
    damping[:] = 0.0
    if depth <= 0.0:
        slip[:] = 0.0
        return 0.0
    force[2] = max(0.0, law[0] * depth - law[1] * flow[2])
    damping[2] = force[2] - law[0] * depth
    limit = friction * force[2] if force[2] > 0.0 else 0.0
    slip[0] += step * flow[0]
    slip[1] += step * flow[1]
    stretched = law[2] * sqrt(slip[0] ** 2 + slip[1] ** 2)
    if stretched > limit:
        slip *= limit / stretched
        force[0], force[1] = -law[2] * slip[0], -law[2] * slip[1]
    else:
        force[0], force[1] = -law[2] * slip[0] - law[3] * flow[0], -law[2] * slip[1] - law[3] * flow[1]
        pulled = sqrt(force[0] ** 2 + force[1] ** 2)
        if pulled > limit:
            force[0], force[1] = force[0] * limit / pulled, force[1] * limit / pulled
        damping[0], damping[1] = force[0] + law[2] * slip[0], force[1] + law[2] * slip[1]
    stored: float = 0.5 * (law[0] * depth**2 + law[2] * (slip[0] ** 2 + slip[1] ** 2))
    return stored


@kernel
def advance(
    points: Array,
    masses: Array,
    starts: Whole,
    neighbours: Whole,
    blocks: Array,
    base: NDArray[np.int64],
    laws: Array,
    friction: float,
    rate_starts: Whole,
    rate_columns: Whole,
    rates: Array,
    bricks: Array,
    positions: Array,
    velocities: Array,
    gravity: float,
    step: float,
    count: int,
) -> Array:
    """
    Walk `count` steps from nodal positions and velocities (at half a step before), which are moved on in place.

    points, masses: of the nodes; starts, neighbours, blocks: the stiffness in blocks of 3 × 3; laws: of each base node
    normal stiffness and damping, tangential stiffness and damping; rate_*: the bricks' rates of volume change; bricks:
    as of `_viscous`. Returns the record, one row a step, in the order of `COLUMNS`.
    """
    record = np.zeros((count, COLUMNS))
    forces, strained = np.empty_like(points), np.empty_like(points)
    viscous, own = np.zeros_like(points), np.empty_like(points)
    rotation, slips = np.empty((3, 3)), np.zeros((base.size, 2))
    centre, force, damping = np.zeros(3), np.zeros(3), np.zeros(3)
    total, contact_loss, friction_loss, bulk_loss = masses.sum(), 0.0, 0.0, 0.0
    for at in range(count):
        centre[:] = 0.0
        for node in range(masses.size):
            for i in range(3):
                centre[i] += masses[node] / total * positions[node, i]
        _mean_rotation(points, masses, positions, centre, rotation)
        record[at, 17] = _internal(points, starts, neighbours, blocks, positions, centre, rotation, strained, forces)
        _viscous(rate_starts, rate_columns, rates, bricks, rotation, velocities, own, viscous)
        forces += viscous
        forces[:, 2] -= gravity * masses
        taken = 0.0
        for index in range(base.size):
            node = base[index]
            slip, flow = slips[index], velocities[node]
            before = 0.5 * laws[index, 2] * (slip[0] ** 2 + slip[1] ** 2)
            energy = _touch(laws[index], friction, -positions[node, 2], flow, slip, step, force, damping)
            record[at, 18] += energy
            after = 0.5 * laws[index, 2] * (slip[0] ** 2 + slip[1] ** 2)
            forces[node] += force
            record[at, :3] += force
            mean = flow + 0.5 * step / masses[node] * forces[node]
            for i in range(3):
                contact_loss -= step * damping[i] * mean[i]
            # What is left of the tangential work when spring and damper have taken theirs.
            taken -= step * ((force[0] - damping[0]) * flow[0] + (force[1] - damping[1]) * flow[1]) + after - before
        friction_loss += taken
        for node in range(masses.size):
            for i in range(3):
                change = step / masses[node] * forces[node, i]
                mean_velocity = velocities[node, i] + 0.5 * change
                bulk_loss -= step * viscous[node, i] * mean_velocity
                record[at, 6 + i] += masses[node] / total * mean_velocity
                record[at, 15] += 0.5 * masses[node] * mean_velocity**2
                own[node, i] = mean_velocity
                velocities[node, i] += change
        for node in range(masses.size):
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                arm, other = positions[node, j] - centre[j], positions[node, k] - centre[k]
                record[at, 9 + i] += masses[node] * (arm * own[node, k] - other * own[node, j])
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            record[at, 3 + i] = centre[i]
            record[at, 12 + i] = 0.5 * (rotation[k, j] - rotation[j, k])
        record[at, 16] = total * gravity * centre[2]
        record[at, 19], record[at, 20], record[at, 21] = contact_loss, friction_loss, bulk_loss
        for node in range(masses.size):
            for i in range(3):
                positions[node, i] += step * velocities[node, i]
    return record
