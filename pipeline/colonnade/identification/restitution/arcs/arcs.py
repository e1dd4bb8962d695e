"""Arcs of a rocking history: impacts where the angle passes zero, and between them one peak, fitted locally."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from itertools import pairwise

import numpy as np

from colonnade.arrays import Array

CENTRAL_SHARE = 0.6
"""Smallest share of an arc about its middle that enters its fit; the filter blurs its ends, the impacts."""

BLURRED = 0.08
"""Over p: what is left out about an impact where that leaves more of the arc; 1 / (2 × the default cut-off)."""

MOST_LAGS = 200
"""Samples over which correlations are summed at most."""

FEWEST_OWN = 30
"""Samples with which an arc's own scatter is a measure of its errors; with fewer it is that of all arcs."""


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
    rise, fall : ndarray, shape (n,)
        Times at which the fitted arc passes zero, s: the impacts, seen from within it.
    rise_standard_error, fall_standard_error : ndarray, shape (n,)
        s.
    zero_covariance : ndarray, shape (n,)
        Of `rise` and `fall`, s².
    """

    start: Array
    end: Array
    peak_time: Array
    peak_angle: Array
    peak_standard_error: Array
    rise: Array
    fall: Array
    rise_standard_error: Array
    fall_standard_error: Array
    zero_covariance: Array

    @property
    def duration(self) -> Array:
        """Time between the two impacts, s."""
        return self.end - self.start

    def later(self, first: int) -> Arcs:
        """Return the arcs from one on."""
        return Arcs(*(getattr(self, each.name)[first:] for each in fields(self)))

    @cached_property
    def impacts(self) -> tuple[Array, Array]:
        """
        Times of the impacts before, between and after the arcs, and their covariance.

        Returns
        -------
        times : ndarray, shape (n + 1,)
            s; the mean, by their errors, of the two arcs' zeros, or the interpolated zero where an arc has none.
        covariance : ndarray, shape (n + 1, n + 1)
            s²; neighbours share an arc. NaN on the diagonal where the zero is interpolated.
        """
        crossing = np.append(self.start, self.end[-1:])
        before, after = np.append(np.nan, self.fall), np.append(self.rise, np.nan)
        errors = np.append(np.nan, self.fall_standard_error), np.append(self.rise_standard_error, np.nan)
        with np.errstate(invalid="ignore", divide="ignore"):
            weights = [
                np.where(np.isfinite(each) & (error > 0), error**-2.0, 0.0)
                for each, error in zip((before, after), errors, strict=True)
            ]
            total = weights[0] + weights[1]
            times = (weights[0] * np.nan_to_num(before) + weights[1] * np.nan_to_num(after)) / total
            covariance = np.diag(np.where(total > 0, 1 / total, np.nan))
            shared = weights[1][:-1] * weights[0][1:] / (total[:-1] * total[1:]) * self.zero_covariance
        row = np.arange(self.start.size)
        covariance[row, row + 1] = covariance[row + 1, row] = np.nan_to_num(shared)
        return np.where(total > 0, times, crossing), covariance


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
        rad; only excursions above it count, so that noise about rest or about a crossing does not count as an impact.

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
    return arcs_between(find_impacts(time, angle, lowest=lowest), time, angle, p)


def arcs_between(impacts: Array, time: Array, angle: Array, p: float, *, critical: float | None = None) -> Arcs:
    """
    Fit the arc between each pair of neighbouring impacts; arguments and result as for `find_arcs`.

    Parameters
    ----------
    impacts : ndarray, shape (n + 1,)
        s.
    critical : float, optional
        α, rad: p is then that of the equation linearised about the middle of the arc, p sqrt(cos(α − 2|θ|/3)).

    Notes
    -----
    The fit is c + A cosh p(t − t₀) + B sinh p(t − t₀) by least squares, away from the impacts, that a filter rounds.
    Every arc of the nonlinear equation has this shape near its peak, with a constant of its own, so neither the gain of
    the transducers nor the critical angle enters. Standard errors allow for noise that is correlated over some samples:
    the variance of a mean grows by the sum of the correlations, which is that of the residuals of all arcs.
    """
    pieces = []
    for start, end in pairwise(impacts):
        inside = slice(*np.searchsorted(time, (start, end)))
        pieces.append(_fitted(time[inside], angle[inside], start, end, p, critical))
    growth = _growth([piece.residual for piece in pieces])
    scatters = [piece.variance for piece in pieces if np.isfinite(piece.variance)]
    common = float(np.median(scatters)) if scatters else np.nan
    rows = [
        (start, end, *_read_off(piece, growth * (piece.variance if piece.residual.size >= FEWEST_OWN else common)))
        for (start, end), piece in zip(pairwise(impacts), pieces, strict=True)
    ]
    return Arcs(*(np.array(column, dtype=np.float64) for column in (zip(*rows, strict=True) if rows else [()] * 10)))


@dataclass(frozen=True)
class _Fitted:
    """Coefficients of 1, cosh x − 1 and sinh x about the middle of an arc, and the residual."""

    middle: float
    p: float
    coefficients: Array
    inverse: Array
    residual: Array
    variance: float
    highest: tuple[float, float]


def _fitted(time: Array, angle: Array, start: float, end: float, p: float, critical: float | None) -> _Fitted:
    missing = _Fitted(np.nan, p, np.full(3, np.nan), np.full((3, 3), np.nan), np.empty(0), np.nan, (np.nan, np.nan))
    if time.size < 3 or not np.isfinite(angle).all():
        return missing
    middle, half = (start + end) / 2, (end - start) / 2
    if critical is not None:
        p *= float(np.sqrt(np.cos(max(critical - 2 / 3 * float(np.abs(angle).max()), 0.0))))
    central = np.abs(time - middle) <= max(CENTRAL_SHARE * half, half - BLURRED / p)
    if central.sum() < 5:
        central = np.ones(time.size, dtype=bool)
    x, values = p * (time[central] - middle), angle[central]
    design = np.column_stack((np.ones_like(x), np.cosh(x) - 1, np.sinh(x)))
    highest = int(np.argmax(np.abs(angle)))
    summit = (float(time[highest]), float(angle[highest]))
    normal = design.T @ design
    if values.size < 4 or not np.linalg.cond(normal) < 1e12:
        return _Fitted(middle, p, np.full(3, np.nan), missing.inverse, np.empty(0), np.nan, summit)
    inverse = np.linalg.inv(normal)
    coefficients = inverse @ (design.T @ values)
    residual = values - design @ coefficients
    return _Fitted(middle, p, coefficients, inverse, residual, float(residual @ residual) / (values.size - 3), summit)


def _growth(residuals: list[Array]) -> float:
    """Sum of the correlations of all arcs' residuals up to where they vanish: 1 for white noise."""
    longest = max((residual.size for residual in residuals), default=0) // 3
    power = sum(float(residual @ residual) for residual in residuals)
    growth = 1.0
    for lag in range(1, min(longest, MOST_LAGS)):
        together = sum(float(residual[lag:] @ residual[:-lag]) for residual in residuals if residual.size > lag)
        if not together > 0.05 * power:
            break
        growth += 2 * together / power
    return growth


