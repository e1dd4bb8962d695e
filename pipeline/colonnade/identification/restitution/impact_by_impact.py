"""Coefficient of restitution of each impact, from the arcs before and after it, against its velocity: is e constant?"""

from __future__ import annotations

from math import exp, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy import optimize, stats

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs import Arcs
from colonnade.identification.restitution.result import Constancy, Estimate, Impacts

Array = NDArray[np.float64]

NAME = "impact-by-impact"
FEWEST_IMPACTS = 4

ASSUMPTIONS = (
    "plane rocking without slide or bounce; e of each impact about one mean, independent of the others; the angle's "
    "scale and the block's critical angles; both sides about one zero; p does not enter"
)


def kinetic_energy(peak: Array, block: Block) -> Array:
    """Return ω²/2 of the impacts about an arc, (rad/s)², from its signed peak, rad; shape (n,)."""
    negative = peak < 0
    critical = np.where(negative, block.negative.critical_angle, block.positive.critical_angle)
    p = np.where(negative, block.side_p(block.negative), block.side_p(block.positive))
    size = np.abs(peak)
    return np.asarray(2 * p**2 * np.sin(critical - size / 2) * np.sin(size / 2))


def single_impacts(arcs: Arcs, offset: float, usable: NDArray[np.bool_], block: Block) -> Impacts:
    """
    Find e of each impact between two arcs.

    Parameters
    ----------
    arcs : Arcs
        n of them.
    offset : float
        Common zero offset of the peaks, rad.
    usable : ndarray of bool, shape (n,)
    block : Block

    Returns
    -------
    impacts : Impacts
        n − 1 of them. Times are the mean, by their errors, of the two arcs' zeros; the interpolated zero where an arc
        has none.
    """
    if arcs.start.size < 2:
        return Impacts()
    times, covariance = impact_times(arcs)
    errors = np.sqrt(np.diag(covariance))
    peak = arcs.peak_angle - offset
    sound = usable & (np.abs(peak) < np.where(peak < 0, block.negative.critical_angle, block.positive.critical_angle))
    with np.errstate(invalid="ignore", divide="ignore"):
        energy = np.where(sound, kinetic_energy(peak, block), np.nan)
        relative = np.where(sound, _relative_slope(peak, block) * arcs.peak_standard_error, np.nan)
        restitution = np.sqrt(energy[1:] / energy[:-1])
    error = 0.5 * restitution * np.hypot(relative[1:], relative[:-1])
    return Impacts(
        times[1:-1],
        errors[1:-1],
        np.sqrt(2 * energy[:-1]),
        restitution,
        error,
        np.isfinite(restitution) & np.isfinite(error),
    )


