"""Arcs of a rocking history: impacts where the angle passes zero, and between them one peak, fitted locally."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CENTRAL_SHARE = 0.6
"""Share of an arc about its middle that enters the fit of its peak; the filter blurs its ends, the impacts."""


@dataclass(frozen=True)
class Arcs:
    """
    Complete arcs, in order.

    Attributes
    ----------
    start, end : ndarray, shape (n,)
        Times of the impacts on either side, s.
    peak_time, peak_angle : ndarray, shape (n,)
        s; rad, signed.
    peak_standard_error : ndarray, shape (n,)
        rad.
    """

    start: Array
    end: Array
    peak_time: Array
    peak_angle: Array
    peak_standard_error: Array

    @property
    def duration(self) -> Array:
        """Time between the two impacts, s."""
        return self.end - self.start


def noise_level(angle: Array) -> float:
    """
    Standard deviation of white noise on a smooth history, rad.

    Notes
    -----
    From the median magnitude of third differences, which a rocking arc hardly has; a filtered record's noise is smooth
    as well, so that this is a lower bound there.
    """
    if angle.size < 8:
        return 0.0
    third = np.diff(angle, 3)
    return float(np.median(np.abs(third)) / (0.6745 * np.sqrt(20.0)))


def find_impacts(time: Array, angle: Array, *, lowest: float) -> Array:
    """
    Times at which the block passes from one side to the other, s.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, rad; about true zero. Samples that are not finite are passed over.
    lowest : float
        rad; only excursions above it count, so that noise about rest or about a crossing is no impact.

    Returns
    -------
    impacts : ndarray, shape (m,)
        Each is the mean of the interpolated zeros between two opposite excursions.
    """
    finite = np.isfinite(angle)
    time, angle = time[finite], angle[finite]
    high = np.flatnonzero(np.abs(angle) > lowest)
    turns = np.flatnonzero(np.sign(angle[high[1:]]) != np.sign(angle[high[:-1]]))
    impacts = []
    for last, first in zip(high[turns], high[turns + 1], strict=True):
        piece = slice(last, first + 1)
        times, values = time[piece], angle[piece]
        passing = np.flatnonzero((values[1:] >= 0) != (values[:-1] >= 0))
        before, after = values[passing], values[passing + 1]
        zeros = times[passing] + (times[passing + 1] - times[passing]) * before / (before - after)
        impacts.append(float(zeros.mean()))
    return np.array(impacts, dtype=np.float64)


def find_arcs(time: Array, angle: Array, p: float, *, lowest: float) -> Arcs:
    """
    Find the arcs that lie between two impacts and rise above a level.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, rad; about true zero.
    p : float
        Frequency parameter, rad/s: the shape of the fit.
    lowest : float
        rad; lower arcs, such as those of noise, are left out.

    Returns
    -------
    arcs : Arcs
        Release and a record's start and end are no impacts, so the first and last piece of a history are not arcs.
        An arc with samples missing, or with fewer than three, has a peak of NaN, so that counting goes on.
    """
    impacts = find_impacts(time, angle, lowest=lowest)
    rows = []
    for start, end in pairwise(impacts):
        inside = slice(*np.searchsorted(time, (start, end)))
        times, values = time[inside], angle[inside]
        whole = values.size >= 3 and bool(np.isfinite(values).all())
        rows.append((start, end, *(_fit_peak(times, values, start, end, p) if whole else (np.nan,) * 3)))
    return Arcs(*(np.array(column, dtype=np.float64) for column in (zip(*rows, strict=True) if rows else [()] * 5)))


def _fit_peak(time: Array, angle: Array, start: float, end: float, p: float) -> tuple[float, float, float]:
    """
    Peak of one arc from a least-squares fit of c + A cosh p(t − t₀) + B sinh p(t − t₀) to its central part.

    Near its peak every arc of the nonlinear equation has this shape too, with a constant of its own.
    """
    middle, half = (start + end) / 2, CENTRAL_SHARE * (end - start) / 2
    central = np.abs(time - middle) <= half
    if central.sum() < 5:
        central = np.ones(time.size, dtype=bool)
    x = p * (time[central] - middle)
    values = angle[central]
    design = np.column_stack((np.ones_like(x), np.cosh(x) - 1, np.sinh(x)))
    coefficients, *_ = np.linalg.lstsq(design, values, rcond=None)
    constant, even, odd = coefficients
    if values.size < 4 or not abs(even) > abs(odd):
        highest = int(np.argmax(np.abs(angle)))
        return float(time[highest]), float(angle[highest]), float("nan")
    summit = -np.arctanh(odd / even)
    peak = constant - even + np.sign(even) * np.sqrt(even**2 - odd**2)
    residual = values - design @ coefficients
    freedom = values.size - 3
    variance = float(residual @ residual) / freedom
    # Filtered noise is correlated: the variance of a mean grows by (1 + r)/(1 − r) for first-order correlation r.
    power = float(residual @ residual)
    correlation = min(max(float(residual[1:] @ residual[:-1]) / power, 0.0), 0.95) if power > 0 else 0.0
    inflation = (1 + correlation) / (1 - correlation)
    gradient = np.array([1.0, np.cosh(summit) - 1, np.sinh(summit)])
    covariance = np.linalg.pinv(design.T @ design)
    error = float(np.sqrt(variance * inflation * (gradient @ covariance @ gradient)))
    return float(middle + summit / p), float(peak), error
