"""
The law of contact at one point.

A point's normal force is the mean over the step of what its depth, linear in time, gives: contact that begins or ends
within a step counts for the part of the step that it lasts.
"""

from __future__ import annotations

from math import sqrt

from colonnade.dynamics.contact.engine.state import Body, Near, State
from colonnade.dynamics.kernel import kernel


@kernel
def fill_force(body: Body, state: State, near: Near, index: int, step: float) -> None:
    """Fill the force of one near point by the law of contact, and what becomes of its slip."""
    node, share, depth, load = near.node[index], near.share[index], near.depth[index], near.load
    contact, slip = body.contact, state.slip[near.slot[index]]
    # Normal: the part of the step that the point is in contact, and the mean depth times that part.
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
    # The slip of before, as far as this normal force still holds it.
    stiffness, x, y = share * contact[node, 2], slip[0], slip[1]
    held = stiffness**2 * (x**2 + y**2)
    if held > limit**2:
        keep = limit / sqrt(held)
        x, y = keep * x, keep * y
    load[index, 7], load[index, 8] = x, y
    # The slip after the step; beyond the limit of friction the point slides.
    x, y = x + load[index, 12], y + load[index, 13]
    stretched, sticks = stiffness**2 * (x**2 + y**2), 1.0
    if stretched > limit**2:
        keep, sticks = limit / sqrt(stretched), 0.0
        x, y = keep * x, keep * y
    along, across = -stiffness * x, -stiffness * y
    # A point that sticks is damped, up to the limit.
    if sticks == 1.0:
        along -= share * contact[node, 3] * load[index, 9]
        across -= share * contact[node, 3] * load[index, 10]
        pulled = along**2 + across**2
        if pulled > limit**2:
            keep = limit / sqrt(pulled)
            along, across = keep * along, keep * across
    load[index, 0], load[index, 1], load[index, 2], load[index, 3] = along, across, normal, elastic
    load[index, 4], load[index, 5], load[index, 6] = x, y, sticks
