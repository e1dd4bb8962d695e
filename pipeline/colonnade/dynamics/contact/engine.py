"""
The motion of one body on a table, step by step.

Each step drifts half a step without contact, takes the contact's impulse at that middle, and drifts the other half:

    drift   ẍ = g − a(t); free rotation; η̈ + 2 ζ ω η̇ + ω² η = 0, solved exactly
    kick    m Δv = h ΣF, ΔL = h Σ r × F, Δη̇ = h ΣΦᵀF, with F at the mean of the velocities before and after

Everything is relative to the table; gravity and the table's acceleration a act alike. Free rotation turns about the
body's axes one after the other, each turn exact and in mirrored order (Dullweber, Leimkuhler and McLachlan 1997), so
that the angular momentum is kept to rounding. A node's normal force is the mean over the step of what its depth, linear
in time, gives: contact that begins or ends within a step counts for the part of the step that it lasts.
Flight is of second order in the step, an impact of about first: of the paper's prism one impact later, a step of 10 µs
costs 2e-5 to 1e-4 of α.

A node is a point of the base or a whole ring, a circle about the body's axis. A ring of radius r, tilted by an angle of
sine σ, has the depth d − r σ (1 − cos φ) at φ from its lowest point, which is d deep: it touches along an arc of
1 − cos φ < d / (r σ), or all around. That arc is integrated by Gauss and Legendre at points that move with it, so that
nothing depends on how the body is turned about its axis; the points' elastic slip stays with the material of the body.
All kernels of this chain stand in this file (see `kernel`).
"""

from __future__ import annotations

from math import asin, atan2, cos, floor, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.contact.state import IMPACT, Body, Near, State
from colonnade.dynamics.kernel import kernel

Array = NDArray[np.float64]

PASSES = 3
"""Evaluations of the contact forces in one step, each with the mean velocity that the one before leads to."""

POLE = 0.75
"""In half widths: a block that touches only outside of this on one side rocks about the pole there."""


@kernel
def _turn(quaternion: Array, spin: Array, axis: int, angle: float) -> None:
    """Turn the body by `angle` about one of its axes; the angular momentum in space stays."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    c, s = cos(angle), sin(angle)
    spin[j], spin[k] = c * spin[j] + s * spin[k], c * spin[k] - s * spin[j]
    c, s = cos(0.5 * angle), sin(0.5 * angle)
    scalar, q_i, q_j, q_k = quaternion[0], quaternion[axis + 1], quaternion[j + 1], quaternion[k + 1]
    quaternion[0] = c * scalar - s * q_i
    quaternion[axis + 1] = c * q_i + s * scalar
    quaternion[j + 1] = c * q_j + s * q_k
    quaternion[k + 1] = c * q_k - s * q_j


@kernel
def _matrix(state: State) -> None:
    """Fill the rotation matrix, body to table."""
    matrix, w, x, y, z = state.matrix, state.rigid[6], state.rigid[7], state.rigid[8], state.rigid[9]
    scale = 2.0 / (w * w + x * x + y * y + z * z)
    matrix[0, 0], matrix[1, 1] = 1 - scale * (y * y + z * z), 1 - scale * (x * x + z * z)
    matrix[2, 2] = 1 - scale * (x * x + y * y)
    matrix[0, 1], matrix[1, 0] = scale * (x * y - w * z), scale * (x * y + w * z)
    matrix[0, 2], matrix[2, 0] = scale * (x * z + w * y), scale * (x * z - w * y)
    matrix[1, 2], matrix[2, 1] = scale * (y * z - w * x), scale * (y * z + w * x)


@kernel
def _drift(body: Body, state: State, pull: Array, step: float) -> None:
    """Move without contact for `step`, half a step of the scheme; pull is minus the table's mean acceleration."""
    mass, gravity, rigid, strain, modal = body.mass, body.gravity, state.rigid, state.strain, body.propagators
    for axis in range(3):
        acceleration = pull[axis] - (gravity if axis == 2 else 0.0)
        moved = step * (rigid[3 + axis] + 0.5 * step * acceleration)
        rigid[axis] += moved
        rigid[3 + axis] += step * acceleration
        state.ledger[0] += mass * pull[axis] * moved
    quaternion, spin = rigid[6:10], rigid[10:13]
    _turn(quaternion, spin, 0, 0.5 * step * spin[0] / body.inertia[0])
    _turn(quaternion, spin, 1, 0.5 * step * spin[1] / body.inertia[1])
    _turn(quaternion, spin, 2, step * spin[2] / body.inertia[2])
    _turn(quaternion, spin, 1, 0.5 * step * spin[1] / body.inertia[1])
    _turn(quaternion, spin, 0, 0.5 * step * spin[0] / body.inertia[0])
    _matrix(state)
    for mode in range(strain.shape[1]):
        value, rate, square = strain[0, mode], strain[1, mode], body.frequencies[mode] ** 2
        strain[0, mode] = modal[0, mode] * value + modal[1, mode] * rate
        strain[1, mode] = modal[2, mode] * value + modal[3, mode] * rate
        before = rate**2 + square * value**2
        state.ledger[3] += 0.5 * (before - strain[1, mode] ** 2 - square * strain[0, mode] ** 2)


