"""The impacts: where an arc of rocking about one pole ends and the next begins."""

from __future__ import annotations

from math import atan2

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.state import IMPACT, Body, Near, State
from colonnade.dynamics.kernel import kernel

POLE = 0.75
"""In half widths: a block that touches only outside of this on one side rocks about the pole there."""


@kernel
def watch_impacts(
    body: Body,
    state: State,
    near: Near,
    count: int,
    before: tuple[float, float],
    base: float,
    time: float,
    found: Array,
) -> Array:
    """
    Note in `found` where an arc ends and the next begins; `before` is `about_pole` before this step's kick.

    Returns `found`, or a longer copy where it was full.
    """
    left, right, inner = _where_it_touches(near.load, near.lever, POLE * body.half_width, count)
    watch = state.watch
    watch[3] += 0.0 if left or right or inner else 1.0
    pole, hits = watch[0], int(watch[1])
    now = 0.0 if inner else (1.0 if right else 0.0) - (1.0 if left else 0.0)
    # The arc ends where the body touches anywhere but at its pole.
    if abs(pole) == 1.0 and (now == -pole or inner or (left and right)):
        if hits == found.shape[0]:
            longer = np.zeros((2 * hits, IMPACT))
            longer[:hits] = found
            found = longer
        found[hits, 0], found[hits, 1], found[hits, 2] = time, before[0], before[1]
        found[hits, 3], found[hits, 4], found[hits, 5] = base, pole, np.nan
        found[hits, 9] = watch[2]
        hits, pole = hits + 1, 2.0
    # The next begins where it touches at one pole only.
    if now != 0.0 and abs(pole) != 1.0:
        if pole == 2.0:
            found[hits - 1, 5], found[hits - 1, 8] = time, now
            found[hits - 1, 6], found[hits - 1, 7] = about_pole(body, state, now)
        pole, watch[2] = now, 0.0
    watch[0], watch[1] = pole, hits
    return found


@kernel
def about_pole(body: Body, state: State, side: float) -> tuple[float, float]:
    """Give the angle about y and the speed about the pole on `side`: angular momentum about it over the inertia."""
    arm_x = -(side * body.half_width * state.matrix[0, 0] - body.height * state.matrix[0, 2])
    arm_z = -(side * body.half_width * state.matrix[2, 0] - body.height * state.matrix[2, 2])
    momentum = body.mass * (arm_z * state.rigid[3] - arm_x * state.rigid[5])
    for own in range(3):
        momentum += state.matrix[1, own] * state.rigid[10 + own]
    inertia = body.inertia[1] + body.mass * (body.half_width**2 + body.height**2)
    return atan2(state.matrix[0, 2], state.matrix[2, 2]), momentum / inertia


@kernel
def _where_it_touches(load: Array, lever: Array, edge: float, count: int) -> tuple[bool, bool, bool]:
    """Say whether the body touches at its left pole (beyond −`edge`), at its right one, and between them."""
    left, right, inner = False, False, False
    for index in range(count):
        if load[index, 3] > 0.0:
            x = lever[index, 3]
            left, right, inner = left or x < -edge, right or x > edge, inner or abs(x) <= edge
    return left, right, inner
