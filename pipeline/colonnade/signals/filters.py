"""Low-pass without a shift in time, and the second derivative that needs one."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import butter, sosfiltfilt

Array = NDArray[np.float64]

PADDING_PERIODS = 3.0
"""The record is continued at both ends, by point reflection, for this many periods of the cut-off."""


def lowpass(values: ArrayLike, interval: float, cutoff_hz: float, order: int = 4) -> Array:
    """
    Low-pass filter without phase: Butterworth, run forwards and backwards.

    Parameters
    ----------
    values : array_like, shape (n,)
        At equal steps, without NaN.
    interval : float
        Step, s.
    cutoff_hz : float
        An oscillation of this frequency comes out at half its amplitude.
    order : int
        Of the Butterworth filter that is run twice.

    Returns
    -------
    filtered : ndarray, shape (n,)
        In the unit of the values. A record of fewer than three samples is returned as it is.

    Raises
    ------
    ValueError
        If a sample is NaN, or the cut-off is not between 0 and half the sampling rate.

    Examples
    --------
    >>> bool(abs(lowpass([1.0] * 50, 0.01, 10.0) - 1.0).max() < 1e-9)
    True
    """
    samples = _samples(values)
    nyquist = 0.5 / interval
    if not 0 < cutoff_hz < nyquist:
        raise ValueError(
            f"the cut-off is {cutoff_hz:.4g} Hz; with {1 / interval:.4g} samples a second "
            f"one between 0 and {nyquist:.4g} Hz was expected"
        )
    if samples.size < 3:
        return samples.copy()
    padding = min(samples.size - 1, int(np.ceil(PADDING_PERIODS / (cutoff_hz * interval))))
    sections = butter(order, cutoff_hz / nyquist, output="sos")
    return np.asarray(sosfiltfilt(sections, samples, padtype="odd", padlen=padding), dtype=np.float64)


def second_derivative(values: ArrayLike, interval: float, cutoff_hz: float, order: int = 4) -> Array:
    """
    Differentiate twice after a low-pass, as for the acceleration of a table whose displacement was recorded.

    Parameters
    ----------
    values : array_like, shape (n,)
        At equal steps, without NaN.
    interval : float
        Step, s.
    cutoff_hz : float
        As for `lowpass`. At half the sampling rate or above, nothing is filtered.
    order : int
        As for `lowpass`.

    Returns
    -------
    derivative : ndarray, shape (n,)
        In the unit of the values per s². The two end samples repeat their neighbours; a record of fewer than three
        samples gives zeros.

    Notes
    -----
    Noise of standard deviation s and bandwidth up to f comes out at about s (2πf)² / √5. The central difference
    gives an oscillation of frequency f too small, by the factor (sin(πfΔt) / πfΔt)².

    Examples
    --------
    >>> second_derivative([0.0, 1.0, 4.0, 9.0], 1.0, 5.0).tolist()
    [2.0, 2.0, 2.0, 2.0]
    """
    samples = _samples(values)
    if samples.size < 3:
        return np.zeros_like(samples)
    smooth = lowpass(samples, interval, cutoff_hz, order) if cutoff_hz < 0.5 / interval else samples
    inner = np.diff(smooth, 2) / interval**2
    return np.concatenate((inner[:1], inner, inner[-1:]))


def bridge(values: ArrayLike, bad: ArrayLike) -> Array:
    """
    Replace bad samples by the straight line between their neighbours.

    Parameters
    ----------
    values : array_like, shape (n,)
    bad : array_like of bool, shape (n,)
        NaN counts as bad as well.

    Returns
    -------
    bridged : ndarray, shape (n,)
        Bad samples at an end take the nearest good value. All NaN where no sample is good.

    Examples
    --------
    >>> bridge([1.0, 9.0, 3.0, 9.0], [False, True, False, True]).tolist()
    [1.0, 2.0, 3.0, 3.0]
    """
    samples = np.asarray(values, dtype=np.float64)
    good = np.isfinite(samples) & ~np.asarray(bad, dtype=bool)
    if not good.any():
        return np.full_like(samples, np.nan)
    index = np.arange(samples.size)
    return np.where(good, samples, np.interp(index, index[good], samples[good]))


def _samples(values: ArrayLike) -> Array:
    samples = np.asarray(values, dtype=np.float64)
    finite = np.isfinite(samples)
    if not finite.all():
        raise ValueError(f"sample {int(np.argmin(finite))} is not a number; bridge the gaps first")
    return samples