@kernel
def _fastest(body: Body, state: State, reach: float, bend: float) -> float:
    """Bound the speed of a node: one that is higher than it moves in a step neither touched before nor does now."""
    bound, flutter = abs(state.rigid[5]), 0.0
    for axis in range(3):
        bound += reach * abs(state.rigid[10 + axis]) / body.inertia[axis]
    for mode in range(state.strain.shape[1]):
        flutter += state.strain[1, mode] ** 2
    return float(bound + bend * sqrt(flutter))


@kernel
def _place(body: Body, state: State, near: Near, margin: float) -> int:
    """List the point nodes lower than `margin`, with their levers (in table and in body axes) and depths."""
    nodes, modes, strain, matrix = body.nodes, body.modes, state.strain, state.matrix
    count, height = 0, state.rigid[2]
    for node in range(nodes.shape[0]):
        if body.radii[node] > 0.0:
            continue
        x, y, z = nodes[node, 0], nodes[node, 1], nodes[node, 2]
        for mode in range(strain.shape[1]):
            x += modes[node, 0, mode] * strain[0, mode]
            y += modes[node, 1, mode] * strain[0, mode]
            z += modes[node, 2, mode] * strain[0, mode]
        above = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z
        if height + above >= margin:
            continue
        near.lever[count, 0] = matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z
        near.lever[count, 1] = matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z
        near.lever[count, 2] = above
        near.lever[count, 3], near.lever[count, 4], near.lever[count, 5] = x, y, z
        near.depth[count] = -(height + above)
        near.node[count], near.slot[count], near.share[count] = node, body.slots[node], 1.0
        count += 1
    return count


@kernel
def _lowest(body: Body, state: State, node: int) -> tuple[float, float]:
    """Give the depth of a ring's lowest point, and what its highest is above it, over 2."""
    rise = body.radii[node] * sqrt(state.matrix[2, 0] ** 2 + state.matrix[2, 1] ** 2)
    return rise - state.rigid[2] - state.matrix[2, 2] * body.nodes[node, 2], rise


@kernel
def _half_arc(depth: float, rise: float) -> float:
    """Give the angle from a ring's lowest point to where its depth is 0."""
    if depth <= 0.0:
        return 0.0
    return pi if depth >= 2.0 * rise else 2.0 * asin(sqrt(0.5 * depth / rise))


@kernel
def _place_rings(body: Body, state: State, near: Near, count: int, step: float) -> int:
    """Add the points of the rings' arcs that may touch within the step to the `count` points that are listed."""
    matrix, spin, inertia = state.matrix, state.rigid[10:13], body.inertia
    places, weights, points = body.arc[0], body.arc[1], body.arc.shape[1]
    if body.slots[-1] == body.nodes.shape[0]:
        return count
    about_x, about_y, about_z = spin[0] / inertia[0], spin[1] / inertia[1], spin[2] / inertia[2]
    for node in range(body.nodes.shape[0]):
        radius, z = body.radii[node], body.nodes[node, 2]
        if radius == 0.0:
            continue
        depth, rise = _lowest(body, state, node)
        sinking = abs(state.rigid[5] + z * (matrix[2, 0] * about_y - matrix[2, 1] * about_x))
        along = matrix[2, 1] * about_z - matrix[2, 2] * about_y
        across = matrix[2, 2] * about_x - matrix[2, 0] * about_z
        sinking += radius * sqrt(along**2 + across**2)
        half = _half_arc(depth + 0.5 * step * sinking, rise)
        angle = atan2(-matrix[2, 1], -matrix[2, 0]) if rise > 0.0 else state.arcs[node, 0]
        _carry(body, state, near, node, angle, half)
        if half == 0.0:
            continue
        for point in range(points):
            turned = angle + half * places[point]
            x, y = radius * cos(turned), radius * sin(turned)
            above = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z
            near.lever[count, 0] = matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z
            near.lever[count, 1] = matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z
            near.lever[count, 2] = above
            near.lever[count, 3], near.lever[count, 4], near.lever[count, 5] = x, y, z
            near.depth[count] = -(state.rigid[2] + above)
            near.node[count], near.slot[count] = node, body.slots[node] + point
            near.share[count] = half * weights[point] / (2.0 * pi)
            count += 1
    return count


