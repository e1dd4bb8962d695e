"""Arcs of a rocking history: impacts where the angle passes zero, and between them one peak, fitted locally."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import cos, cosh, sinh, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

CENTRAL_SHARE = 0.6
"""Smallest share of an arc about its middle that enters its fit; the filter blurs its ends, the impacts."""

BLURRED = 0.08
"""Over p: what is left out about an impact where that leaves more of the arc; 1 / (2 × the default cut-off)."""

MOST_LAGS = 200
"""Samples over which correlations are summed at most."""

FEWEST_SAMPLES = 4
"""With which an arc is fitted, ..."""

SINGULAR = 1e12
"""... if the condition of its normal equations is below this."""

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

    @property
    def impacts(self) -> tuple[Array, Array]:
        """
        Times of the impacts before, between and after the arcs, and their standard errors, s, shape (n + 1,).

        The mean, by their errors, of the two arcs' zeros; where an arc has none, the interpolated zero, without error.
        """
        times = np.column_stack((np.append(np.nan, self.fall), np.append(self.rise, np.nan)))
        errors = np.column_stack(
            (np.append(np.nan, self.fall_standard_error), np.append(self.rise_standard_error, np.nan))
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            weights = np.where(np.isfinite(times) & (errors > 0), errors**-2.0, 0.0)
            total = weights.sum(axis=1)
            known = total > 0
            mean = (weights * np.nan_to_num(times)).sum(axis=1) / total
        crossing = np.append(self.start, self.end[-1:])
        return np.where(known, mean, crossing), np.where(known, np.maximum(total, 1e-300) ** -0.5, np.nan)


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
    bounds = np.searchsorted(time, impacts)
    # A copy: the kernel is compiled for arrays that may be written, and once more for that of a file.
    sums = _summed(time.copy(), angle, impacts, bounds, p, np.nan if critical is None else critical)
    middle, own_p, count, normal = sums.middle, sums.p, sums.last - sums.first, sums.normal
    # With a clock in the wrong unit the hyperbolic functions exceed all numbers.
    fitted = (count >= FEWEST_SAMPLES) & np.isfinite(normal).all(axis=(1, 2))
    fitted[fitted] = np.linalg.cond(normal[fitted]) < SINGULAR
    inverse = np.full(normal.shape, np.nan)
    inverse[fitted] = np.linalg.inv(normal[fitted])
    coefficients = (inverse @ sums.right[:, :, None])[:, :, 0]
    residuals = [
        _residual(time[each], angle[each], *of_arc) if is_fitted else np.empty(0)
        for is_fitted, each, *of_arc in zip(
            fitted.tolist(), map(slice, sums.first, sums.last), middle, own_p, coefficients, strict=True
        )
    ]
    variance = np.array([residual @ residual / max(residual.size - 3, 1) for residual in residuals])
    variance[~fitted] = np.nan
    common = float(np.median(variance[fitted])) if fitted.any() else np.nan
    variance = _growth(residuals) * np.where(fitted & (count < FEWEST_OWN), common, variance)
    rows = [
        (*ends, *_read_off(*of_arc))
        for ends, *of_arc in zip(
            pairwise(impacts), middle, own_p, coefficients, inverse, variance, sums.highest, strict=True
        )
    ]
    return Arcs(*(np.array(column, dtype=np.float64) for column in (zip(*rows, strict=True) if rows else [()] * 9)))


class _Sums(NamedTuple):
    """
    What is summed over each of n arcs, for the coefficients of 1, cosh x − 1 and sinh x about its middle.

    Attributes
    ----------
    middle, p : ndarray, shape (n,)
        s; 1/s. NaN if samples are too few or missing.
    first, last : ndarray of int, shape (n,)
        Samples away from the impacts, the last excluded; none if samples are too few or missing.
    normal, right : ndarray, shape (n, 3, 3), (n, 3)
        Normal equations.
    highest : ndarray, shape (n, 2)
        Time (s) and angle (rad) of the highest sample.
    """

    middle: Array
    p: Array
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    normal: Array
    right: Array
    highest: Array


@kernel
def _summed(time: Array, angle: Array, impacts: Array, bounds: NDArray[np.int64], p: float, critical: float) -> _Sums:
    arcs = max(impacts.size - 1, 0)
    middle, own_p, highest = np.full(arcs, np.nan), np.full(arcs, p), np.full((arcs, 2), np.nan)
    firsts, lasts = np.zeros(arcs, dtype=np.int64), np.zeros(arcs, dtype=np.int64)
    normal, right = np.zeros((arcs, 3, 3)), np.zeros((arcs, 3))
    for arc in range(arcs):
        first, last = bounds[arc], bounds[arc + 1]
        summit, is_whole = first, last - first >= 3
        for n in range(first, last):
            is_whole = is_whole and np.isfinite(angle[n])
            if abs(angle[n]) > abs(angle[summit]):
                summit = n
        if not is_whole:
            continue
        highest[arc, 0], highest[arc, 1] = time[summit], angle[summit]
        centre, half = (impacts[arc] + impacts[arc + 1]) / 2, (impacts[arc + 1] - impacts[arc]) / 2
        rate = p
        if not np.isnan(critical):
            rate *= sqrt(cos(max(critical - 2 / 3 * abs(angle[summit]), 0.0)))
        reach = max(CENTRAL_SHARE * half, half - BLURRED / rate)
        low, high = first, last
        while low < high and abs(time[low] - centre) > reach:
            low += 1
        while high > low and abs(time[high - 1] - centre) > reach:
            high -= 1
        if high - low < 5:
            low, high = first, last
        for n in range(low, high):
            x = rate * (time[n] - centre)
            even, odd = cosh(x) - 1.0, sinh(x)
            row = (1.0, even, odd)
            for i in range(3):
                right[arc, i] += row[i] * angle[n]
                for k in range(3):
                    normal[arc, i, k] += row[i] * row[k]
        middle[arc], own_p[arc], firsts[arc], lasts[arc] = centre, rate, low, high
    return _Sums(middle, own_p, firsts, lasts, normal, right, highest)


@kernel
def _residual(time: Array, angle: Array, middle: float, p: float, coefficients: Array) -> Array:
    """Measured less fitted, rad."""
    residual = np.empty(time.size)
    for n in range(time.size):
        x = p * (time[n] - middle)
        residual[n] = angle[n] - coefficients[0] - coefficients[1] * (cosh(x) - 1.0) - coefficients[2] * sinh(x)
    return residual


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


@kernel
def _read_off(
    middle: float, p: float, coefficients: Array, inverse: Array, variance: float, highest: Array
) -> tuple[float, float, float, float, float, float, float]:
    """Peak and both zeros of a fitted arc, with their errors, in the order of `Arcs`."""
    constant, even, odd = coefficients[0], coefficients[1], coefficients[2]
    nan = np.nan
    if not abs(even) > abs(odd):
        return highest[0], highest[1], nan, nan, nan, nan, nan
    summit = -np.arctanh(odd / even)
    radius = np.sign(even) * sqrt(even**2 - odd**2)
    peak, time = constant - even + radius, middle + summit / p
    error = sqrt(variance * _spread(inverse, summit))
    height = (even - constant) / radius
    if not height > 1:
        return time, peak, error, nan, nan, nan, nan
    reach = np.arccosh(height)
    rise, fall = summit - reach, summit + reach
    of_rise = p * (even * sinh(rise) + odd * cosh(rise))
    of_fall = p * (even * sinh(fall) + odd * cosh(fall))
    rise_error = sqrt(variance * _spread(inverse, rise)) / abs(of_rise)
    fall_error = sqrt(variance * _spread(inverse, fall)) / abs(of_fall)
    return time, peak, error, middle + rise / p, middle + fall / p, rise_error, fall_error


@kernel
def _spread(inverse: Array, x: float) -> float:
    """Variance of the fitted curve at x, in the variance of a sample."""
    row = (1.0, cosh(x) - 1.0, sinh(x))
    total = 0.0
    for i in range(3):
        for k in range(3):
            total += row[i] * inverse[i, k] * row[k]
    return total
