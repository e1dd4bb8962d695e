"""
Which points may touch within a step, and how deep they are: nodes, and rings with the arcs along which they touch.

Everything about an interface is in the axes of its target, with z out of the target's face: a point of the carrier is
in contact where its z is negative, within the face's outline. At the outline a node fades over a narrow band, in which
a node of the other body at the same place, which looks at it from the other side, comes in its place. A point that
comes over the outline from below bears from there on only: bodies that were beside each other do not burst apart.

A ring of radius r, tilted by an angle of sine σ, has the depth d − r σ (1 − cos φ) at φ from its lowest point, which is
d deep: it touches along an arc of 1 − cos φ < d / (r σ), or all around. That arc is integrated by Gauss and Legendre at
points that move with it, so that nothing depends on how the body is turned about its axis; the points' elastic slip
stays with the material of the body.
"""

from __future__ import annotations

from math import asin, atan2, cos, floor, pi, sin, sqrt

from colonnade.arrays import Array
from colonnade.dynamics.contact.state import State, System
from colonnade.dynamics.kernel import kernel_in_place

DEEPEST = 1e-4
"""Of a face's half width: a point that comes over its outline may be as deep, as one is that bears the other body."""


@kernel_in_place
def fill_poses(system: System, state: State) -> None:
    """Fill where each carrier is in the axes of its target, which are turned over where that is the upper body."""
    rigid, matrix, frame, turned, apart = state.rigid, state.matrix, state.frame, state.turned, state.apart
    for side in range(system.carrier.size):
        upper, lower = system.carrier[side], system.target[side]
        flip = 1.0 if upper > lower else -1.0
        for row in range(3):
            for column in range(3):
                frame[side, row, column] = matrix[lower, row, column] * (flip if column > 0 else 1.0)
        for row in range(3):
            apart[side, row] = -system.face[side, 4] if row == 2 else 0.0
            for axis in range(3):
                apart[side, row] += frame[side, axis, row] * (rigid[upper, axis] - rigid[lower, axis])
            for column in range(3):
                turned[side, row, column] = 0.0
                for axis in range(3):
                    turned[side, row, column] += frame[side, axis, row] * matrix[upper, axis, column]


@kernel_in_place
def fill_twists(system: System, state: State, share: float) -> None:
    """Fill the velocities of bodies, a share of the change by the kick later, and of carriers relative to targets."""
    rigid, matrix, speeds, change = state.rigid, state.matrix, state.speeds, state.change
    for body in range(system.mass.size):
        for axis in range(3):
            speeds[body, axis] = rigid[body, 3 + axis] + share * change[body, axis]
            speeds[body, 3 + axis] = 0.0
            for own in range(3):
                turning = (rigid[body, 10 + own] + share * change[body, 3 + own]) / system.inertia[body, own]
                speeds[body, 3 + axis] += matrix[body, axis, own] * turning
    for side in range(system.carrier.size):
        upper, lower = system.carrier[side], system.target[side]
        x, y = rigid[upper, 0] - rigid[lower, 0], rigid[upper, 1] - rigid[lower, 1]
        z = rigid[upper, 2] - rigid[lower, 2]
        p, q, r = speeds[lower, 3], speeds[lower, 4], speeds[lower, 5]
        u = speeds[upper, 0] - speeds[lower, 0] - (q * z - r * y)
        v = speeds[upper, 1] - speeds[lower, 1] - (r * x - p * z)
        w = speeds[upper, 2] - speeds[lower, 2] - (p * y - q * x)
        p, q, r = speeds[upper, 3] - p, speeds[upper, 4] - q, speeds[upper, 5] - r
        for axis in range(3):
            a, b, c = state.frame[side, 0, axis], state.frame[side, 1, axis], state.frame[side, 2, axis]
            state.twist[side, axis], state.twist[side, 3 + axis] = a * u + b * v + c * w, a * p + b * q + c * r