@kernel
def _carry(body: Body, state: State, near: Near, node: int, angle: float, half: float) -> None:
    """Move a ring's arc; its slip stays with the body's material, which enters with none and loses it as it leaves."""
    slip, touched, carried, first = state.slip, state.touched, near.carried, body.slots[node]
    places, weights, points = body.arc[0], body.arc[1], body.arc.shape[1]
    former, span = state.arcs[node, 0], state.arcs[node, 1]
    if angle == former and half == span:
        return
    state.arcs[node, 0], state.arcs[node, 1] = angle, half
    held, any_touched = 0.0, 0
    for point in range(points):
        place, around = first + point, span >= pi
        held += span * weights[point] * (slip[place, 0] ** 2 + slip[place, 1] ** 2)
        any_touched = max(any_touched, touched[place])
        carried[point, 0], carried[point, 1] = 0.0, 0.0
        turned = angle + half * places[point] - former
        turned -= 2.0 * pi * floor((turned + pi) / (2.0 * pi))
        if half == 0.0 or span == 0.0 or (abs(turned) >= span and not around):
            continue
        # Linear between the points of before; all around beyond the last one comes the first, else nothing.
        sought, right = turned / span, 0
        while right < points and places[right] <= sought:
            right += 1
        low = places[right - 1] if right > 0 else (places[points - 1] - 2.0 if around else -1.0)
        high = places[right] if right < points else (places[0] + 2.0 if around else 1.0)
        share = (sought - low) / (high - low)
        for axis in range(2):
            before = slip[first + (right - 1) % points, axis] if right > 0 or around else 0.0
            after = slip[first + right % points, axis] if right < points or around else 0.0
            carried[point, axis] = before + share * (after - before)
    for point in range(points):
        held -= half * weights[point] * (carried[point, 0] ** 2 + carried[point, 1] ** 2)
        slip[first + point, 0], slip[first + point, 1] = carried[point, 0], carried[point, 1]
        touched[first + point] = any_touched if half > 0.0 else 0
    state.ledger[2] += 0.5 * body.contact[node, 2] * held / (2.0 * pi)


@kernel
def _flow(body: Body, state: State, near: Near, count: int) -> None:
    """Fill the velocities of the near nodes, v + ω × r + R Φ η̇."""
    speeds, rates, modes, matrix = near.speeds, near.rates, body.modes, state.matrix
    lever, load = near.lever, near.load
    for index in range(count):
        x, y, z = lever[index, 0], lever[index, 1], lever[index, 2]
        load[index, 9] = speeds[0] + speeds[4] * z - speeds[5] * y
        load[index, 10] = speeds[1] + speeds[5] * x - speeds[3] * z
        load[index, 11] = speeds[2] + speeds[3] * y - speeds[4] * x
        if rates.size > 0:
            node, u, v, w = near.node[index], 0.0, 0.0, 0.0
            for mode in range(rates.size):
                u += modes[node, 0, mode] * rates[mode]
                v += modes[node, 1, mode] * rates[mode]
                w += modes[node, 2, mode] * rates[mode]
            for axis in range(3):
                load[index, 9 + axis] += matrix[axis, 0] * u + matrix[axis, 1] * v + matrix[axis, 2] * w


