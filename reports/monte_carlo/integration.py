"""
The angle of the study's records: the full nonlinear equation step by step, by Runge and Kutta's fourth-order method.

    θ̈ = −p² sin(α sgn θ − θ)

Between steps the angle is Hermite's cubic; the last step of an arc is cut, by Newton's method, to end at θ = 0.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from colonnade.arrays import Array
from monte_carlo.truth import FreeRocking

STEP = 0.005
"""Of 1/p: errors of 1e-11 of α."""

FEWEST_STEPS = 20
"""In an arc, however short."""

STANDING = 1e-7
"""Of p α: velocity after an impact below which the block stands; it would rise to 5e-15 α."""


def integrated_angle(
    rocking: FreeRocking, time: Array, restitutions: Array | None = None, by_speed: float = 0.0
) -> tuple[Array, Array, Array]:
    """
    Integrate an angle.

    Parameters
    ----------
    rocking : FreeRocking
    time : ndarray, shape (n,)
        s.
    restitutions : ndarray, shape (m,), optional
        e of each impact, that of the last for all later ones; default: that of `rocking`.
    by_speed : float, optional
        What is added to e at a speed of p α.

    Returns
    -------
    angle : ndarray, shape (n,)
        rad, with the zero offset.
    impacts, used : ndarray
        Times of the impacts up to the last of `time`, s, and e of each.
    """
    side = np.sign(rocking.release_angle)
    heights, impacts, used = _integrate(
        time,
        rocking.critical_angle,
        rocking.p,
        np.array([rocking.restitution]) if restitutions is None else restitutions,
        by_speed,
        abs(rocking.release_angle),
        rocking.release_time,
    )
    return side * heights + rocking.zero_offset, impacts, used


@njit(cache=True)
def _step(height, velocity, length, alpha, square):
    """One step of |θ| and its rate: |θ|'' = −p² sin(α − |θ|)."""
    first = -square * np.sin(alpha - height)
    middle_velocity = velocity + 0.5 * length * first
    second = -square * np.sin(alpha - height - 0.5 * length * velocity)
    other_velocity = velocity + 0.5 * length * second
    third = -square * np.sin(alpha - height - 0.5 * length * middle_velocity)
    last_velocity = velocity + length * third
    fourth = -square * np.sin(alpha - height - length * other_velocity)
    return (
        height + length / 6 * (velocity + 2 * middle_velocity + 2 * other_velocity + last_velocity),
        velocity + length / 6 * (first + 2 * second + 2 * third + fourth),
    )


@njit(cache=True)
def _integrate(time, alpha, p, restitutions, by_speed, release, begin):
    angles = np.zeros(time.size)
    impacts, used = [0.0 for _ in range(0)], [0.0 for _ in range(0)]
    filled = np.searchsorted(time, begin)
    angles[:filled] = release
    now, height, velocity, side, square = begin, release, 0.0, 1.0, p * p
    longest = STEP / p
    length = longest
    while filled < time.size:
        taken = length
        next_height, next_velocity = _step(height, velocity, taken, alpha, square)
        landed = next_height <= 0.0 and next_velocity < 0.0
        if landed:
            for _ in range(6):
                taken -= next_height / next_velocity
                next_height, next_velocity = _step(height, velocity, taken, alpha, square)
        while filled < time.size and time[filled] <= now + taken:
            share = (time[filled] - now) / taken
            angles[filled] = side * (
                (1 + 2 * share) * (1 - share) ** 2 * height
                + share * (1 - share) ** 2 * taken * velocity
                + share**2 * (3 - 2 * share) * next_height
                + share**2 * (share - 1) * taken * next_velocity
            )
            filled += 1
        now, height, velocity = now + taken, next_height, next_velocity
        if landed:
            restitution = restitutions[min(len(used), restitutions.size - 1)] - by_speed * velocity / (p * alpha)
            impacts.append(now)
            used.append(restitution)
            side, height, velocity = -side, 0.0, -restitution * velocity
            if velocity < STANDING * p * alpha:
                break
            length = min(longest, 2 * velocity / (square * np.sin(alpha)) / FEWEST_STEPS)
    return angles, np.array(impacts), np.array(used)
