"""
Rings: whole circles of the base about the body's axis, each with the arc along which it touches.

A ring of radius r, tilted by an angle of sine σ, has the depth d − r σ (1 − cos φ) at φ from its lowest point, which is
d deep: it touches along an arc of 1 − cos φ < d / (r σ), or all around. That arc is integrated by Gauss and Legendre at
points that move with it, so that nothing depends on how the body is turned about its axis; the points' elastic slip
stays with the material of the body.
"""

from __future__ import annotations

from math import asin, atan2, cos, floor, pi, sin, sqrt

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.points import put
from colonnade.dynamics.contact.engine.state import Body, Near, State
from colonnade.dynamics.kernel import kernel


@kernel
def place_rings(body: Body, state: State, near: Near, count: int, step: float) -> int:
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
        # How fast the ring can sink anywhere: at its centre, and by its turning at the radius.
        sinking = abs(state.rigid[5] + z * (matrix[2, 0] * about_y - matrix[2, 1] * about_x))
        along = matrix[2, 1] * about_z - matrix[2, 2] * about_y
        across = matrix[2, 2] * about_x - matrix[2, 0] * about_z
        sinking += radius * sqrt(along**2 + across**2)
        # The arc about the lowest point that touches at the end of half a step of it.
        half = _half_arc(depth + 0.5 * step * sinking, rise)
        angle = atan2(-matrix[2, 1], -matrix[2, 0]) if rise > 0.0 else state.arcs[node, 0]
        _move_arc(body, state, near, node, angle, half)
        if half == 0.0:
            continue
        for point in range(points):
            turned = angle + half * places[point]
            x, y = radius * cos(turned), radius * sin(turned)
            put(matrix, near.lever, count, x, y, z)
            near.depth[count] = -(state.rigid[2] + near.lever[count, 2])
            near.node[count], near.slot[count] = node, body.slots[node] + point
            near.share[count] = half * weights[point] / (2.0 * pi)
            count += 1
    return count


@kernel
def lowest_and_energy(body: Body, state: State, node: int) -> tuple[float, float]:
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
def _move_arc(body: Body, state: State, near: Near, node: int, angle: float, half: float) -> None:
    """Move a ring's arc; its slip stays with the body's material, which enters with none and loses it as it leaves."""
    slip, touched, carried, first = state.slip, state.touched, near.carried, body.slots[node]
    places, weights, points = body.arc[0], body.arc[1], body.arc.shape[1]
    former, span = state.arcs[node, 0], state.arcs[node, 1]
    if angle == former and half == span:
        return
    state.arcs[node, 0], state.arcs[node, 1] = angle, half
    held, any_touched = 0.0, 0
    for point in range(points):
        # What the arc held before, and the slip at the points' new places, which are `turned` from the former middle.
        held += span * weights[point] * (slip[first + point, 0] ** 2 + slip[first + point, 1] ** 2)
        any_touched = max(any_touched, touched[first + point])
        turned = angle + half * places[point] - former
        turned -= 2.0 * pi * floor((turned + pi) / (2.0 * pi))
        carried[point, 0], carried[point, 1] = 0.0, 0.0
        if half > 0.0 and span > 0.0 and (abs(turned) < span or span >= pi):
            _read_slip(slip, first, places, turned / span, span >= pi, carried, point)
    # Take the new slip; the energy that is lost with the material that left is booked as friction's.
    for point in range(points):
        held -= half * weights[point] * (carried[point, 0] ** 2 + carried[point, 1] ** 2)
        slip[first + point, 0], slip[first + point, 1] = carried[point, 0], carried[point, 1]
        touched[first + point] = any_touched if half > 0.0 else 0
    state.ledger[2] += 0.5 * body.contact[node, 2] * held / (2.0 * pi)


@kernel
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
