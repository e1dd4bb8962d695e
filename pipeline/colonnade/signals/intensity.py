"""How strong the motion of a table is, which begins and ends at rest: its velocity, displacement, Arias intensity."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array

LARGEST_DRIFT = 0.25
"""Of the peak: what a line may take off an integral that has to begin and to end at rest, before it is refused."""

RESTING = 0.02
"""Share of the record, at each end, over which it is taken to rest."""


class Integrated(NamedTuple):
    """Largest magnitude of an integral, NaN if it drifts, and its drift over that magnitude."""

    peak: float
    drift: float


def arias_intensity(acceleration: Array, interval: float, gravity: float) -> float:
    """
    Return the Arias intensity π/(2g) ∫ a² dt of an acceleration, m/s.

    Parameters
    ----------
    acceleration : ndarray, shape (n,)
        m/s²; NaN counts as zero.
    interval : float
        s.
    gravity : float
        m/s².
    """
    squares = np.nan_to_num(np.asarray(acceleration, dtype=np.float64)) ** 2
    return float(np.pi / (2 * gravity) * scipy.integrate.trapezoid(squares, dx=interval))


def table_velocity(acceleration: Array, interval: float) -> Integrated:
    """
    Return the largest velocity of a table, which begins and ends at rest.

    Parameters
    ----------
    acceleration : ndarray, shape (n,)
        m/s².
    interval : float
        s.

    Returns
    -------
    velocity : Integrated
        m/s; NaN if the line that is subtracted so that the motion ends at rest reaches `LARGEST_DRIFT` of it.

    Notes
    -----
    The acceleration is integrated by trapezoids. A line through the mean velocities of the first and the last
    `RESTING` of the record is subtracted: a constant error of the acceleration gives no more than a line. The PGV of a
    ground motion (`assessment.intensity`) is another measure: nobody knows that the ground stops with its record.
    """
    return _checked(_integral(acceleration, interval))


def table_displacement(acceleration: Array, interval: float) -> Integrated:
    """
    Return the largest displacement of a table, which begins and ends at rest, by integrating twice.

    The velocity is that of `table_velocity`; its integral is refused by the same rule. Returned in m.
    """
    velocity = _integral(acceleration, interval)
    if np.isnan(_checked(velocity).peak):
        return Integrated(np.nan, _checked(velocity).drift)
    return _checked(_integral(velocity[0], interval))


def _integral(values: Array, interval: float) -> tuple[Array, float]:
    """Return an integral less the line through its ends, and the largest value of that line's change."""
    whole = scipy.integrate.cumulative_trapezoid(np.nan_to_num(values), dx=interval, initial=0.0)
    size = max(int(RESTING * whole.size), 1)
    first, last = float(whole[:size].mean()), float(whole[-size:].mean())
    line = first + (last - first) * (np.arange(whole.size) - (size - 1) / 2) / max(whole.size - size, 1)
    return whole - line, abs(last - first)


def _checked(integral: tuple[Array, float]) -> Integrated:
    values, drift = integral
    peak = float(np.abs(values).max(initial=0.0))
    share = drift / peak if peak > 0 else 0.0
    return Integrated(peak if share <= LARGEST_DRIFT else np.nan, share)
