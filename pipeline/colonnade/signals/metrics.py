"""Measures of records: how well two agree, and the amplitude spectral density of one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.signals.samples import filled_in

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


def nrmse(measured: ArrayLike, predicted: ArrayLike, scale: float) -> float:
    """
    Root mean square of predicted minus measured over a scale.

    Parameters
    ----------
    measured, predicted : array_like, shape (n,)
        In one unit; a sample that is NaN in either does not count.
    scale : float
        In that unit, as the critical angle.

    Returns
    -------
    nrmse : float
        Dimensionless; NaN where no sample is in both.

    Examples
    --------
    >>> nrmse([0.0, 0.1], [0.0, 0.2], 0.1)
    0.7071067811865476
    """
    difference = np.asarray(predicted, dtype=np.float64) - np.asarray(measured, dtype=np.float64)
    difference = difference[np.isfinite(difference)]
    if difference.size == 0:
        return float("nan")
    return float(np.sqrt(np.mean(difference**2)) / scale)


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
    bridged = filled_in(np.where(good, values, np.nan))
    segment = int(np.clip(2 * values.size // (FEWEST_SEGMENTS + 1), SMALLEST_SEGMENT, LARGEST_SEGMENT))
    frequency, power = (each[1:] for each in scipy.signal.welch(bridged, 1 / interval, nperseg=segment))
    edges = np.geomspace(frequency[0], frequency[-1] * (1 + 1e-9), CLASSES + 1)
    starts = np.unique(np.searchsorted(frequency, edges[:-1]))
    starts = starts[starts < frequency.size]
    counts = np.diff(np.append(starts, frequency.size))
    return Density(
        np.exp(np.add.reduceat(np.log(frequency), starts) / counts),
        np.sqrt(np.add.reduceat(power, starts) / counts),
    )