def impact_times(arcs: Arcs) -> tuple[Array, Array]:
    """
    Times of the impacts before, between and after n arcs.

    Returns
    -------
    times : ndarray, shape (n + 1,)
        s; the mean, by their errors, of the two arcs' zeros, or the interpolated zero where an arc has none.
    covariance : ndarray, shape (n + 1, n + 1)
        s²; neighbours share an arc. NaN on the diagonal where the zero is interpolated.
    """
    crossing = np.append(arcs.start, arcs.end[-1:])
    before, after = np.append(np.nan, arcs.fall), np.append(arcs.rise, np.nan)
    errors = np.append(np.nan, arcs.fall_standard_error), np.append(arcs.rise_standard_error, np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        weights = [
            np.where(np.isfinite(each) & (error > 0), error**-2.0, 0.0)
            for each, error in zip((before, after), errors, strict=True)
        ]
        total = weights[0] + weights[1]
        times = (weights[0] * np.nan_to_num(before) + weights[1] * np.nan_to_num(after)) / total
        covariance = np.diag(np.where(total > 0, 1 / total, np.nan))
        shared = weights[1][:-1] * weights[0][1:] / (total[:-1] * total[1:]) * arcs.zero_covariance
    row = np.arange(arcs.start.size)
    covariance[row, row + 1] = covariance[row + 1, row] = np.nan_to_num(shared)
    return np.where(total > 0, times, crossing), covariance


def fit_impacts(
    arcs: Arcs, offset: float, impacts: Impacts, block: Block, *, level: float = 0.95
) -> tuple[Estimate, Constancy]:
    """
    Average e over the impacts and test whether it is constant.

    Parameters
    ----------
    arcs : Arcs
    offset : float
        rad.
    impacts : Impacts
        Of `single_impacts`.
    block : Block
    level : float

    Returns
    -------
    estimate : Estimate
    constancy : Constancy

    Notes
    -----
    Neighbouring impacts share a peak, so that their errors are correlated: generalised least squares of ln e with the
    errors' covariance, a scatter τ² between impacts on its diagonal (where the weighted sum of squares equals its
    degrees of freedom, Paule and Mandel 1982), and a correction of the zero offset, which moves successive e in
    opposite ways.
    """
    used = impacts.used
    count = int(used.sum())
    if count < FEWEST_IMPACTS:
        reason = f"{count} impacts lie between two peaks that can be used; {FEWEST_IMPACTS} are needed."
        return Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason), Constancy()
    peak = arcs.peak_angle - offset
    slope = _relative_slope(peak, block)
    difference = 0.5 * (np.eye(peak.size, k=1) - np.eye(peak.size))[:-1][used]
    known = np.isfinite(slope) & np.isfinite(arcs.peak_standard_error)
    covariance = (difference * np.where(known, (slope * arcs.peak_standard_error) ** 2, 0.0)) @ difference.T
    by_offset = difference @ np.where(known, np.sign(peak) * slope, 0.0)
    logarithm = np.log(impacts.restitution[used])
    design = np.column_stack((np.ones(count), by_offset))
    freedom = count - design.shape[1]

    def fitted(scatter: float, columns: Array) -> tuple[Array, Array, float]:
        factor = np.linalg.cholesky(covariance + scatter * np.eye(count) + 1e-18 * np.eye(count))
        white, values = np.linalg.solve(factor, columns), np.linalg.solve(factor, logarithm)
        inverse = np.linalg.pinv(white.T @ white)
        coefficients = inverse @ (white.T @ values)
        return coefficients, inverse, float(((values - white @ coefficients) ** 2).sum())

    def scatter_about(columns: Array) -> float:
        spare, widest = count - columns.shape[1], float(np.var(logarithm)) * count + 1e-12
        if spare < 1 or fitted(0.0, columns)[2] <= spare or fitted(widest, columns)[2] >= spare:
            return 0.0
        return float(optimize.brentq(lambda each: fitted(each, columns)[2] - spare, 0.0, widest, rtol=1e-3))

    alone, scatter = fitted(0.0, design)[2], scatter_about(design)
    coefficients, inverse, _ = fitted(scatter, design)
    error = sqrt(inverse[0, 0])
    half = float(stats.t.ppf((1 + level) / 2, freedom)) * error
    low, value, high = (exp(bound) for bound in (coefficients[0] - half, coefficients[0], coefficients[0] + half))
    velocity = impacts.velocity[used]
    trend = np.column_stack((design, velocity - velocity.mean()))
    sloped, spread, _ = fitted(scatter_about(trend), trend)
    constancy = Constancy(
        value * float(sloped[2]),
        value * sqrt(spread[2, 2]),
        value * float(sloped[2]) * float(np.ptp(velocity)),
        value * sqrt(scatter),
        alone,
        freedom,
    )
    return Estimate(NAME, value, low, high, value * error, level, ASSUMPTIONS), constancy


def _relative_slope(peak: Array, block: Block) -> Array:
    """Derivative of ln ω² by |θ|, 1/rad."""
    critical = np.where(peak < 0, block.negative.critical_angle, block.positive.critical_angle)
    size = np.abs(peak)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.sin(critical - size) / (2 * np.sin(critical - size / 2) * np.sin(size / 2)))
