"""Stretches of consecutive samples, and linear interpolation over missing ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask


def stretches(chosen: Mask) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """
    Find the stretches of chosen samples.

    Parameters
    ----------
    chosen : ndarray of bool, shape (n,)

    Returns
    -------
    starts, stops : ndarray of int, shape (m,)
        Of each, as in a slice.

    Examples
    --------
    >>> starts, stops = stretches(np.array([True, True, False, True]))
    >>> starts.tolist(), stops.tolist()
    ([0, 3], [2, 4])
    """
    padded = np.zeros(chosen.size + 2, dtype=bool)
    padded[1:-1] = chosen
    return np.flatnonzero(padded[1:] > padded[:-1]), np.flatnonzero(padded[1:] < padded[:-1])


def filled_in(values: Array) -> Array:
    """Return values with straight lines where they are missing, and the nearest one at the ends."""
    finite = np.isfinite(values)
    return values if finite.all() else np.interp(np.arange(values.size), np.flatnonzero(finite), values[finite])