@kernel
def _force(body: Body, state: State, near: Near, index: int, step: float) -> None:
    """Fill the force of one near node by the law of contact, and what becomes of its slip."""
    node, share, depth, load = near.node[index], near.share[index], near.depth[index], near.load
    contact, slip = body.contact, state.slip[near.slot[index]]
    sinking = -load[index, 11] * step
    high, part, mean = depth + 0.5 * abs(sinking), 1.0, depth
    if high <= 0.0:
        part, mean = 0.0, 0.0
    elif high < abs(sinking):
        part = high / abs(sinking)
        mean = 0.5 * part * high
    elastic = share * contact[node, 0] * mean
    normal = max(0.0, elastic - part * share * contact[node, 1] * load[index, 11])
    limit = body.friction * normal if normal > 0.0 else 0.0
    stiffness, x, y = share * contact[node, 2], slip[0], slip[1]
    held = stiffness**2 * (x**2 + y**2)
    if held > limit**2:
        keep = limit / sqrt(held)
        x, y = keep * x, keep * y
    load[index, 7], load[index, 8] = x, y
    x, y = x + load[index, 12], y + load[index, 13]
    stretched, sticks = stiffness**2 * (x**2 + y**2), 1.0
    if stretched > limit**2:
        keep, sticks = limit / sqrt(stretched), 0.0
        x, y = keep * x, keep * y
    along, across = -stiffness * x, -stiffness * y
    if sticks == 1.0:
        along -= share * contact[node, 3] * load[index, 9]
        across -= share * contact[node, 3] * load[index, 10]
        pulled = along**2 + across**2
        if pulled > limit**2:
            keep = limit / sqrt(pulled)
            along, across = keep * along, keep * across
    load[index, 0], load[index, 1], load[index, 2], load[index, 3] = along, across, normal, elastic
    load[index, 4], load[index, 5], load[index, 6] = x, y, sticks


@kernel
def _kick(body: Body, state: State, near: Near, count: int, step: float) -> None:
    """Take the contact's impulse, and book it."""
    rigid, matrix, total, lever, load = state.rigid, state.matrix, state.total, near.lever, near.load
    kept, change, gain = state.strain.shape[1], near.change, near.gain
    change[:], gain[:], total[:] = 0.0, 0.0, 0.0
    if count == 0:
        return
    for turn in range(PASSES + 1):
        # The last turn only gives the mean velocities that the ledger needs.
        for axis in range(3):
            near.speeds[axis] = rigid[3 + axis] + 0.5 * change[axis]
            near.speeds[3 + axis] = 0.0
            for own in range(3):
                turning = (rigid[10 + own] + 0.5 * change[3 + own]) / body.inertia[own]
                near.speeds[3 + axis] += matrix[axis, own] * turning
        for mode in range(kept):
            near.rates[mode] = state.strain[1, mode] + 0.5 * gain[mode]
        _flow(body, state, near, count)
        if turn == 0:
            for index in range(count):
                first = 0.0 if state.touched[near.slot[index]] == 0 else step
                load[index, 12], load[index, 13] = first * load[index, 9], first * load[index, 10]
        if turn == PASSES:
            break
        total[:], gain[:] = 0.0, 0.0
        for index in range(count):
            _force(body, state, near, index, step)
            x, y, z = load[index, 0], load[index, 1], load[index, 2]
            for axis in range(3):
                total[axis] += load[index, axis]
            total[3] += lever[index, 1] * z - lever[index, 2] * y
            total[4] += lever[index, 2] * x - lever[index, 0] * z
            total[5] += lever[index, 0] * y - lever[index, 1] * x
            if kept > 0:
                along = step * (matrix[0, 0] * x + matrix[1, 0] * y + matrix[2, 0] * z)
                across = step * (matrix[0, 1] * x + matrix[1, 1] * y + matrix[2, 1] * z)
                up = step * (matrix[0, 2] * x + matrix[1, 2] * y + matrix[2, 2] * z)
                shape = body.modes[near.node[index]]
                for mode in range(kept):
                    gain[mode] += shape[0, mode] * along + shape[1, mode] * across + shape[2, mode] * up
        for axis in range(3):
            change[axis] = step * total[axis] / body.mass
            change[3 + axis] = 0.0
            for other in range(3):
                change[3 + axis] += step * matrix[other, axis] * total[3 + other]
    for axis in range(3):
        rigid[3 + axis] += change[axis]
        rigid[10 + axis] += change[3 + axis]
    for mode in range(kept):
        state.strain[1, mode] += gain[mode]
    _settle(body, state, near, count, step)


