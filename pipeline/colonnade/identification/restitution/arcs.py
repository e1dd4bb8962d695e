"""Arcs of a rocking history: impacts where the angle passes zero, and between them one peak, fitted locally."""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import pairwise, starmap

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask

CENTRAL_SHARE = 0.6
"""Smallest share of an arc about its middle that enters its fit; the filter blurs its ends, the impacts."""

BLURRED = 0.08
"""Over p: what is left out about an impact where that leaves more of the arc; 1 / (2 × the default cut-off)."""

MOST_LAGS = 200
"""Samples over which correlations are summed at most."""

FEWEST_WHOLE, FEWEST_CENTRAL, FEWEST_SAMPLES = 3, 5, 4
"""Samples of an arc that counts; in its central part, without which all are taken; with which it is fitted, ..."""

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
    duration, duration_standard_error : ndarray, shape (n,)
        s, between the zeros of the fitted arc: how long it lasts, seen from within it.
    """

    start: Array
    end: Array
    peak_time: Array
    peak_angle: Array
    peak_standard_error: Array
    duration: Array
    duration_standard_error: Array

    @property
    def height(self) -> Array:
        """|θ| of the peaks, rad."""
        return np.abs(self.peak_angle)

    def pieces(self, time: Array, first: float, last: float) -> list[slice]:
        """Samples of each arc between two shares of its duration."""
        length = self.end - self.start
        ends = np.searchsorted(time, (self.start + first * length, self.start + last * length))
        return list(starmap(slice, ends.T.tolist()))

    def only(self, chosen: Mask) -> Arcs:
        """Some of the arcs."""
        return Arcs(*(getattr(self, each.name)[chosen] for each in fields(self)))


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


def arcs_between(impacts: Array, time: Array, angle: Array, p: float, *, critical: float | None = None) -> Arcs:
    """
    Fit the arc between each pair of neighbouring impacts.

    Parameters
    ----------
    impacts : ndarray, shape (m + 1,)
        s. Release and a record's start and end are no impacts: the first and last piece of a history are not arcs.
    time, angle : ndarray, shape (n,)
        s, rad; about true zero.
    p : float
        Frequency parameter, rad/s: the shape of the fit.
    critical : float, optional
        α, rad: with it p is that of the equation linearised about the middle of an arc, p sqrt(cos(α − 2|θ|/3)).

    Returns
    -------
    arcs : Arcs
        An arc with samples missing, or with fewer than three, has a peak of NaN, so that counting goes on.

    Notes
    -----
    The fit is c + A cosh p(t − t₀) + B sinh p(t − t₀) by least squares, away from the impacts, that a filter rounds.
    Every arc of the nonlinear equation has this shape near its peak, with a constant of its own, so neither the gain of
    the transducers nor the critical angle enters. Standard errors allow for noise that is correlated over some samples:
    the variance of a mean grows by the sum of the correlations, which is that of the residuals of all arcs.
    """
    if impacts.size < 2:
        return Arcs(*[np.empty(0)] * 7)
    start, end = impacts[:-1], impacts[1:]
    middle, half = (start + end) / 2, (end - start) / 2
    highest = np.full((start.size, 2), np.nan)
    bounds = np.searchsorted(time, impacts).tolist()
    for arc, piece in enumerate(starmap(slice, pairwise(bounds))):
        if piece.stop - piece.start >= FEWEST_WHOLE and np.isfinite(angle[piece]).all():
            summit = piece.start + int(np.abs(angle[piece]).argmax())
            highest[arc] = time[summit], angle[summit]
    rate = np.full(start.size, p)
    if critical is not None:
        rate *= np.sqrt(np.cos(np.maximum(critical - 2 / 3 * np.abs(highest[:, 1]), 0.0)))
    # From here on samples are those that are fitted, each with the number of its arc.
    number, inside = np.repeat(np.arange(start.size), np.diff(bounds)), slice(bounds[0], bounds[-1])
    time, angle = time[inside], angle[inside]
    central = np.abs(time - middle[number]) <= np.maximum(CENTRAL_SHARE * half, half - BLURRED / rate)[number]
    few = np.bincount(number, central, start.size) < FEWEST_CENTRAL
    fitted = (central | few[number]) & np.isfinite(highest[number, 0])
    number, angle = number[fitted], angle[fitted]
    count = np.bincount(number, minlength=start.size)
    # With a clock in the wrong unit the hyperbolic functions exceed all numbers.
    with np.errstate(over="ignore", invalid="ignore"):
        columns = _shape(rate[number] * (time[fitted] - middle[number]))
        pieces = list(starmap(slice, pairwise([0, *np.cumsum(count).tolist()])))
        normal = np.array([columns[piece].T @ columns[piece] for piece in pieces])
        right = np.array([columns[piece].T @ angle[piece] for piece in pieces])
    is_known = (count >= FEWEST_SAMPLES) & np.isfinite(normal).all(axis=(1, 2))
    is_known[is_known] = np.linalg.cond(normal[is_known]) < SINGULAR
    inverse = np.full(normal.shape, np.nan)
    inverse[is_known] = np.linalg.inv(normal[is_known])
    coefficients = (inverse @ right[:, :, None])[:, :, 0]
    residual = np.where(is_known[number], angle - (columns * coefficients[number]).sum(axis=1), 0.0)
    variance = np.bincount(number, residual**2, start.size) / np.maximum(count - 3, 1)
    common = float(np.median(variance[is_known])) if is_known.any() else np.nan
    variance = growth(residual, number, int(count.max())) * np.where(count < FEWEST_OWN, common, variance)
    constant, even, odd = coefficients.T
    with np.errstate(invalid="ignore", divide="ignore"):
        summit, radius = -np.arctanh(odd / even), np.copysign(np.sqrt(even**2 - odd**2), even)
        reach = np.arccosh((even - constant) / radius)
    peak_error, rise_error, fall_error = (
        np.sqrt(variance * np.einsum("mi,mij,mj->m", _shape(x), inverse, _shape(x)))
        for x in (summit, summit - reach, summit + reach)
    )
    has_top = np.isfinite(summit)
    return Arcs(
        start,
        end,
        np.where(has_top, middle + summit / rate, highest[:, 0]),
        np.where(has_top, constant - even + radius, highest[:, 1]),
        peak_error,
        2 * reach / rate,
        np.hypot(rise_error, fall_error) / np.abs(rate * radius * np.sinh(reach)),
    )


def _shape(x: Array) -> Array:
    """Return the columns 1, cosh x − 1 and sinh x of the fit."""
    return np.column_stack((np.ones(x.size), np.cosh(x) - 1.0, np.sinh(x)))


def growth(residual: Array, number: NDArray[np.int64], longest: int) -> float:
    """Sum of the correlations of residuals within arcs up to where they vanish: 1 for white noise."""
    power, growth = float(residual @ residual), 1.0
    for lag in range(1, min(longest // 3, MOST_LAGS)):
        together = float((residual[lag:] * residual[:-lag])[number[lag:] == number[:-lag]].sum())
        if not together > 0.05 * power:
            break
        growth += 2 * together / power
    return growth
