"""Amplitude spectral density of a channel: what its filter took away."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array, Mask

FEWEST_SEGMENTS = 8
"""Half-overlapping segments that are averaged."""

SMALLEST_SEGMENT, LARGEST_SEGMENT = 64, 4096
"""Samples."""

CLASSES = 140
"""Frequencies, evenly spaced on a logarithmic axis, to which a spectrum is thinned."""


class Density(NamedTuple):
    """Frequencies (Hz) and amplitude spectral density (unit of the values per √Hz), both shape (n,)."""

    frequency: Array
    amplitude: Array


def density(values: Array, interval: float, usable: Mask) -> Density | None:
    """
    Return the amplitude spectral density of a channel by Welch's method.

    Parameters
    ----------
    values : ndarray, shape (n,)
    interval : float
        s.
    usable : ndarray of bool, shape (n,)
        Samples that count; straight lines bridge the others.

    Returns
    -------
    density : Density or None
        Root of the power spectral density (Hann window, half-overlapping segments, means taken off), averaged within
        classes of equal width on a logarithmic axis; None of fewer than `SMALLEST_SEGMENT` usable samples.
    """
    good = usable & np.isfinite(values)
    if good.sum() < SMALLEST_SEGMENT or not interval > 0:
        return None
    index = np.arange(values.size)
    bridged = np.interp(index, index[good], values[good]) if not good.all() else values
    wanted = 2 * values.size // (FEWEST_SEGMENTS + 1)
    segment = int(np.clip(1 << (max(wanted, 1).bit_length() - 1), SMALLEST_SEGMENT, LARGEST_SEGMENT))
    frequency, power = scipy.signal.welch(bridged, 1 / interval, nperseg=min(segment, values.size))
    return _thinned(frequency[1:], power[1:])


def _thinned(frequency: Array, power: Array) -> Density:
    edges = np.geomspace(frequency[0], frequency[-1] * (1 + 1e-9), CLASSES + 1)
    starts = np.unique(np.searchsorted(frequency, edges[:-1]))
    starts = starts[starts < frequency.size]
    counts = np.diff(np.append(starts, frequency.size))
    return Density(
        np.exp(np.add.reduceat(np.log(frequency), starts) / counts),
        np.sqrt(np.add.reduceat(power, starts) / counts),
    )
