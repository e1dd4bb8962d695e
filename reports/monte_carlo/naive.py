"""The naive way to e: the highest sample of each arc, and an unweighted line through Housner's log energies."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array

VISIBLE = 0.05
"""|θ| over the highest, from which an arc is read off a plot."""


def naive_restitution(angle: Array, critical_angle: float) -> float:
    """
    Read e off a record as by ruler from a plot; NaN where fewer than two arcs are seen or one is above α.

    Parameters
    ----------
    angle : ndarray, shape (n,)
        rad, about whatever the transducer calls zero.
    critical_angle : float
        rad.

    Notes
    -----
    The release counts as the first peak. ln[1 − (1 − φₙ)²] = const + 2 n ln e (Housner 1963, eq. 11).
    """
    high = np.flatnonzero(np.abs(angle) > VISIBLE * np.abs(angle).max())
    starts = np.concatenate(([0], np.flatnonzero(np.diff(np.sign(angle[high])) != 0) + 1))
    peaks = np.maximum.reduceat(np.abs(angle[high]), starts) / critical_angle
    if peaks.size < 2 or peaks.max() >= 1:
        return float("nan")
    slope = np.polyfit(np.arange(peaks.size), np.log(1 - (1 - peaks) ** 2), 1)[0]
    return float(np.exp(slope / 2))
