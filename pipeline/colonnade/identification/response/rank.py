"""Whether a measured history could be one more run of a model: its distance from the runs, ranked among their own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

WITHIN = 0.95
"""Largest rank of a measured history that is within a model's own spread."""

BAND = (0.025, 0.5, 0.975)
"""Quantiles that distances are scaled by: the middle, and the edges of the 95 % band on either side of it."""

FEWEST = 20
"""Runs below which no rank is given: with fewer no history can be among the outermost 5 %."""

_LEAST = 1e-9
"""rad; half a band is at least as wide."""


def is_within(rank: float) -> bool | None:
    """Whether a measured history of this rank is within the model's own spread; None if it was not ranked."""
    return None if np.isnan(rank) else bool(rank <= WITHIN)


@dataclass(frozen=True)
class Distances:
    """
    Largest scaled distances from the median; 1 is the edge of the 95 % band of all others.

    Attributes
    ----------
    measured : float
    members : ndarray, shape (m,)
    """

    measured: float
    members: Array


def rank(measured: float, members: Array) -> float:
    """Return the share of the members' values, shape (m,), that are below the measured one, equal ones by half."""
    return float(np.mean(members < measured) + 0.5 * np.mean(members == measured))


def distances(measured: ArrayLike, members: ArrayLike) -> Distances | None:
    """
    Measure how far a measured history and each run of a model are from the middle of all others.

    Parameters
    ----------
    measured : array_like, shape (n,)
        rad, up to the horizon; samples that are not finite are left out for all.
    members : array_like, shape (m, n)
        rad, each with measurement errors of its own, as if it had been recorded.

    Returns
    -------
    distances : Distances or None
        None for fewer than `FEWEST` runs, or without a finite sample.

    Raises
    ------
    ValueError
        If the shapes do not belong together or a run is not finite.

    Notes
    -----
    Each of the m + 1 histories is measured as if it were the measured one: median and band are those of the m others.
    If all m + 1 are drawn alike, each rank is equally likely, so the verdict is wrong in 5 % of the cases, whatever the
    model and the motion (conformal prediction: Vovk, Gammerman & Shafer 2005, ch. 2).
    """
    seen, runs = np.asarray(measured, dtype=np.float64), np.asarray(members, dtype=np.float64)
    if runs.ndim != 2 or seen.shape != runs.shape[1:]:
        raise ValueError(f"measured has shape {seen.shape} and members {runs.shape}; (n,) and (m, n) were expected")
    if not np.isfinite(runs).all():
        raise ValueError("a member is not finite; finite angles were expected")
    known = np.isfinite(seen)
    if runs.shape[0] < FEWEST or not known.any():
        return None
    everyone = np.vstack((seen[known], runs[:, known])).T.copy()
    largest = _largest(everyone, np.sort(everyone, axis=1), np.array(BAND), _LEAST)
    return Distances(float(largest[0]), largest[1:])


@kernel
def _largest(everyone: Array, ranked: Array, levels: Array, least: float) -> Array:
    """
    Largest scaled distance of each of m + 1 histories from the median of the m others, shape (m + 1,).

    `everyone`, shape (n, m + 1), has all at each time; `ranked` the same in order; `levels` are the quantiles.
    """
    times, count = everyone.shape
    largest = np.zeros(count)
    share, below = np.empty(levels.size), np.empty(levels.size, dtype=np.int64)
    for k in range(levels.size):
        below[k] = int(levels[k] * (count - 2))
        share[k] = levels[k] * (count - 2) - below[k]
    quantiles = np.empty(levels.size)
    for time in range(times):
        for history in range(count):
            value = everyone[time, history]
            # Without this history, every rank from its own on is that of the next one.
            for k in range(levels.size):
                first, second, third = ranked[time, below[k]], ranked[time, below[k] + 1], ranked[time, below[k] + 2]
                lower, upper = first if value > first else second, second if value > second else third
                quantiles[k] = (1 - share[k]) * lower + share[k] * upper
            low, middle, high = quantiles
            half = high - middle if value > middle else middle - low
            largest[history] = max(largest[history], abs(value - middle) / max(half, least))
    return largest
