"""Steady response to a harmonic base motion: the number of cycles after which it repeats, and its amplitude."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.models import DEFAULT
from colonnade.dynamics.plane.run import Harmonic, harmonic_run, restitution_up_to
from colonnade.dynamics.restitution_law import Given
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
    restitution : float, pair of float, RestitutionLaw or function, optional
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
    e = restitution_up_to(block, restitution, float(amplitudes.max()))
    first = round(ramp) + settling
    count, cycles = first + LARGEST_ORDER * (REPEATS + 1), 2 * pi / (omegas * block.p)
    order = np.zeros((omegas.size, amplitudes.size), dtype=np.int8)
    amplitude = np.full(order.shape, np.nan)
    for row, omega in enumerate(omegas * block.p):
        cycle = 2 * pi / omega
        motion = Harmonic(omega, phase, (ramp * cycle, count * cycle, count * cycle))
        watched = {"samples": count, "interval": cycle, "peaks_from": (first + LARGEST_ORDER) * cycle}
        for column, level in enumerate(amplitudes.tolist()):
            run = harmonic_run(block, motion, level, e, model=model, **watched)
            if run.outcome == "overturned":
                order[row, column] = OVERTURNED
                continue
            amplitude[row, column] = run.peak_ratio
            states = np.column_stack([run.angle, run.angular_velocity / block.p])[first:] / block.critical_angle
            order[row, column] = AT_REST if run.peak_ratio == 0.0 else _order(states)
    period = np.where(order > 0, order * cycles[:, None], np.nan)
    return SteadyResponse(omegas, amplitudes, order, period, amplitude)


def _order(states: Array) -> int:
    """Return the smallest number of cycles after which the states, one a cycle, repeat; `IRREGULAR` if none."""
    for order in range(1, LARGEST_ORDER + 1):
        last = states[-(REPEATS + 1) * order :]
        if np.abs(last[order:] - last[:-order]).max() < SAME:
            return order
    return IRREGULAR
