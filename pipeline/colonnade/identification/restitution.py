"""Coefficient of restitution from the peaks of a free vibration, by Housner's relation between them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.identification.arcs import Arcs, find_arcs, noise_level

Array = NDArray[np.float64]

METHOD = "peaks: log-energy against impact number, weighted, common zero offset, random-walk scatter (REML)"

FEWEST_PEAKS = 5
NOISE_MARGIN = 8.0
"""Peaks below this many standard deviations of the noise are left out."""

PERIOD_TOLERANCE = 0.25
"""Largest median departure of the arcs' durations from those of a rocking block of this size."""


@dataclass(frozen=True)
class Peaks:
    """The peaks that an identification saw: s, rad, rad, rad, and whether each entered the fit; all shape (n,)."""

    time: Array = field(default_factory=lambda: np.empty(0))
    angle: Array = field(default_factory=lambda: np.empty(0))
    standard_error: Array = field(default_factory=lambda: np.empty(0))
    fitted_angle: Array = field(default_factory=lambda: np.empty(0))
    used: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=bool))


@dataclass(frozen=True)
class Restitution:
    """
    An identified coefficient of restitution, or the reason why there is none.

    Attributes
    ----------
    value, low, high : float or None
        e and its interval of confidence at `level`; None where refused.
    standard_error : float or None
    level : float
    method : str
    reason : str
        Why refused; empty otherwise.
    zero_offset : float
        rad, common to all peaks; already taken off `peaks.angle`.
    peaks : Peaks
    """

    value: float | None
    low: float | None
    high: float | None
    standard_error: float | None
    level: float
    method: str
    reason: str = ""
    zero_offset: float = 0.0
    peaks: Peaks = field(default_factory=Peaks)


def released_energy(angle: ArrayLike, critical_angle: ArrayLike) -> Array:
    """
    Fraction of the overturning energy barrier that a peak holds.

    Parameters
    ----------
    angle, critical_angle : array_like, shape (n,)
        |θ| and α, rad.

    Returns
    -------
    energy : ndarray, shape (n,)
        [cos(α − |θ|) − cos α] / (1 − cos α), dimensionless.

    Notes
    -----
    Each impact multiplies it by e². For small α it is Housner's 1 − (1 − |θ|/α)² (Housner 1963, eq. 11).

    Examples
    --------
    >>> released_energy(0.2, 0.2).tolist()
    1.0
    """
    theta, critical = np.abs(np.asarray(angle, dtype=np.float64)), np.asarray(critical_angle, dtype=np.float64)
    # cos(α − θ) − cos α without the cancellation at small angles.
    return np.asarray(2 * np.sin(critical - theta / 2) * np.sin(theta / 2) / (2 * np.sin(critical / 2) ** 2))


def angle_of_energy(energy: ArrayLike, critical_angle: ArrayLike) -> Array:
    """Return |θ| of a peak (rad) that holds a fraction of the barrier: the inverse of `released_energy`."""
    critical = np.asarray(critical_angle, dtype=np.float64)
    cosine = np.asarray(energy, dtype=np.float64) * (1 - np.cos(critical)) + np.cos(critical)
    return np.asarray(critical - np.arccos(np.clip(cosine, -1.0, 1.0)))