@kernel_in_place
def place(system: System, state: State, step: float) -> None:
    """List the points that may touch within `step`, interface by interface; with 0 those that do, and no arc moves."""
    fill_poses(system, state)
    fill_twists(system, state, 0.0)
    listed, twist, stands, flutter = state.listed, state.twist, state.stands, 0.0
    for mode in range(state.strain.shape[1]):
        flutter += state.strain[1, mode] ** 2
    for side in range(system.carrier.size):
        listed[side + 1] = listed[side]
        if stands[system.carrier[side]] == 1 and stands[system.target[side]] == 1:
            # A node that is higher than the fastest one moves in a step neither touched before nor does now.
            fastest = system.reach[side] * (abs(twist[side, 3]) + abs(twist[side, 4]) + abs(twist[side, 5]))
            margin = step * (abs(twist[side, 2]) + system.bend * sqrt(flutter) + fastest)
            for node in range(system.first[side], system.first[side + 1]):
                if system.radii[node] > 0.0:
                    _place_ring(system, state, side, node, step)
                else:
                    _place_point(system, state, side, node, margin)


@kernel_in_place
def _place_point(system: System, state: State, side: int, node: int, margin: float) -> None:
    """List a point node of an interface, which the modes displace, if it is lower than `margin`."""
    turned, modes, strain = state.turned, system.modes, state.strain
    x, y, z = system.nodes[node, 0], system.nodes[node, 1], system.nodes[node, 2]
    for mode in range(strain.shape[1]):
        x += modes[node, 0, mode] * strain[0, mode]
        y += modes[node, 1, mode] * strain[0, mode]
        z += modes[node, 2, mode] * strain[0, mode]
    above = turned[side, 2, 0] * x + turned[side, 2, 1] * y + turned[side, 2, 2] * z
    if state.apart[side, 2] + above < margin:
        _list(system, state, side, node, 0, 1.0, x, y, z)


@kernel_in_place
def _list(
    system: System, state: State, side: int, node: int, point: int, weight: float, x: float, y: float, z: float
) -> None:
    """
    List a point of a node with its weight, at (x, y, z) of the carrier, if it is on the face; else forget what it held.
    """
    lever, turned, apart, face, entry = state.lever, state.turned, state.apart, system.face, state.entry
    row, slot = state.listed[side + 1], system.slots[node] + point
    for axis in range(3):
        lever[row, axis] = turned[side, axis, 0] * x + turned[side, axis, 1] * y + turned[side, axis, 2] * z
    lever[row, 3], lever[row, 4], lever[row, 5] = x, y, z
    depth = -(apart[side, 2] + lever[row, 2])
    along, across = apart[side, 0] + lever[row, 0], apart[side, 1] + lever[row, 1]
    share = weight * inside(face[side, 0], face[side, 1], face[side, 2], face[side, 3], along, across)
    state.node[row], state.slot[row] = node, slot
    state.stiffness[row], state.damping[row] = share * system.stiffness[node], share * system.damping[node]
    # From where on it bears; off the face it is kept as −1 less that.
    bears = entry[slot] if entry[slot] >= 0.0 else -1.0 - entry[slot]
    if depth <= 0.0:
        bears = 0.0
    if share == 0.0:
        state.touched[slot], state.slip[slot, 0], state.slip[slot, 1], entry[slot] = 0, 0.0, 0.0, -1.0 - bears
        return
    # One that comes over the outline from below bears from there on: the spring that it meets was never compressed.
    half_width = face[side, 0] if system.radii[node] == 0.0 else system.radii[node]
    if entry[slot] < 0.0 and depth > bears + DEEPEST * half_width:
        bears = depth
    entry[slot], state.depth[row], state.listed[side + 1] = bears, depth - bears, row + 1


@kernel_in_place
def inside(half_x: float, half_y: float, band: float, is_round: float, x: float, y: float) -> float:
    """Say how much a point at (x, y) of a face counts: 1 inside its outline, 0 outside, ½ at the edge."""
    # Most points are far inside: they need neither root nor quotient.
    if is_round == 1.0 and x * x + y * y <= (half_x - band) ** 2:
        return 1.0
    within = half_x - sqrt(x * x + y * y) if is_round == 1.0 else min(half_x - abs(x), half_y - abs(y))
    return 1.0 if within >= band else min(max(0.5 + within / band, 0.0), 1.0)


