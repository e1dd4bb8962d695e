"""
Drift: the body moves without contact.

Free rotation turns about the body's axes one after the other, each turn exact and in mirrored order (Dullweber,
Leimkuhler and McLachlan 1997), so that the angular momentum is kept to rounding.
"""

from __future__ import annotations

from math import cos, sin

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.state import Body, State
from colonnade.dynamics.kernel import kernel


@kernel
def drift(body: Body, state: State, pull: Array, step: float) -> None:
    """Move without contact for `step`, half a step of the scheme; pull is minus the table's mean acceleration."""
    mass, gravity, rigid, strain, modal = body.mass, body.gravity, state.rigid, state.strain, body.propagators
    # Translation at a constant acceleration; the work of the table is booked.
    for axis in range(3):
        acceleration = pull[axis] - (gravity if axis == 2 else 0.0)
        moved = step * (rigid[3 + axis] + 0.5 * step * acceleration)
        rigid[axis] += moved
        rigid[3 + axis] += step * acceleration
        state.ledger[0] += mass * pull[axis] * moved
    # Rotation: half a turn about x, half about y, a whole one about z, and back.
    quaternion, spin = rigid[6:10], rigid[10:13]
    _turn(quaternion, spin, 0, 0.5 * step * spin[0] / body.inertia[0])
    _turn(quaternion, spin, 1, 0.5 * step * spin[1] / body.inertia[1])
    _turn(quaternion, spin, 2, step * spin[2] / body.inertia[2])
    _turn(quaternion, spin, 1, 0.5 * step * spin[1] / body.inertia[1])
    _turn(quaternion, spin, 0, 0.5 * step * spin[0] / body.inertia[0])
    fill_rotation(state)
    # Each mode swings freely; what its damping takes is booked.
    for mode in range(strain.shape[1]):
        value, rate, square = strain[0, mode], strain[1, mode], body.frequencies[mode] ** 2
        strain[0, mode] = modal[0, mode] * value + modal[1, mode] * rate
        strain[1, mode] = modal[2, mode] * value + modal[3, mode] * rate
        before = rate**2 + square * value**2
        state.ledger[3] += 0.5 * (before - strain[1, mode] ** 2 - square * strain[0, mode] ** 2)


@kernel
def fill_rotation(state: State) -> None:
    """Fill the rotation matrix, body to table, from the quaternion."""
    matrix, w, x, y, z = state.matrix, state.rigid[6], state.rigid[7], state.rigid[8], state.rigid[9]
    scale = 2.0 / (w * w + x * x + y * y + z * z)
    matrix[0, 0], matrix[1, 1] = 1 - scale * (y * y + z * z), 1 - scale * (x * x + z * z)
    matrix[2, 2] = 1 - scale * (x * x + y * y)
    matrix[0, 1], matrix[1, 0] = scale * (x * y - w * z), scale * (x * y + w * z)
    matrix[0, 2], matrix[2, 0] = scale * (x * z + w * y), scale * (x * z - w * y)
    matrix[1, 2], matrix[2, 1] = scale * (y * z - w * x), scale * (y * z + w * x)


@kernel
def _turn(quaternion: Array, spin: Array, axis: int, angle: float) -> None:
    """Turn the body by `angle` about one of its axes; the angular momentum in space stays."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    # The angular momentum stays in space, so its components in the body turn the other way.
    c, s = cos(angle), sin(angle)
    spin[j], spin[k] = c * spin[j] + s * spin[k], c * spin[k] - s * spin[j]
    # The quaternion times that of the turn.
    c, s = cos(0.5 * angle), sin(0.5 * angle)
    scalar, q_i, q_j, q_k = quaternion[0], quaternion[axis + 1], quaternion[j + 1], quaternion[k + 1]
    quaternion[0] = c * scalar - s * q_i
    quaternion[axis + 1] = c * q_i + s * scalar
    quaternion[j + 1] = c * q_j + s * q_k
    quaternion[k + 1] = c * q_k - s * q_j
