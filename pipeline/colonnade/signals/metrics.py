"""Measures of records: how well two agree, the amplitude spectral density of one, the hum of the mains in it."""

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

MAINS = (50.0, 60.0)
"""Hz."""

PART = 0.4
"""s: the parts of a record that are looked at: whole periods of both."""

ASIDE = 5.0
"""Hz, aside of which nothing of a hum is seen in a part."""

LOUD = 5.0
"""Times what is as steady on either side of it, from which on it is a hum."""


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
        Hz, and in the unit of the values; None if not found.

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
