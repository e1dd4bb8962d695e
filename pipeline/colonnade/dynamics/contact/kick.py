"""
Kick: the contact's impulse in the middle of a step, by the law of contact at each point.

The force is that at the mean of the velocities before and after the impulse, found in a few passes over all bodies. A
point's normal force is the mean over the step of what its depth, linear in time, gives: contact that begins or ends
within a step counts for the part of the step that it lasts.
"""

from __future__ import annotations

from math import sqrt

from colonnade.arrays import Array
from colonnade.dynamics.contact.state import State, System
from colonnade.dynamics.contact.touch import fill_twists
from colonnade.dynamics.kernel import kernel_in_place

PASSES = 3
"""Evaluations of the contact forces in one step, each with the mean velocity that the one before leads to."""


@kernel_in_place
def kick(system: System, state: State, step: float) -> None:
    """Take the contact's impulse on all bodies, and book it."""
    rigid, matrix, change, total, strain = state.rigid, state.matrix, state.change, state.total, state.strain
    mass, sides = system.mass, system.carrier.size
    change[:, :], total[:, :], strain[2:, :], state.work[2] = 0.0, 0.0, 0.0, 0.0
    if state.listed[sides] == 0:
        return
    for turn in range(PASSES + 1):
        # Means of the velocities before and after the impulse found so far: of bodies, modes and points.
        if turn > 0:
            fill_twists(system, state, 0.5)
        for mode in range(strain.shape[1]):
            strain[3, mode] = strain[1, mode] + 0.5 * strain[2, mode]
        for side in range(sides):
            _fill_velocities(system, state, side, step if turn == 0 else 0.0)
        if turn == PASSES:
            # The last turn only gives the mean velocities that the ledger needs.
            break
        # The forces at these velocities, and what their impulse changes.
        total[:, :] = 0.0
        for mode in range(strain.shape[1]):
            strain[2, mode] = 0.0
        for side in range(sides):
            _fill_forces(system, state, side, step)
            _add_forces(system, state, side, step)
        for body in range(mass.size):
            for axis in range(3):
                change[body, axis] = step * total[body, axis] / mass[body]
                change[body, 3 + axis] = 0.0
                for other in range(3):
                    change[body, 3 + axis] += step * matrix[body, other, axis] * total[body, 3 + other]
    for body in range(mass.size):
        for axis in range(3):
            rigid[body, 3 + axis] += change[body, axis]
            rigid[body, 10 + axis] += change[body, 3 + axis]
    for mode in range(strain.shape[1]):
        strain[1, mode] += strain[2, mode]
    for side in range(sides):
        _settle(state, side, step)


@kernel_in_place
def _fill_velocities(system: System, state: State, side: int, step: float) -> None:
    """
    Fill the velocities of an interface's points relative to the target, v + ω × r + R Φ η̇, and where a step is given
    the slip's increase since the last kick; a point that just arrives has none.
    """
    strain, modes, turned, nodes = state.strain, system.modes, state.turned, state.node
    lever, load, twist, listed = state.lever, state.load, state.twist, state.listed
    u, v, w, p, q, r = twist[side, 0], twist[side, 1], twist[side, 2], twist[side, 3], twist[side, 4], twist[side, 5]
    for index in range(listed[side], listed[side + 1]):
        x, y, z = lever[index, 0], lever[index, 1], lever[index, 2]
        load[index, 9], load[index, 10], load[index, 11] = u + q * z - r * y, v + r * x - p * z, w + p * y - q * x
        for own in range(3 if strain.shape[1] > 0 else 0):
            # The modes' own velocity, turned from the body's axes to the table's.
            speed = 0.0
            for mode in range(strain.shape[1]):
                speed += modes[nodes[index], own, mode] * strain[3, mode]
            for axis in range(3):
                load[index, 9 + axis] += turned[side, axis, own] * speed
        for axis in range(2 if step > 0.0 else 0):
            # Free of contact, the mean velocity was less by what the table's acceleration gives in half a step.
            half = 0.5 * step if system.target[side] < 0 else 0.0
            mean = load[index, 9 + axis] - half * state.pull[axis]
            load[index, 12 + axis] = state.touched[state.slot[index]] * step * mean