def _read_off(piece: _Fitted, variance: float) -> tuple[float, ...]:
    """Peak and both zeros of a fitted arc, with their errors, in the order of `Arcs`."""
    constant, even, odd = piece.coefficients
    p = piece.p
    nothing = (np.nan,) * 5
    if not abs(even) > abs(odd):
        return (*piece.highest, np.nan, *nothing)
    summit = -np.arctanh(odd / even)
    radius = np.sign(even) * np.sqrt(even**2 - odd**2)
    peak = constant - even + radius
    gradient = np.array([1.0, np.cosh(summit) - 1, np.sinh(summit)])
    error = float(np.sqrt(variance * (gradient @ piece.inverse @ gradient)))
    at_peak = (float(piece.middle + summit / p), float(peak), error)
    if not (even - constant) / radius > 1:
        return (*at_peak, *nothing)
    reach = float(np.arccosh((even - constant) / radius))
    x = np.array([summit - reach, summit + reach])
    by_time = p * (even * np.sinh(x) + odd * np.cosh(x))
    gradients = np.array([np.ones(2), np.cosh(x) - 1, np.sinh(x)]) / by_time
    covariance = variance * (gradients.T @ piece.inverse @ gradients)
    rise, fall = (piece.middle + x / p).tolist()
    errors = np.sqrt(np.diag(covariance)).tolist()
    return (*at_peak, rise, fall, *errors, float(covariance[0, 1]))
