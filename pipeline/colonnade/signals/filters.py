"""Zero-phase filters, their cut-off, the noise that they leave, and derivatives."""

from __future__ import annotations

from math import acosh

import numpy as np
import scipy

from colonnade.arrays import Array, Mask

SMALL_AMPLITUDE = 0.02
"""|θ|/α whose rocking frequency, the highest of interest, sets the default cut-off."""

HARMONICS = 5.0
"""Default cut-off over that frequency: the arcs' third harmonic passes, see the notes of `default_lowpass`."""


def default_lowpass(p: float, rate: float) -> float:
    """
    Cut-off for channels on the specimen, Hz.

    Parameters
    ----------
    p : float
        rad/s.
    rate : float
        Sampling rate, Hz.

    Notes
    -----
    A block rocks at p / (4 acosh(1/(1 − |θ|/α))) Hz (Housner 1963). Its history is close to a row of alternating
    parabolas, whose harmonics fall with the cube of their number; five times the frequency at 0.02 α lets the third
    pass whole. The cusp of an impact lies at θ = 0, far from the peaks on this filter's scale. What it does to peaks
    and to e is measured in docs/explanation/filter.md: less than 1e-4 α, and 1e-4 of e.
    """
    return min(HARMONICS * p / (4 * acosh(1 / (1 - SMALL_AMPLITUDE))), 0.4 * rate)


def lowpass(values: Array, interval: float, cutoff_hz: float, order: int = 4) -> Array:
    """
    Low-pass a record without shifting it in time.

    Parameters
    ----------
    values : ndarray, shape (..., n)
        At equal steps along the last axis, all finite.
    interval : float
        s.
    cutoff_hz : float
        Frequency at which a Butterworth filter, run forwards and backwards, leaves half of the amplitude.
    order : int, optional
        Of each run.

    Returns
    -------
    smooth : ndarray, shape (..., n)

    Raises
    ------
    ValueError
        If the cut-off is not between zero and half the sampling rate.
    """
    nyquist = 0.5 / interval
    if not 0 < cutoff_hz < nyquist:
        raise ValueError(
            f"the cut-off is {cutoff_hz:g} Hz; it was expected between 0 and {nyquist:g} Hz, half the sampling rate"
        )
    sections = scipy.signal.butter(order, cutoff_hz, fs=1 / interval, output="sos")
    # The odd extension has to outlast the filter's own memory; a short record has no more than itself to give.
    padding = min(int(3 * order / (cutoff_hz * interval)), values.shape[-1] - 1)
    return np.asarray(scipy.signal.sosfiltfilt(sections, values, padlen=padding), dtype=np.float64)


def second_derivative(values: Array, interval: float, cutoff_hz: float) -> Array:
    """
    Second derivative of a record below a frequency, as an acceleration from a displacement.

    Parameters
    ----------
    values : ndarray, shape (n,)
    interval : float
        s.
    cutoff_hz : float
        Noise grows with the square of the frequency, so nothing above this one is kept.

    Returns
    -------
    derivative : ndarray, shape (n,)
        Per s²; central differences.
    """
    smooth = lowpass(values, interval, cutoff_hz)
    derivative = np.zeros_like(smooth)
    derivative[1:-1] = (smooth[2:] - 2 * smooth[1:-1] + smooth[:-2]) / interval**2
    return derivative


def noise_below(values: Array, smooth: Array, interval: float, cutoff_hz: float, counted: Mask) -> float:
    """
    Standard deviation of what noise a low-pass leaves, taken the noise is white.

    Parameters
    ----------
    values, smooth : ndarray, shape (n,)
        Before and after the filter.
    interval, cutoff_hz
        As for `lowpass`.
    counted : ndarray of bool, shape (n,)
        Samples that were recorded: bridges have no noise.
    """
    above = (values - smooth)[counted]
    kept = min(2 * cutoff_hz * interval, 0.9)
    above -= np.median(above)
    deviation = 1.4826 * float(np.median(np.abs(above, out=above), overwrite_input=True))
    return deviation * float(np.sqrt(kept / (1 - kept)))