def identify_restitution(
    time: ArrayLike,
    angle: ArrayLike,
    block: Block,
    *,
    level: float = 0.95,
    lowest_amplitude: float = 0.02,
    noise: float | None = None,
) -> Restitution:
    """
    Identify the coefficient of restitution from a free vibration.

    Parameters
    ----------
    time, angle : array_like, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
    level : float, optional
        Of the interval of confidence.
    lowest_amplitude : float, optional
        Peaks with |θ|/α below it are left out, as are those under `NOISE_MARGIN` times the noise.
    noise : float, optional
        Standard deviation of the angle at rest, rad; default: from the record's third differences.

    Returns
    -------
    result : Restitution
        `value` is None, with a `reason`, where the record does not give e.

    Raises
    ------
    ValueError
        If time and angle differ in shape or time does not increase.

    Notes
    -----
    Assumes plane rocking without slide or bounce, one e for all impacts, and both sides rocking about the same zero.
    The logarithm of the energy of the n-th peak falls by 2 ln e an impact. The release itself is not used: how the
    block was let go is not known. Variances: that of each peak's own fit, scaled where the scatter is larger, and a
    random walk for an e that differs from impact to impact, their ratio by restricted maximum likelihood.
    """
    times, angles = np.asarray(time, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    if times.ndim != 1 or times.shape != angles.shape:
        raise ValueError(
            f"time has shape {times.shape} and angle {angles.shape}; two arrays of one length were expected"
        )
    if times.size and not (np.diff(times) > 0).all():
        raise ValueError(f"time does not increase after sample {int(np.argmin(np.diff(times) > 0))}")

    def refused(reason: str, peaks: Peaks | None = None) -> Restitution:
        return Restitution(None, None, None, None, level, METHOD, reason, peaks=peaks or Peaks())

    if np.isfinite(angles).sum() < 8:
        return refused("The record holds fewer than 8 values.")
    scatter = noise_level(angles[np.isfinite(angles)]) if noise is None else noise
    lowest = max(lowest_amplitude * block.critical_angle, NOISE_MARGIN * scatter)
    arcs = find_arcs(times, angles, block.p, lowest=lowest)
    critical = np.where(arcs.peak_angle < 0, block.negative.critical_angle, block.positive.critical_angle)
    seen = np.abs(arcs.peak_angle)
    usable = np.isfinite(arcs.peak_standard_error) & (seen > lowest) & (seen < critical)
    peaks = Peaks(arcs.peak_time, arcs.peak_angle, arcs.peak_standard_error, np.full(seen.shape, np.nan), usable)
    if usable.sum() < FEWEST_PEAKS:
        return refused(
            f"{int(usable.sum())} peaks between two impacts stand above {lowest / block.critical_angle:.2g} of the "
            f"critical angle; at least {FEWEST_PEAKS} are needed.",
            peaks,
        )
    departure = _period_departure(arcs, block, usable)
    if abs(departure) > PERIOD_TOLERANCE:
        return refused(
            f"Times between impacts are {departure:+.0%} off those of this block rocking freely at such amplitudes: "
            "this is not a free rocking of this specimen, or its dimensions are not these.",
            peaks,
        )
    return _fit(arcs, critical, usable, scatter, level, peaks)


def _period_departure(arcs: Arcs, block: Block, usable: NDArray[np.bool_]) -> float:
    """Return the median relative departure of the arcs' durations from Housner's (1963, eq. 3)."""
    negative = arcs.peak_angle[usable] < 0
    critical = np.where(negative, block.negative.critical_angle, block.positive.critical_angle)
    p = np.where(negative, block.side_p(block.negative), block.side_p(block.positive))
    expected = 2 * np.arccosh(1 / (1 - np.abs(arcs.peak_angle[usable]) / critical)) / p
    return float(np.median(arcs.duration[usable] / expected)) - 1


def _fit(
    arcs: Arcs, critical: Array, usable: NDArray[np.bool_], noise: float, level: float, peaks: Peaks
) -> Restitution:
    number = np.flatnonzero(usable).astype(np.float64)
    angle, alpha = arcs.peak_angle[usable], critical[usable]
    error = np.maximum(arcs.peak_standard_error[usable], 1e-3 * max(noise, 1e-9))
    offset, estimate = 0.0, _Line(np.zeros(3), np.zeros((3, 3)))
    for _ in range(6):
        # The common zero offset is the third unknown: it moves peaks of opposite sign in opposite ways.
        moved = np.abs(angle - offset)
        energy = released_energy(moved, alpha)
        gradient = np.sin(alpha - moved) / (1 - np.cos(alpha)) / energy
        design = np.column_stack((np.ones_like(number), number, np.sign(angle) * gradient))
        estimate = _weighted_line(design, np.log(energy), gradient * error, number)
        offset += float(estimate.coefficients[2])
        if not np.abs(angle - offset).min() > 0:
            break
    slope, slope_error = float(estimate.coefficients[1]), float(np.sqrt(estimate.covariance[1, 1]))
    half = float(stats.t.ppf((1 + level) / 2, number.size - 3)) * slope_error
    fitted = np.full(usable.shape, np.nan)
    line = np.exp(estimate.coefficients[0] + slope * np.arange(usable.size))
    fitted[usable] = np.sign(angle) * angle_of_energy(line[usable], alpha)
    peaks = Peaks(peaks.time, peaks.angle - offset, peaks.standard_error, fitted, usable)
    low, value, high = (float(np.exp(bound / 2)) for bound in (slope - half, slope, slope + half))
    if not np.isfinite(half) or high >= 1:
        reason = (
            f"The peaks do not decay: e would be {value:.4f}, between {low:.4f} and {high:.4f}; below 1 was expected. "
            "A free vibration on a table at rest is needed."
        )
        return Restitution(None, None, None, None, level, METHOD, reason, offset, peaks)
    return Restitution(value, low, high, value * slope_error / 2, level, METHOD, "", offset, peaks)


@dataclass(frozen=True)
class _Line:
    coefficients: Array
    covariance: Array


def _weighted_line(design: Array, values: Array, error: Array, number: Array) -> _Line:
    """
    Generalised least squares with variance s² [diag(error²) + ρ min(i, j)], ρ by restricted maximum likelihood.

    The walk begins at the first peak; ρ = 0 is independent scatter alone.
    """
    walk = np.minimum.outer(number - number[0], number - number[0])
    freedom = values.size - design.shape[1]
    best: tuple[float, _Line] | None = None
    for ratio in np.concatenate(([0.0], np.geomspace(1e-3, 1e3, 25))):
        variance = np.diag(error**2) + ratio * np.median(error**2) * walk
        factor = np.linalg.cholesky(variance)
        white_design, white_values = np.linalg.solve(factor, design), np.linalg.solve(factor, values)
        normal = white_design.T @ white_design
        inverse = np.linalg.inv(normal)
        coefficients = inverse @ white_design.T @ white_values
        residual = white_values - white_design @ coefficients
        scale = max(float(residual @ residual) / freedom, 1e-300)
        criterion = (
            2 * float(np.log(np.diag(factor)).sum())
            + float(np.linalg.slogdet(normal)[1])
            + freedom * float(np.log(scale))
        )
        if best is None or criterion < best[0]:
            best = criterion, _Line(coefficients, inverse * max(scale, 1.0))
    if best is None:
        raise ValueError("no value of the variance ratio was tried")
    return best[1]