@kernel_in_place
def _fill_forces(system: System, state: State, side: int, step: float) -> None:
    """Fill the forces of an interface's points by the law of contact, and what becomes of their slip."""
    load, depths, slip, listed = state.load, state.depth, state.slip, state.listed
    for index in range(listed[side], listed[side + 1]):
        slot, depth, stiffness, damping = state.slot[index], depths[index], state.stiffness[index], state.damping[index]
        # Normal: the part of the step that the point is in contact, and the mean depth times that part.
        sinking = -load[index, 11] * step
        high, part, mean = depth + 0.5 * abs(sinking), 1.0, depth
        if high <= 0.0:
            part, mean = 0.0, 0.0
        elif high < abs(sinking):
            part = high / abs(sinking)
            mean = 0.5 * part * high
        elastic = stiffness * mean
        normal = max(0.0, elastic - part * damping * load[index, 11])
        limit = system.friction * normal if normal > 0.0 else 0.0
        # The slip of before, as far as this normal force still holds it.
        load[index, 7], load[index, 8] = slip[slot, 0], slip[slot, 1]
        _shorten(load, index, 7, stiffness, limit)
        # The slip after the step; beyond the limit of friction the point slides.
        load[index, 4], load[index, 5] = load[index, 7] + load[index, 12], load[index, 8] + load[index, 13]
        slides = _shorten(load, index, 4, stiffness, limit)
        load[index, 0], load[index, 1] = -stiffness * load[index, 4], -stiffness * load[index, 5]
        # A point that sticks is damped, up to the limit.
        if not slides:
            load[index, 0] -= damping * load[index, 9]
            load[index, 1] -= damping * load[index, 10]
            _shorten(load, index, 0, 1.0, limit)
        load[index, 2], load[index, 3], load[index, 6] = normal, elastic, 0.0 if slides else 1.0


@kernel_in_place
def _shorten(load: Array, row: int, column: int, stiffness: float, limit: float) -> bool:
    """Shorten a vector, times its stiffness, to the limit of friction; say whether it was longer."""
    # In place: of returned values the compiler takes root and quotient ahead of the condition, for every point.
    square = stiffness**2 * (load[row, column] ** 2 + load[row, column + 1] ** 2)
    if square <= limit**2:
        return False
    load[row, column] *= limit / sqrt(square)
    load[row, column + 1] *= limit / sqrt(square)
    return True


@kernel_in_place
def _add_forces(system: System, state: State, side: int, step: float) -> None:
    """Add the forces of an interface's points and their moments to its bodies, equal and opposite, and to the modes."""
    load, lever, listed, frame, apart = state.load, state.lever, state.listed, state.frame, state.apart
    strain, turned, modes, nodes, total = state.strain, state.turned, system.modes, state.node, state.total
    upper, lower = system.carrier[side], system.target[side]
    u, v, w, p, q, r = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for index in range(listed[side], listed[side + 1]):
        x, y, z = load[index, 0], load[index, 1], load[index, 2]
        u, v, w = u + x, v + y, w + z
        p += lever[index, 1] * z - lever[index, 2] * y
        q += lever[index, 2] * x - lever[index, 0] * z
        r += lever[index, 0] * y - lever[index, 1] * x
        for own in range(3 if strain.shape[1] > 0 else 0):
            impulse = step * (turned[side, 0, own] * x + turned[side, 1, own] * y + turned[side, 2, own] * z)
            for mode in range(strain.shape[1]):
                strain[2, mode] += modes[nodes[index], own, mode] * impulse
    # About the carrier, and of the opposite forces about the target: from there on to the carrier's centre of mass.
    x, y, z = apart[side, 0], apart[side, 1], apart[side, 2] + system.face[side, 4]
    for axis in range(3):
        a, b, c = frame[side, axis, 0], frame[side, axis, 1], frame[side, axis, 2]
        push, turn = a * u + b * v + c * w, a * p + b * q + c * r
        total[upper, axis] += push
        total[upper, 3 + axis] += turn
        total[lower, axis] -= push
        total[lower, 3 + axis] -= turn + a * (y * w - z * v) + b * (z * u - x * w) + c * (x * v - y * u)


@kernel_in_place
def _settle(state: State, side: int, step: float) -> None:
    """Book what contact and friction of an interface took, and keep the slip."""
    slip, work, load, listed, touched = state.slip, state.work, state.load, state.listed, state.touched
    for index in range(listed[side], listed[side + 1]):
        slot, stiffness = state.slot[index], state.stiffness[index]
        half = 0.5 * stiffness
        # Normal damping; and the energy of the slip that the normal force held no longer, which friction took.
        work[1] += step * (load[index, 3] - load[index, 2]) * load[index, 11]
        held, kept = load[index, 7] ** 2 + load[index, 8] ** 2, load[index, 4] ** 2 + load[index, 5] ** 2
        work[1] += half * (slip[slot, 0] ** 2 + slip[slot, 1] ** 2 - held)
        sticks = load[index, 6] == 1.0
        for axis in range(2):
            # Of one that sticks what its damper took, of one that slides the work less what the spring gained.
            force = load[index, axis] + (stiffness * load[index, 4 + axis] if sticks else 0.0)
            work[1] -= step * force * load[index, 9 + axis]
        work[1] += 0.0 if sticks else half * (held - kept)
        slip[slot, 0], slip[slot, 1] = load[index, 4], load[index, 5]
        touched[slot] = 1 if load[index, 3] > 0.0 else 0
        work[2] += touched[slot] * half * kept
