"""The displacement of a table of which only the acceleration was recorded, to draw it."""

from __future__ import annotations

import numpy as np
import scipy

from colonnade.arrays import Array

SLOWEST = 0.2
"""Hz: what is slower in a displacement that is integrated from an acceleration is its drift, not the table."""


def displacement(time: Array, acceleration: Array) -> Array:
    """
    Integrate an acceleration twice, without what is slower than `SLOWEST`: an offset would carry the base away.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s, even.
    acceleration : ndarray, shape (n,)
        m/s²; NaN counts as 0.

    Returns
    -------
    displacement : ndarray, shape (n,)
        m.
    """
    values = np.nan_to_num(acceleration)
    rate = (time.size - 1) / float(time[-1] - time[0]) if time.size > 1 else 0.0
    if rate <= 4 * SLOWEST or time.size < 20:
        return np.zeros_like(values)
    highpass = scipy.signal.butter(2, SLOWEST, "highpass", fs=rate, output="sos")
    for _ in range(2):
        values = scipy.integrate.cumulative_trapezoid(scipy.signal.sosfiltfilt(highpass, values), time, initial=0.0)
    return np.asarray(scipy.signal.sosfiltfilt(highpass, values))
