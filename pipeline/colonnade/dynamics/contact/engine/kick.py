"""Kick: the contact's impulse in the middle of a step."""

from __future__ import annotations

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.force import fill_force
from colonnade.dynamics.contact.engine.points import fill_velocities
from colonnade.dynamics.contact.engine.state import Body, Near, State
from colonnade.dynamics.kernel import kernel

PASSES = 3
"""Evaluations of the contact forces in one step, each with the mean velocity that the one before leads to."""


@kernel
def kick(body: Body, state: State, near: Near, count: int, step: float) -> None:
    """Take the contact's impulse, and book it."""
    rigid, matrix, total, load = state.rigid, state.matrix, state.total, near.load
    change, gain, rates = near.change, near.gain, near.rates
    change[:], gain[:], total[:] = 0.0, 0.0, 0.0
    if count == 0:
        return
    for turn in range(PASSES + 1):
        # Means of the velocities before and after the impulse found so far: of the body, its modes, its points.
        _fill_mean_speeds(rigid, change, body.inertia, matrix, near.speeds)
        for mode in range(gain.size):
            rates[mode] = state.strain[1, mode] + 0.5 * gain[mode]
        fill_velocities(body, state, near, count)
        if turn == 0:
            # The slip's increase over the step, by the velocities before it; a point that just arrives has none.
            for index in range(count):
                first = 0.0 if state.touched[near.slot[index]] == 0 else step
                load[index, 12], load[index, 13] = first * load[index, 9], first * load[index, 10]
        if turn == PASSES:
            # The last turn only gives the mean velocities that the ledger needs.
            break
        # The forces at these velocities, and what their impulse changes.
        total[:], gain[:] = 0.0, 0.0
        for index in range(count):
            fill_force(body, state, near, index, step)
            _add_force(load, near.lever, index, total)
            if gain.size > 0:
                _add_gain(load, index, matrix, body.modes, near.node[index], step, gain)
        for axis in range(3):
            change[axis] = step * total[axis] / body.mass
            change[3 + axis] = 0.0
            for other in range(3):
                change[3 + axis] += step * matrix[other, axis] * total[3 + other]
    for axis in range(3):
        rigid[3 + axis] += change[axis]
        rigid[10 + axis] += change[3 + axis]
    for mode in range(gain.size):
        state.strain[1, mode] += gain[mode]
    _settle(body, state, near, count, step)


@kernel
def _fill_mean_speeds(rigid: Array, change: Array, inertia: Array, matrix: Array, speeds: Array) -> None:
    """Fill velocity and angular velocity in the table's axes, half of a change of velocity and momentum later."""
    for axis in range(3):
        speeds[axis] = rigid[3 + axis] + 0.5 * change[axis]
        speeds[3 + axis] = 0.0
        for own in range(3):
            turning = (rigid[10 + own] + 0.5 * change[3 + own]) / inertia[own]
            speeds[3 + axis] += matrix[axis, own] * turning


@kernel
def _add_force(load: Array, lever: Array, index: int, total: Array) -> None:
    """Add a point's force, and its moment about the centre of mass."""
    x, y, z = load[index, 0], load[index, 1], load[index, 2]
    for axis in range(3):
        total[axis] += load[index, axis]
    total[3] += lever[index, 1] * z - lever[index, 2] * y
    total[4] += lever[index, 2] * x - lever[index, 0] * z
    total[5] += lever[index, 0] * y - lever[index, 1] * x


@kernel
def _add_gain(load: Array, index: int, matrix: Array, modes: Array, node: int, step: float, gain: Array) -> None:
    """Add what a point's impulse gives each mode: its shape at the point times the impulse in the body's axes."""
    x, y, z = load[index, 0], load[index, 1], load[index, 2]
    along = step * (matrix[0, 0] * x + matrix[1, 0] * y + matrix[2, 0] * z)
    across = step * (matrix[0, 1] * x + matrix[1, 1] * y + matrix[2, 1] * z)
    up = step * (matrix[0, 2] * x + matrix[1, 2] * y + matrix[2, 2] * z)
    for mode in range(gain.size):
        gain[mode] += modes[node, 0, mode] * along + modes[node, 1, mode] * across + modes[node, 2, mode] * up


@kernel
def _settle(body: Body, state: State, near: Near, count: int, step: float) -> None:
    """Book what the contact took, and keep the slip."""
    contact, slip, touched, ledger, load = body.contact, state.slip, state.touched, state.ledger, near.load
    for index in range(count):
        node = near.slot[index]
        stiffness = near.share[index] * contact[near.node[index], 2]
        half = 0.5 * stiffness
        # Normal damping; and the energy of the slip that the normal force held no longer, which friction took.
        ledger[1] += step * (load[index, 3] - load[index, 2]) * load[index, 11]
        held = half * (load[index, 7] ** 2 + load[index, 8] ** 2)
        ledger[2] += half * (slip[node, 0] ** 2 + slip[node, 1] ** 2) - held
        if load[index, 6] == 1.0:
            # It sticks: what its damper took.
            for axis in range(2):
                damping = load[index, axis] + stiffness * load[index, 4 + axis]
                ledger[1] -= step * damping * load[index, 9 + axis]
        else:
            # It slides: the work of the force, less what the spring gained.
            ledger[2] -= step * (load[index, 0] * load[index, 9] + load[index, 1] * load[index, 10])
            ledger[2] += held - half * (load[index, 4] ** 2 + load[index, 5] ** 2)
        slip[node, 0], slip[node, 1] = load[index, 4], load[index, 5]
        touched[node] = 1 if load[index, 3] > 0.0 else 0