@kernel
def _settle(body: Body, state: State, near: Near, count: int, step: float) -> None:
    """Book what the contact took, and keep the slip."""
    contact, slip, touched, ledger, load = body.contact, state.slip, state.touched, state.ledger, near.load
    for index in range(count):
        node = near.slot[index]
        stiffness = near.share[index] * contact[near.node[index], 2]
        half = 0.5 * stiffness
        ledger[1] += step * (load[index, 3] - load[index, 2]) * load[index, 11]
        held = half * (load[index, 7] ** 2 + load[index, 8] ** 2)
        ledger[2] += half * (slip[node, 0] ** 2 + slip[node, 1] ** 2) - held
        if load[index, 6] == 1.0:
            for axis in range(2):
                damping = load[index, axis] + stiffness * load[index, 4 + axis]
                ledger[1] -= step * damping * load[index, 9 + axis]
        else:
            ledger[2] -= step * (load[index, 0] * load[index, 9] + load[index, 1] * load[index, 10])
            ledger[2] += held - half * (load[index, 4] ** 2 + load[index, 5] ** 2)
        slip[node, 0], slip[node, 1] = load[index, 4], load[index, 5]
        touched[node] = 1 if load[index, 3] > 0.0 else 0


@kernel
def _pole(body: Body, state: State, side: float) -> tuple[float, float]:
    """Give the angle about y and the speed about the pole on `side`: angular momentum about it over the inertia."""
    arm_x = -(side * body.half_width * state.matrix[0, 0] - body.height * state.matrix[0, 2])
    arm_z = -(side * body.half_width * state.matrix[2, 0] - body.height * state.matrix[2, 2])
    momentum = body.mass * (arm_z * state.rigid[3] - arm_x * state.rigid[5])
    for own in range(3):
        momentum += state.matrix[1, own] * state.rigid[10 + own]
    inertia = body.inertia[1] + body.mass * (body.half_width**2 + body.height**2)
    return atan2(state.matrix[0, 2], state.matrix[2, 2]), momentum / inertia


@kernel
def _sample(body: Body, state: State, near: Near, row: Array) -> None:
    """Fill the columns of a sample but those that are accumulated."""
    rigid, strain, contact, slip, depth = state.rigid, state.strain, body.contact, state.slip, near.depth
    count = _place(body, state, near, np.inf)
    row[:10] = rigid[:10]
    row[13] = np.inf
    row[17] = 0.5 * body.mass * (rigid[3] ** 2 + rigid[4] ** 2 + rigid[5] ** 2)
    for axis in range(3):
        row[10 + axis] = rigid[10 + axis] / body.inertia[axis]
        row[17] += 0.5 * rigid[10 + axis] * row[10 + axis]
    row[18] = body.mass * body.gravity * rigid[2]
    for mode in range(strain.shape[1]):
        row[17] += 0.5 * strain[1, mode] ** 2
        row[19] += 0.5 * (body.frequencies[mode] * strain[0, mode]) ** 2
    for index in range(count):
        node, slot = near.node[index], near.slot[index]
        row[13] = min(row[13], -depth[index])
        row[20] += 0.5 * contact[node, 0] * max(depth[index], 0.0) ** 2
        if state.touched[slot] == 1:
            row[20] += 0.5 * contact[node, 2] * (slip[slot, 0] ** 2 + slip[slot, 1] ** 2)
    for node in range(body.nodes.shape[0]):
        if body.radii[node] > 0.0:
            lowest, energy = _stored(body, state, node)
            row[13] = min(row[13], -lowest)
            row[20] += energy


@kernel
def _stored(body: Body, state: State, node: int) -> tuple[float, float]:
    """Give the depth of a ring's lowest point, and the energy in its springs: ½ k d² over the arc, and that of slip."""
    depth, rise = _lowest(body, state, node)
    half, middle = _half_arc(depth, rise), depth - rise
    squares = (middle**2 + 0.5 * rise**2) * half + 2.0 * middle * rise * sin(half) + 0.25 * rise**2 * sin(2.0 * half)
    energy = body.contact[node, 0] * squares / (2.0 * pi)
    for point in range(body.arc.shape[1]):
        slot = body.slots[node] + point
        if state.touched[slot] == 1:
            share = state.arcs[node, 1] * body.arc[1, point] / (2.0 * pi)
            slipped = state.slip[slot, 0] ** 2 + state.slip[slot, 1] ** 2
            energy += 0.5 * share * body.contact[node, 2] * slipped
    return depth, energy


