"""Steady response to a harmonic base motion: the number of cycles after which it repeats, and its amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, pi, tan

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.maps import MapPlan
from colonnade.dynamics.models import plane_model_of
from colonnade.dynamics.plane.run import Harmonic

AT_REST, IRREGULAR, OVERTURNED = 0, -1, -2
"""Orders of responses that do not repeat as rocking."""

LARGEST_ORDER = 8
"""Longest repeat looked for, in cycles of the base."""

REPEATS = 3
"""How often a response has to repeat."""

SAME = 1e-4
"""States that differ by less, as fractions of α and of α p, are the same."""


@dataclass(frozen=True)
class SteadyResponse:
    """
    Steady responses over Ω and A.

    Attributes
    ----------
    frequency_ratio, amplitude_ratio : ndarray, shape (n,) and (m,)
    order : ndarray of int8, shape (n, m)
        k ≥ 1: the response repeats every k cycles of the base (sub-harmonic 1/k for k > 1); 0 at rest, −1 irregular,
        −2 overturned.
    amplitude : ndarray, shape (n, m)
        Largest |θ|/α over the last `LARGEST_ORDER` · `REPEATS` cycles; NaN where the block overturned.
    """

    frequency_ratio: Array
    amplitude_ratio: Array
    order: NDArray[np.int8]
    amplitude: Array


def steady_response(plan: MapPlan, columns: Sequence[int], settling: int) -> SteadyResponse:
    """
    Find the steady responses, from rest, at some Ω and all A of a map, by a model in the plane.

    Parameters
    ----------
    plan : MapPlan
        Its sine rises over `ramp` cycles and does not fall; its `cycles` do not count.
    columns : sequence of int
        By their Ω in the plan.
    settling : int
        Cycles at full amplitude before the response is looked at. A deviation dies out as e² a cycle where there are
        two impacts in it: at e = 0.976 to 4e-9 within 400 cycles.

    Returns
    -------
    response : SteadyResponse
    """
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    block, sides = plan.block, sides_of(plan.block, plan.restitution)
    linearised = plane_model_of(plan.model).is_linearised
    omegas, levels = plan.frequency_ratio[list(columns)], tan(block.critical_angle) * plan.amplitude_ratio
    first = round(plan.ramp) + settling
    count = first + LARGEST_ORDER * (REPEATS + 1)
    order = np.zeros((omegas.size, levels.size), dtype=np.int8)
    amplitude = np.full(order.shape, np.nan)
    for row, omega in enumerate(omegas * block.p):
        cycle = 2 * pi / omega
        times = cycle * np.arange(count)
        forcing = Harmonic(omega, plan.phase, (plan.ramp * cycle, count * cycle, count * cycle)).forcing(*times)
        at = np.searchsorted(forcing.times, times)
        since = int(at[first + LARGEST_ORDER])
        for column, level in enumerate(levels.tolist()):
            scaled = forcing._replace(levels=level * forcing.levels)
            angles, velocities, _, _, end = propagate(scaled, sides, is_linearised=linearised, since=since, floor=inf)
            if np.isfinite(end.time):
                order[row, column] = OVERTURNED
                continue
            amplitude[row, column] = end.peak
            states = np.column_stack([angles[at], velocities[at] / block.p])[first:] / block.critical_angle
            order[row, column] = AT_REST if end.peak == 0.0 else _order(states)
    return SteadyResponse(omegas, plan.amplitude_ratio, order, amplitude)


def _order(states: Array) -> int:
    """Return the smallest number of cycles after which the states, one a cycle, repeat; `IRREGULAR` if none."""
    for order in range(1, LARGEST_ORDER + 1):
        last = states[-(REPEATS + 1) * order :]
        if np.abs(last[order:] - last[:-order]).max() < SAME:
            return order
    return IRREGULAR
