"""How late one recorder is against another, from two records of the same motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import signal

Array = NDArray[np.float64]

WEAKEST_CORRELATION = 0.7
"""Two records that agree less than this are not of the same motion, or there was none."""


@dataclass(frozen=True)
class Offset:
    """
    Delay between two records.

    Attributes
    ----------
    seconds : float
        What has to be taken off the second record's times.
    standard_error : float
        s.
    correlation : float
        Of the two records once aligned, 0 to 1.
    """

    seconds: float
    standard_error: float
    correlation: float

    @property
    def is_determined(self) -> bool:
        """Whether the records agree well enough for the delay to mean something."""
        return self.correlation >= WEAKEST_CORRELATION


def find_offset(reference: Array, values: Array, interval: float, *, longest: float, bandwidth_hz: float) -> Offset:
    """
    Find how late a record is against a reference.

    Parameters
    ----------
    reference, values : ndarray, shape (n,)
        The same quantity on one clock, band-limited alike; in any unit.
    interval : float
        s.
    longest : float
        Largest delay of either sign that is looked for, s.
    bandwidth_hz : float
        Of both records: it tells how many of their samples are independent.

    Returns
    -------
    offset : Offset
        Where the correlation over the whole record is largest, to a fraction of the interval.

    Notes
    -----
    The correlation is over the whole of both records, not over their overlap, so that the beginning and end of a motion
    tell one period of a sine from the next. The standard error is that of a shift fitted by least squares.
    """
    first, second = reference - reference.mean(), values - values.mean()
    power = float(np.sqrt((first @ first) * (second @ second)))
    reach = min(int(np.ceil(longest / interval)), first.size - 2)
    if not power > 0 or reach < 1:
        return Offset(0.0, float("inf"), 0.0)
    correlation = signal.correlate(second, first, mode="full", method="fft") / power
    middle = first.size - 1
    window = correlation[middle - reach : middle + reach + 1]
    best = int(np.argmax(window))
    shift = float(best - reach)
    if 0 < best < window.size - 1:
        before, peak, after = window[best - 1 : best + 2]
        shift += 0.5 * (before - after) / (before - 2 * peak + after)
    agreement = float(window[best])
    slope = np.gradient(first, interval)
    independent = max(2 * bandwidth_hz * interval * first.size, 1.0)
    residual = float(np.sqrt(max(1 / max(agreement, 1e-3) ** 2 - 1, 0.0)) * first.std())
    error = residual / max(float(np.sqrt((slope**2).mean())), 1e-300) / np.sqrt(independent)
    return Offset(shift * interval, float(error), max(agreement, 0.0))
