"""Order of the response to a sine: after how many periods of the table the rocking angle repeats."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array

Order = int | Literal["irregular"]

TOLERANCE = 0.5
"""Largest misfit with which a response repeats: then the angle and itself n periods later correlate by 0.75."""

LARGEST_ORDER = 8
"""Longest repeat looked for, in periods of the table."""

REPEATS = 3
"""An order n is judged on this many of its repeats, the last ones of the steady forcing, ..."""

FEWEST_CYCLES = 6
"""... and on no fewer periods of the table than this."""

POINTS = 64
"""Points a period at which the angle is compared with itself."""


@dataclass(frozen=True)
class Response:
    """
    The order of a response, or the reason why it is missing.

    Attributes
    ----------
    order : int, "irregular" or None
        1: harmonic, the angle repeats every period of the table; n: sub-harmonic 1/n, it repeats every n periods;
        "irregular": it repeats after none of those that the record is long enough for. None if this cannot be decided.
    reason : str
        What it was judged by, or why it cannot be decided.
    misfit : ndarray, shape (k,)
        Of the orders 1 … k: 0 where the angle repeats exactly, about 1 where it and its repeat are unrelated.
    impacts_per_cycle : float
        Passages through θ = 0 a period of the table, over the last cycles; NaN without an order.
    """

    order: Order | None
    reason: str
    misfit: Array = field(default_factory=lambda: np.empty(0))
    impacts_per_cycle: float = float("nan")


def response_order(
    time: ArrayLike,
    angle: ArrayLike,
    frequency: float,
    *,
    start: float,
    stop: float,
    threshold: float,
    noise: float = 0.0,
) -> Response:
    """
    Find after how many periods of a harmonic base motion the rocking angle repeats.

    Parameters
    ----------
    time, angle : array_like, shape (n,)
        s, increasing; rad. Samples that are not finite are passed over.
    frequency : float
        Of the base motion, Hz.
    start, stop : float
        s, between which the base motion is steady.
    threshold : float
        rad; an angle that stays at or below it is not rocking.
    noise : float, optional
        Standard deviation of the angle's noise, rad: taken off the misfit.

    Returns
    -------
    response : Response

    Notes
    -----
    The misfit of order n is RMS[θ(t + nT) − θ(t)] / (√2 σ), T the period of the table and σ the standard deviation of
    θ, over the last `REPEATS` n periods (at least `FEWEST_CYCLES`) of the steady forcing, where transients are the
    smallest. The order is the smallest n whose misfit is within `TOLERANCE`.

    With little dissipation free rocking dies out slowly (by e² an impact): over ten or twenty cycles the order is that
    of what was recorded, not of the steady state that a longer test would come to.

    Examples
    --------
    >>> time = np.arange(0, 10, 0.005)
    >>> response_order(time, 0.05 * np.sin(2 * np.pi * time), 3.0, start=0, stop=10, threshold=1e-4).order
    3
    """
    times, angles = np.asarray(time, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    finite = np.isfinite(angles)
    times, angles = times[finite], angles[finite]
    if times.size < 2:
        return Response(None, "No angle was measured.")
    start, stop = max(start, float(times[0])), min(stop, float(times[-1]))
    cycles = max(int((stop - start) * frequency + 1e-6), 0)
    if cycles < FEWEST_CYCLES:
        reason = f"The base motion is steady over {cycles} periods; at least {FEWEST_CYCLES} are needed."
        return Response(None, reason)
    points = np.interp(stop - np.arange(cycles * POINTS, -1, -1) / (frequency * POINTS), times, angles)
    last = points[-FEWEST_CYCLES * POINTS :]
    if np.abs(last).max() <= threshold:
        return Response(None, "The specimen does not rock while the base motion is steady.")
    misfit = np.array([_misfit(points, order, noise) for order in range(1, min(cycles // REPEATS, LARGEST_ORDER) + 1)])
    impacts = _impacts_per_cycle(last, threshold)
    repeating = np.flatnonzero(misfit <= TOLERANCE)
    if repeating.size:
        order = int(repeating[0]) + 1
        after = "every period" if order == 1 else f"every {order} periods"
        reason = f"The angle repeats {after} of the table; misfit {misfit[order - 1]:.2g}, {TOLERANCE:g} is allowed."
        return Response(order, reason, misfit, impacts)
    reason = (
        f"The angle repeats after none of 1 to {misfit.size} periods of the table; nearest after "
        f"{np.argmin(misfit) + 1}, misfit {misfit.min():.2g}, {TOLERANCE:g} is allowed. It is irregular, or a "
        "transient that has not died out."
    )
    return Response("irregular", reason, misfit, impacts)


def _misfit(points: Array, order: int, noise: float) -> float:
    """Misfit of an order over the last repeats; noise adds σ² to the variance and twice that to the differences'."""
    window = points[-max(REPEATS * order, FEWEST_CYCLES) * POINTS - 1 :]
    lag = order * POINTS
    difference = float(np.mean((window[lag:] - window[:-lag]) ** 2)) / 2 - noise**2
    variance = float(np.var(window)) - noise**2
    return float(np.sqrt(max(difference, 0.0) / variance)) if variance > 0 else 1.0


def _impacts_per_cycle(points: Array, threshold: float) -> float:
    """Rate of the changes of side between excursions above the threshold, from the first of them to the last."""
    risen = np.flatnonzero(np.abs(points) > threshold)
    sides = np.sign(points[risen])
    changes = risen[1:][sides[1:] != sides[:-1]]
    if changes.size < 2:
        return float(changes.size) * POINTS / points.size
    return float((changes.size - 1) * POINTS / (changes[-1] - changes[0]))
