"""
The linear model by the paper's own two step-by-step schemes, for the study of their convergence.

Manos, Petalas and Demosthenous integrate θ̈ = p² [θ − α s − a/g] with a single-step scheme (Runge–Kutta of fourth order)
and a multi-step one (Hamming's predictor–corrector, the first four values of each arc from Runge–Kutta), by steps of
1e-4 s that are divided by ten just before and after each contact. A contact is taken at the end of the step in which
θ changes its sign.
"""

from __future__ import annotations

from math import pi
from typing import Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.history import History
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.motion import Motion

Scheme = Literal["runge-kutta", "hamming"]

PAPERS_STEP = 1e-4
"""s."""

PAPERS_REFINEMENT = 10
"""By which a step is divided around a contact."""


def rock_by_steps(
    block: Block,
    motion: Motion,
    *,
    scheme: Scheme,
    steps_per_sample: int,
    refinement: int = PAPERS_REFINEMENT,
    restitution: Sided | None = None,
    theta0: float = 0.0,
    omega0: float = 0.0,
    rest_angle: float = 1e-6,
) -> History:
    """
    Compute how a block rocks by the linear equation, step by step.

    Parameters
    ----------
    block, motion, restitution, theta0, omega0, rest_angle
        As for `rock`.
    scheme : {"runge-kutta", "hamming"}
    steps_per_sample : int
        Equal steps within each interval of the motion, so that no step straddles a sample.
    refinement : int, optional
        The step in which θ changes its sign, and the one that follows, are walked again in so many; 1: they are not.

    Returns
    -------
    history : History
        At the motion's samples. A block that reaches ±π/2 lies there; whether one between α and π/2 would come back is
        not asked.

    Raises
    ------
    ValueError
        If the scheme is not known or a number of steps is below 1.
    """
    if scheme not in ("runge-kutta", "hamming"):
        raise ValueError(f'There is no scheme "{scheme}"; "runge-kutta" or "hamming" was expected')
    if steps_per_sample < 1 or refinement < 1:
        raise ValueError(
            f"steps_per_sample is {steps_per_sample} and refinement {refinement}; whole numbers from 1 on were expected"
        )
    e = pair(block.restitution if restitution is None else restitution)
    sides = (block.negative, block.positive)
    angle, velocity, times, velocities, overturning_time = integrate(
        motion.acceleration / block.gravity,
        motion.dt,
        np.array([side.critical_angle for side in sides]),
        np.array([block.side_p(side) for side in sides]),
        np.array(e),
        rest_angle,
        float(theta0),
        float(omega0),
        steps_per_sample,
        refinement,
        scheme == "hamming",
    )
    rebounds = np.where(velocities > 0.0, *e) * velocities
    return History(block, motion.time, angle, velocity, times, velocities, rebounds, overturning_time)


@kernel
def _runge_kutta(
    angle: float, velocity: float, step: float, base: float, end: float, pull: float, square: float
) -> tuple[float, float]:
    """Take one step of the classical scheme of fourth order; `base` and `end` are a/g at its ends, `pull` is α s."""
    half, middle = 0.5 * step, pull + 0.5 * (base + end)
    turning1 = square * (angle - pull - base)
    second = velocity + half * turning1
    turning2 = square * (angle + half * velocity - middle)
    third = velocity + half * turning2
    turning3 = square * (angle + half * second - middle)
    fourth = velocity + step * turning3
    turning4 = square * (angle + step * third - pull - end)
    return (
        angle + step / 6.0 * (velocity + 2.0 * (second + third) + fourth),
        velocity + step / 6.0 * (turning1 + 2.0 * (turning2 + turning3) + turning4),
    )


@kernel
def _hamming(past: Array, gap: Array, step: float, end: float, pull: float, square: float) -> tuple[float, float]:
    """
    Take one step of Hamming's scheme.

    `past` holds θ, ω and ω̇ of the last four values, newest last; `gap` the last predictors less their correctors.
    """
    third = 4.0 * step / 3.0
    predicted = past[0, 0] + third * (2.0 * past[3, 1] - past[2, 1] + 2.0 * past[1, 1])
    predicted_velocity = past[0, 1] + third * (2.0 * past[3, 2] - past[2, 2] + 2.0 * past[1, 2])
    angle, velocity = predicted - 112.0 / 121.0 * gap[0], predicted_velocity - 112.0 / 121.0 * gap[1]
    turning = square * (angle - pull - end)
    thrice = 3.0 * step
    corrected = 0.125 * (9.0 * past[3, 0] - past[1, 0] + thrice * (velocity + 2.0 * past[3, 1] - past[2, 1]))
    corrected_velocity = 0.125 * (9.0 * past[3, 1] - past[1, 1] + thrice * (turning + 2.0 * past[3, 2] - past[2, 2]))
    gap[0], gap[1] = predicted - corrected, predicted_velocity - corrected_velocity
    return corrected + 9.0 / 121.0 * gap[0], corrected_velocity + 9.0 / 121.0 * gap[1]


