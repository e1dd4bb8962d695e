"""
The motion of bodies on a table and on each other, step by step.

Each step drifts half a step without contact, takes the contact's impulse at that middle, and drifts the other half:

    drift   ẍ = g − a(t); free rotation; η̈ + 2 ζ ω η̇ + ω² η = 0, solved exactly
    kick    m Δv = h ΣF, ΔL = h Σ r × F, Δη̇ = h ΣΦᵀF, with F at the mean of the velocities before and after

Everything is relative to the table; gravity and the table's acceleration a act alike. Free rotation turns about the
body's axes one after the other, each turn exact and in mirrored order (Dullweber, Leimkuhler and McLachlan 1997), so
that the angular momentum is kept to rounding. Flight is of second order in the step, an impact of about first: of the
paper's prism one impact later, a step of 10 µs costs 2e-5 to 1e-4 of α.
"""

from __future__ import annotations

from math import cos, sin

from colonnade.arrays import Array
from colonnade.dynamics.contact.kick import kick
from colonnade.dynamics.contact.state import TABLE, State, System
from colonnade.dynamics.contact.touch import place
from colonnade.dynamics.kernel import kernel_in_place


@kernel_in_place
def march(system: System, state: State, motion: Array, interval: float, parts: int, samples: Array, sums: Array) -> int:
    """
    Fill the samples along a motion (shape (n, 3)), `parts` steps an interval; return how many were reached.

    samples, shape (n, b, 13): of the bodies, as `rigid`, but with the angular velocity. sums, shape (n, 9): of all, as
    of `EnergyBalance`, then the force of the table (mean since the sample before). A body has fallen that lies at a
    tilt of π/2 or is too low. The run ends where all have.
    """
    step, bodies, stands, total = interval / parts, system.mass.size, state.stands, state.total
    for sample in range(motion.shape[0]):
        for part in range(parts if sample > 0 else 0):
            _drift(system, state, motion, sample, (part + 0.25) / parts, 0.5 * step)
            place(system, state, step)
            kick(system, state, step)
            for axis in range(3):
                sums[sample, 6 + axis] -= total[TABLE, axis] / parts
            _drift(system, state, motion, sample, (part + 0.75) / parts, 0.5 * step)
        _fill_sample(system, state, samples[sample], sums[sample])
        left = 0
        for body in range(bodies):
            if state.matrix[body, 2, 2] <= 0.0 or state.rigid[body, 2] < system.lowest[body]:
                stands[body] = 0
            left += stands[body]
        if left == 0:
            return sample + 1
    return len(motion)


@kernel_in_place
def _drift(system: System, state: State, motion: Array, sample: int, share: float, step: float) -> None:
    """Move without contact for `step`, half a step of the scheme, whose middle is at a share of a sample's interval."""
    inertia, modal, rigid, strain, work = system.inertia, system.propagators, state.rigid, state.strain, state.work
    for axis in range(3):
        before = motion[sample - 1, axis]
        state.pull[axis] = -(before + (motion[sample, axis] - before) * share)
    for body in range(system.mass.size):
        if state.stands[body] == 1:
            # Translation at a constant acceleration; the work of the table is booked.
            for axis in range(3):
                acceleration = state.pull[axis] - (system.gravity if axis == 2 else 0.0)
                moved = step * (rigid[body, 3 + axis] + 0.5 * step * acceleration)
                rigid[body, axis] += moved
                rigid[body, 3 + axis] += step * acceleration
                work[0] += system.mass[body] * state.pull[axis] * moved
            # Rotation: half a turn about x, half about y, a whole one about z, and back.
            for turn in range(5):
                axis, share = 2 - abs(turn - 2), 1.0 if turn == 2 else 0.5
                _turn(rigid, body, axis, share * step * rigid[body, 10 + axis] / inertia[body, axis])
            _fill_rotation(rigid, state.matrix, body)
    # Each mode swings freely; what its damping takes is booked.
    for mode in range(strain.shape[1]):
        value, rate, square = strain[0, mode], strain[1, mode], system.frequencies[mode] ** 2
        strain[0, mode] = modal[0, mode] * value + modal[1, mode] * rate
        strain[1, mode] = modal[2, mode] * value + modal[3, mode] * rate
        before = rate**2 + square * value**2
        work[1] += 0.5 * (before - strain[1, mode] ** 2 - square * strain[0, mode] ** 2)


@kernel_in_place
def _fill_rotation(rigid: Array, matrix: Array, body: int) -> None:
    """Fill a body's rotation matrix, body to table, from its quaternion."""
    w, x, y, z = rigid[body, 6], rigid[body, 7], rigid[body, 8], rigid[body, 9]
    scale = 2.0 / (w * w + x * x + y * y + z * z)
    matrix[body, 0, 0], matrix[body, 1, 1] = 1 - scale * (y * y + z * z), 1 - scale * (x * x + z * z)
    matrix[body, 2, 2] = 1 - scale * (x * x + y * y)
    matrix[body, 0, 1], matrix[body, 1, 0] = scale * (x * y - w * z), scale * (x * y + w * z)
    matrix[body, 0, 2], matrix[body, 2, 0] = scale * (x * z + w * y), scale * (x * z - w * y)
    matrix[body, 1, 2], matrix[body, 2, 1] = scale * (y * z - w * x), scale * (y * z + w * x)


@kernel_in_place
def _turn(rigid: Array, body: int, axis: int, angle: float) -> None:
    """Turn a body by `angle` about one of its axes; the angular momentum in space stays."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    c, s = cos(0.5 * angle), sin(0.5 * angle)
    # The quaternion times that of the turn.
    scalar, q_i, q_j, q_k = rigid[body, 6], rigid[body, 7 + axis], rigid[body, 7 + j], rigid[body, 7 + k]
    rigid[body, 6] = c * scalar - s * q_i
    rigid[body, 7 + axis] = c * q_i + s * scalar
    rigid[body, 7 + j] = c * q_j + s * q_k
    rigid[body, 7 + k] = c * q_k - s * q_j
    # The angular momentum stays in space, so its components in the body turn the other way.
    c, s = c * c - s * s, 2.0 * c * s
    spin_j, spin_k = rigid[body, 10 + j], rigid[body, 10 + k]
    rigid[body, 10 + j], rigid[body, 10 + k] = c * spin_j + s * spin_k, c * spin_k - s * spin_j


@kernel_in_place
def _fill_sample(system: System, state: State, sample: Array, sums: Array) -> None:
    """Fill the rows of a sample except the table's force, which is added up along the run."""
    place(system, state, 0.0)
    rigid, inertia, strain = state.rigid, system.inertia, state.strain
    sums[4], sums[5], sums[3] = state.work[0], state.work[1], state.work[2]
    for body in range(sample.shape[0]):
        for column in range(10):
            sample[body, column] = rigid[body, column]
        sums[1] += system.gravity * system.mass[body] * rigid[body, 2]
        for axis in range(3):
            sample[body, 10 + axis] = rigid[body, 10 + axis] / inertia[body, axis]
            sums[0] += 0.5 * (
                system.mass[body] * rigid[body, 3 + axis] ** 2 + rigid[body, 10 + axis] ** 2 / inertia[body, axis]
            )
    for mode in range(strain.shape[1]):
        sums[0] += 0.5 * strain[1, mode] ** 2
        sums[2] += 0.5 * (system.frequencies[mode] * strain[0, mode]) ** 2
    for side in range(system.carrier.size):
        for index in range(state.listed[side], state.listed[side + 1]):
            sums[3] += 0.5 * state.stiffness[index] * max(state.depth[index], 0.0) ** 2