@kernel
def _watch(
    body: Body,
    state: State,
    near: Near,
    count: int,
    before: tuple[float, float],
    base: float,
    time: float,
    found: Array,
) -> Array:
    """Note in `found` where an arc ends and the next begins; `before` is `_pole` before this step's kick."""
    left, right, inner = False, False, False
    edge = POLE * body.half_width
    for index in range(count):
        if near.load[index, 3] > 0.0:
            left = left or near.lever[index, 3] < -edge
            right = right or near.lever[index, 3] > edge
            inner = inner or abs(near.lever[index, 3]) <= edge
    watch = state.watch
    watch[3] += 0.0 if left or right or inner else 1.0
    pole, hits = watch[0], int(watch[1])
    now = 0.0 if inner else (1.0 if right else 0.0) - (1.0 if left else 0.0)
    if abs(pole) == 1.0 and (now == -pole or inner or (left and right)):
        if hits == found.shape[0]:
            longer = np.zeros((2 * hits, IMPACT))
            longer[:hits] = found
            found = longer
        found[hits, 0], found[hits, 1], found[hits, 2] = time, before[0], before[1]
        found[hits, 3], found[hits, 4], found[hits, 5] = base, pole, np.nan
        found[hits, 9] = watch[2]
        hits, pole = hits + 1, 2.0
    if now != 0.0 and abs(pole) != 1.0:
        if pole == 2.0:
            found[hits - 1, 5], found[hits - 1, 8] = time, now
            found[hits - 1, 6], found[hits - 1, 7] = _pole(body, state, now)
        pole, watch[2] = now, 0.0
    watch[0], watch[1] = pole, hits
    return found


@kernel
def _table(motion: Array, sample: int, share: float, axis: int) -> float:
    """Give the table's acceleration at a share of the interval that ends at `sample`."""
    before = motion[sample - 1, axis]
    return float(before + (motion[sample, axis] - before) * share)


@kernel
def run(
    body: Body, state: State, near: Near, motion: Array, interval: float, parts: int, samples: Array
) -> tuple[int, Array]:
    """
    Fill the samples (shape (n, COLUMNS)) along a motion (shape (n, 3)); return how many, and the impacts.

    `parts` steps an interval. The run ends where the body lies, at a tilt of π/2.
    """
    step, pull, reach, bend = interval / parts, np.zeros(3), 0.0, 0.0
    for node in range(body.nodes.shape[0]):
        reach = max(reach, sqrt((body.nodes[node] ** 2).sum()))
        bend = max(bend, sqrt((body.modes[node] ** 2).sum()))
    found = np.zeros((64, IMPACT))
    samples[:, :] = 0.0
    _matrix(state)
    _sample(body, state, near, samples[0])
    for sample in range(1, motion.shape[0]):
        for part in range(parts):
            for axis in range(3):
                pull[axis] = -_table(motion, sample, (part + 0.25) / parts, axis)
            _drift(body, state, pull, 0.5 * step)
            count = _place(body, state, near, step * _fastest(body, state, reach, bend))
            count = _place_rings(body, state, near, count, step)
            before = _pole(body, state, state.watch[0])
            state.watch[2] = max(state.watch[2], abs(before[0]))
            _kick(body, state, near, count, step)
            time = (sample - 1) * interval + (part + 0.5) * step
            base = _table(motion, sample, (part + 0.5) / parts, 0)
            found = _watch(body, state, near, count, before, base, time, found)
            for axis in range(3):
                samples[sample, 14 + axis] += state.total[axis] / parts
                pull[axis] = -_table(motion, sample, (part + 0.75) / parts, axis)
            _drift(body, state, pull, 0.5 * step)
        _sample(body, state, near, samples[sample])
        samples[sample, 21:25] = state.ledger
        samples[sample, 25] = step * state.watch[3]
        if state.matrix[2, 2] <= 0.0:
            return sample + 1, found[: int(state.watch[1])]
    return motion.shape[0], found[: int(state.watch[1])]
