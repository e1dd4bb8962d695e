"""Steady response to a harmonic base motion: the number of cycles after which it repeats, and its amplitude."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.models import DEFAULT, plane_model_of
from colonnade.dynamics.plane.run import Harmonic
from colonnade.dynamics.restitution_law import Given, law_of
from colonnade.dynamics.search import checked_ratios

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
    period : ndarray, shape (n, m)
        s; NaN if nothing repeats.
    amplitude : ndarray, shape (n, m)
        Largest |θ|/α over the last `LARGEST_ORDER` · `REPEATS` cycles; NaN where the block overturned.
    """

    frequency_ratio: Array
    amplitude_ratio: Array
    order: NDArray[np.int8]
    period: Array
    amplitude: Array


def steady_response(
    block: Block,
    *,
    frequency_ratio: ArrayLike,
    amplitude_ratio: ArrayLike,
    restitution: Given = None,
    settling: int = 400,
    phase: float = 0.0,
    ramp: float = 0.0,
    model: str = DEFAULT,
) -> SteadyResponse:
    """
    Find the steady response, from rest, over Ω and A.

    Parameters
    ----------
    block : Block
    frequency_ratio, amplitude_ratio : array_like, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α).
    restitution : float, pair of float or RestitutionLaw, optional
        e, see `rock`; default the rigid-body value.
    settling : int, optional
        Cycles at full amplitude before the response is looked at. A deviation dies out as e² a cycle where there are
        two impacts in it: at e = 0.976 to 4e-9 within 400 cycles.
    phase : float, optional
        rad.
    ramp : float, optional
        Cycles over which the amplitude rises at first.
    model : str, optional
        A plane one.

    Returns
    -------
    response : SteadyResponse

    Raises
    ------
    ValueError
        If an argument is out of its range or the model is not known.
    """
    omegas = checked_ratios("frequency_ratio", frequency_ratio)
    amplitudes = checked_ratios("amplitude_ratio", amplitude_ratio)
    if settling < 1:
        raise ValueError(f"settling is {settling}; at least one cycle was expected")
    linearised = plane_model_of(model).is_linearised
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    sides = sides_of(block, law_of(block, restitution))
    first = round(ramp) + settling
    count, cycles = first + LARGEST_ORDER * (REPEATS + 1), 2 * pi / (omegas * block.p)
    order = np.zeros((omegas.size, amplitudes.size), dtype=np.int8)
    amplitude = np.full(order.shape, np.nan)
    for row, cycle in enumerate(cycles.tolist()):
        times = cycle * np.arange(count)
        forcing = Harmonic(2 * pi / cycle, phase, (ramp * cycle, count * cycle, count * cycle)).forcing(*times)
        at, since = (
            np.searchsorted(forcing.times, times),
            int(np.searchsorted(forcing.times, times[first + LARGEST_ORDER])),
        )
        for column, level in enumerate((tan(block.critical_angle) * amplitudes).tolist()):
            angles, velocities, _, _, end = propagate(
                forcing._replace(levels=level * forcing.levels),
                sides,
                is_linearised=linearised,
                since=since,
                floor=inf,
            )
            if np.isfinite(end.time):
                order[row, column] = OVERTURNED
                continue
            amplitude[row, column] = end.peak
            states = np.column_stack([angles[at], velocities[at] / block.p])[first:] / block.critical_angle
            order[row, column] = AT_REST if end.peak == 0.0 else _order(states)
    period = np.where(order > 0, order * cycles[:, None], np.nan)
    return SteadyResponse(omegas, amplitudes, order, period, amplitude)


def _order(states: Array) -> int:
    """Return the smallest number of cycles after which the states, one a cycle, repeat; `IRREGULAR` if none."""
    for order in range(1, LARGEST_ORDER + 1):
        last = states[-(REPEATS + 1) * order :]
        if np.abs(last[order:] - last[:-order]).max() < SAME:
            return order
    return IRREGULAR
