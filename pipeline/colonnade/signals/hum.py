"""Hum of the mains: an oscillation of 50 or 60 Hz that is there all the time, at rest too."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array

MAINS = (50.0, 60.0)
"""Hz."""

PART = 0.4
"""s: the parts of a record that are looked at: whole periods of both."""

ASIDE = 5.0
"""Hz, aside of which nothing of a hum is seen in a part."""

LOUD = 5.0
"""Times what is as steady on either side of it, from which on it is a hum."""


def find_hum(values: Array, interval: float) -> tuple[float, float] | None:
    """
    Find the hum of a record.

    Parameters
    ----------
    values : ndarray, shape (n,)
        At equal steps; finite.
    interval : float
        s.

    Returns
    -------
    frequency, amplitude : float, or None
        Hz, and in the unit of the values; None if there is none.

    Notes
    -----
    In each part of the record its amplitude is found; the least of them is that of the hum, as a motion pauses.
    """
    size = round(PART / interval)
    parts = values[: values.size // size * size].reshape(-1, size) if size > 3 else np.empty((0, size))
    for frequency in MAINS:
        if not len(parts) or frequency + ASIDE > 0.5 / interval:
            continue
        below, hum, above = (_least(parts, interval, frequency + each) for each in (-ASIDE, 0.0, ASIDE))
        if hum > LOUD * max(below, above):
            return frequency, hum
    return None


def _least(parts: Array, interval: float, frequency: float) -> float:
    """Least amplitude of a frequency in the parts, which a window that falls to zero keeps apart from others."""
    window = np.hanning(parts.shape[1])
    turning = np.exp(-2j * np.pi * frequency * interval * np.arange(parts.shape[1]))
    level = parts - (parts @ window / window.sum())[:, None]
    return float(np.abs(level @ (window * turning)).min() * 2 / window.sum())