@kernel_in_place
def _place_ring(system: System, state: State, side: int, node: int, step: float) -> None:
    """List the points of a ring's arc that may touch within the step."""
    turned, twist, arc, arcs = state.turned, state.twist, system.arc, state.arcs
    radius, z = system.radii[node], system.nodes[node, 2]
    # How deep its lowest point is, and half of what its highest is above that.
    rise = radius * sqrt(turned[side, 2, 0] ** 2 + turned[side, 2, 1] ** 2)
    depth = rise - state.apart[side, 2] - turned[side, 2, 2] * z
    # How fast the ring can sink anywhere: at its middle, and by its turning at the radius.
    p, q = twist[side, 3], twist[side, 4]
    sinking = abs(twist[side, 2] + z * (p * turned[side, 1, 2] - q * turned[side, 0, 2]))
    along = p * turned[side, 1, 0] - q * turned[side, 0, 0]
    across = p * turned[side, 1, 1] - q * turned[side, 0, 1]
    sinking += radius * sqrt(along**2 + across**2)
    # The arc about the lowest point that touches at the end of half a step of it.
    depth, half = depth + 0.5 * step * sinking, 0.0
    if depth > 0.0:
        half = pi if depth >= 2.0 * rise else 2.0 * asin(sqrt(0.5 * depth / rise))
    angle = atan2(-turned[side, 2, 1], -turned[side, 2, 0]) if rise > 0.0 else arcs[node, 0]
    if step > 0.0 and (angle != arcs[node, 0] or half != arcs[node, 1]):
        _move_arc(system, state, side, node, angle, half)
    for point in range(arc.shape[1] if half > 0.0 else 0):
        about = angle + half * arc[0, point]
        weight = half * arc[1, point] / (2.0 * pi)
        _list(system, state, side, node, point, weight, radius * cos(about), radius * sin(about), z)


@kernel_in_place
def _move_arc(system: System, state: State, side: int, node: int, angle: float, half: float) -> None:
    """Move a ring's arc; its slip stays with the body's material, which enters with none and loses it as it leaves."""
    slip, touched, carried, first = state.slip, state.touched, state.carried, system.slots[node]
    places, weights, points = system.arc[0], system.arc[1], system.arc.shape[1]
    former, span = state.arcs[node, 0], state.arcs[node, 1]
    state.arcs[node, 0], state.arcs[node, 1] = angle, half
    held, any_touched = 0.0, 0
    for point in range(points):
        # What the arc held before, and the slip at the points' new places, which are `about` from the former middle.
        held += span * weights[point] * (slip[first + point, 0] ** 2 + slip[first + point, 1] ** 2)
        any_touched = max(any_touched, touched[first + point])
        about = angle + half * places[point] - former
        if not -pi <= about < pi:
            about -= 2.0 * pi * floor((about + pi) / (2.0 * pi))
        carried[point, 0], carried[point, 1] = 0.0, 0.0
        if half > 0.0 and span > 0.0 and (abs(about) < span or span >= pi):
            _read_slip(slip, first, places, about / span, span >= pi, carried, point)
    # Take the new slip; the energy that is lost with the material that left is booked as friction's.
    for point in range(points):
        held -= half * weights[point] * (carried[point, 0] ** 2 + carried[point, 1] ** 2)
        slip[first + point, 0], slip[first + point, 1] = carried[point, 0], carried[point, 1]
        touched[first + point] = any_touched if half > 0.0 else 0
    state.work[1] += 0.5 * system.stiffness[node] * held / (2.0 * pi)


@kernel_in_place
def _read_slip(slip: Array, first: int, places: Array, sought: float, around: bool, carried: Array, point: int) -> None:
    """Fill the slip at a place along the arc: linear between the points; past the last, 0 or (`around`) the first."""
    points, right = places.size, 0
    while right < points and places[right] <= sought:
        right += 1
    low = places[right - 1] if right > 0 else (places[points - 1] - 2.0 if around else -1.0)
    high = places[right] if right < points else (places[0] + 2.0 if around else 1.0)
    share = (sought - low) / (high - low)
    for axis in range(2):
        before = slip[first + (right - 1) % points, axis] if right > 0 or around else 0.0
        after = slip[first + right % points, axis] if right < points or around else 0.0
        carried[point, axis] = before + share * (after - before)