@kernel
def integrate(
    base: Array,
    dt: float,
    critical: Array,
    p: Array,
    restitution: Array,
    rest_angle: float,
    angle: float,
    velocity: float,
    steps_per_sample: int,
    refinement: int,
    hamming: bool,
) -> tuple[Array, Array, Array, Array, float]:
    """Walk over the samples of a base motion; arguments and results as `linear.propagate` and `rock_by_steps`."""
    count = base.size
    angles, velocities = np.zeros(count), np.zeros(count)
    impact_times, impact_velocities = np.empty(64), np.empty(64)
    impacts, known, finely = 0, 0, 0
    passed = np.nan
    past, gap = np.empty((4, 3)), np.zeros(2)
    resting = angle == 0.0 and velocity == 0.0
    side = 1.0 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else -1.0
    here = 1 if side > 0.0 else 0
    squares, whole = p * p, dt / steps_per_sample
    angles[0], velocities[0] = angle, velocity
    for sample in range(count - 1):
        change = (base[sample + 1] - base[sample]) / steps_per_sample
        for within in range(steps_per_sample):
            first = base[sample] + within * change
            kept_angle, kept_velocity = angle, velocity
            parts, step, rise = (refinement, whole / refinement, change / refinement) if finely else (1, whole, change)
            part = 0
            while part < parts:
                now = first + part * rise
                then = now + rise
                if resting and -critical[1] <= now <= critical[0]:
                    part += 1
                    continue
                if resting:
                    side, resting, known = (-1.0 if now > 0.0 else 1.0), False, 0
                    here = 1 if side > 0.0 else 0
                pull, square = critical[here] * side, squares[here]
                if hamming:
                    if known == 4:
                        for k in range(3):
                            for each in range(3):
                                past[k, each] = past[k + 1, each]
                    else:
                        gap[0], gap[1] = 0.0, 0.0
                        known += 1
                    past[known - 1, 0], past[known - 1, 1] = angle, velocity
                    past[known - 1, 2] = square * (angle - pull - now)
                if known == 4:
                    angle, velocity = _hamming(past, gap, step, then, pull, square)
                else:
                    angle, velocity = _runge_kutta(angle, velocity, step, now, then, pull, square)
                part += 1
                if side * angle >= 0.0:
                    continue
                if parts < refinement:
                    # Again from the start of this step, in small ones; so is the next.
                    angle, velocity = kept_angle, kept_velocity
                    parts, step, rise = refinement, whole / refinement, change / refinement
                    finely, part, known = 2, 0, 0
                    continue
                if impacts == impact_times.size:
                    impact_times = np.concatenate((impact_times, np.empty(impacts)))
                    impact_velocities = np.concatenate((impact_velocities, np.empty(impacts)))
                impact_times[impacts] = dt * sample + whole * within + step * part
                impact_velocities[impacts] = velocity
                impacts += 1
                velocity *= restitution[here]
                side, here, known, finely = -side, 1 - here, 0, 2
                holding = critical[here] + side * then
                risen = velocity * velocity / (2.0 * squares[here])
                if holding >= 0.0 and risen <= rest_angle * critical[here] * holding:
                    angle, velocity, resting = 0.0, 0.0, True
            if finely > 0:
                finely -= 1
                known = known if finely else 0
            if side * angle <= critical[here]:
                passed = np.nan
            elif np.isnan(passed):
                passed = dt * sample + whole * (within + 1)
            if side * angle >= 0.5 * pi:
                angles[sample + 1 :] = side * 0.5 * pi
                return angles, velocities, impact_times[:impacts].copy(), impact_velocities[:impacts].copy(), passed
        angles[sample + 1], velocities[sample + 1] = angle, velocity
    return angles, velocities, impact_times[:impacts].copy(), impact_velocities[:impacts].copy(), passed
