"""Coefficient of restitution from the times between impacts alone: no angle has to be calibrated."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.decay import ALWAYS, Decay
from colonnade.identification.restitution.result import Estimate
from colonnade.identification.restitution.rocking_arc import half_duration

Array = NDArray[np.float64]

NAME = "half-periods"
FEWEST_SPARE = 2
"""Impacts beyond the number of unknowns."""

MOST_STEPS = 30
LARGEST_ERROR_OF_P = 0.01
"""Standard error of ln p up to which p is freed where wanted."""

ASSUMPTIONS = (
    "plane rocking without slide or bounce; one e for all impacts; the block's critical angles; both sides about one "
    "zero; the angle's scale does not enter"
)


@dataclass(frozen=True)
class HalfPeriods:
    """
    The estimate, and what came with it.

    Attributes
    ----------
    estimate : Estimate
    p_factor, p_standard_error : float
        Freed p over the block's, and its error; 1 and 0 where p was fixed.
    correlation : float
        Of ln e and ln p where p was freed, or where freeing it was tried and failed; NaN otherwise.
    """

    estimate: Estimate
    p_factor: float = 1.0
    p_standard_error: float = 0.0
    correlation: float = np.nan


def fit_half_periods(
    impacts: Array, covariance: Array, first_side: int, block: Block, *, free_p: bool = False, level: float = 0.95
) -> HalfPeriods:
    """
    Identify e from the times of successive impacts.

    Parameters
    ----------
    impacts : ndarray, shape (n,)
        Times at which the angle passes zero, s; none left out between the first and the last.
    covariance : ndarray, shape (n, n)
        Of these, s².
    first_side : int
        Of the arc after the first: 0 for θ < 0, 1 for θ > 0.
    block : Block
    free_p : bool
        Whether p is identified too, if its standard error is then at most `LARGEST_ERROR_OF_P`.
    level : float

    Returns
    -------
    half_periods : HalfPeriods

    Notes
    -----
    The time between two impacts says how high the arc between them was (exact period of the nonlinear equation), and
    successive heights say e. Unknowns are ln e, the first arc's height and time, and a zero offset, that moves
    successive zeros to opposite sides by offset / velocity. e and p are correlated by 0.95 to 0.999: all arcs scale
    with 1/p, and only that large ones are longer than small ones by another law tells the two apart.
    """
    if impacts.size < len(ALWAYS) + FEWEST_SPARE or not np.isfinite(impacts).all():
        reason = f"{impacts.size} impacts in a row are too few; {len(ALWAYS) + FEWEST_SPARE} are needed."
        return HalfPeriods(Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason))
    try:
        whitener = np.linalg.inv(np.linalg.cholesky(covariance))
    except np.linalg.LinAlgError:
        reason = "The errors of the impacts' times are not known."
        return HalfPeriods(Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason))
    fixed = _fit(impacts, whitener, first_side, block, ALWAYS)
    correlation = np.nan
    if free_p and fixed is not None and impacts.size > len(ALWAYS) + FEWEST_SPARE:
        freed = _fit(impacts, whitener, first_side, block, (*ALWAYS, "p"), fixed[0])
        if freed is not None:
            spread = freed[1]
            correlation = float(spread[0, 4] / sqrt(spread[0, 0] * spread[4, 4]))
            error = sqrt(spread[4, 4])
            if error <= LARGEST_ERROR_OF_P:
                said = f"{ASSUMPTIONS}; p freed: {exp(freed[0].values['p']):.4f} ± {error:.4f} of the block's, "
                said += f"correlation with e {correlation:.3f}"
                factor = exp(freed[0].values["p"])
                return HalfPeriods(_estimate(*freed, impacts.size, level, said), factor, error, correlation)
    if fixed is None:
        reason = "No e and no height of the first arc give such times between impacts."
        return HalfPeriods(Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason))
    estimate = _estimate(*fixed, impacts.size, level, f"{ASSUMPTIONS}; the block's p")
    return HalfPeriods(estimate, correlation=correlation)


def _estimate(decay: Decay, covariance: Array, count: int, level: float, assumptions: str) -> Estimate:
    error, logarithm = sqrt(covariance[0, 0]), decay.values["restitution"]
    half = float(stats.t.ppf((1 + level) / 2, count - covariance.shape[0])) * error
    low, value, high = (exp(bound) for bound in (logarithm - half, logarithm, logarithm + half))
    return Estimate(NAME, value, low, high, value * error, level, assumptions)


def _fit(
    impacts: Array, whitener: Array, first_side: int, block: Block, names: tuple[str, ...], start: Decay | None = None
) -> tuple[Decay, Array] | None:
    """Least squares (Gauss and Newton); the decay and the covariance of its unknowns, None where there is no decay."""
    decay = start or _first_guess(impacts, first_side, block)
    times = _times(decay)
    if not np.isfinite(times).all():
        return None
    for _ in range(MOST_STEPS):
        residual = whitener @ (impacts - times)
        jacobian = whitener @ _jacobian(decay, names)
        scale = np.sqrt((jacobian**2).sum(axis=0))
        if not (np.isfinite(jacobian).all() and (scale > 0).all()):
            return None
        step = np.linalg.lstsq(jacobian / scale, residual, rcond=None)[0] / scale
        for halving in range(12):
            moved = decay.moved(dict(zip(names, (0.5**halving * step).tolist(), strict=True)))
            there = _times(moved)
            if np.isfinite(there).all() and ((whitener @ (impacts - there)) ** 2).sum() <= residual @ residual:
                break
        else:
            break
        gained = float(residual @ residual) - float(((whitener @ (impacts - there)) ** 2).sum())
        decay, times = moved, there
        if gained < 1e-6 * max(float(residual @ residual), 1e-12):
            break
    residual = whitener @ (impacts - times)
    jacobian = whitener @ _jacobian(decay, names)
    scale = np.sqrt((jacobian**2).sum(axis=0))
    if not (np.isfinite(scale).all() and (scale > 0).all()):
        return None
    covariance = np.linalg.pinv((jacobian / scale).T @ (jacobian / scale)) / np.outer(scale, scale)
    scatter = float(residual @ residual) / (impacts.size - len(names))
    return decay, covariance * max(scatter, 1.0)


def _first_guess(impacts: Array, first_side: int, block: Block) -> Decay:
    """Return the decay whose heights have the durations that were seen, with the e of their energies."""
    sides = (block.negative, block.positive)
    durations = np.diff(impacts)
    along = [sides[(first_side + n) % 2] for n in range(durations.size)]
    heights = np.array(
        [
            _height(duration * block.side_p(side) / 2, side.critical_angle)
            for duration, side in zip(durations, along, strict=True)
        ]
    )
    energy = np.log(heights * (2 - heights))
    slope, _ = np.polyfit(np.arange(heights.size), energy, 1, w=heights)
    values = {
        "restitution": log(min(max(exp(slope / 2), 0.3), 0.9999)),
        "peak": float(heights[0] * sides[first_side].critical_angle),
        "time": float(impacts[0] + durations[0] / 2),
        "zero_offset": 0.0,
        "critical_angle": 0.0,
        "p": 0.0,
    }
    return Decay(values, first_side, durations.size, block, linearised=False)


def _height(phase: float, critical: float) -> float:
    """|θ|/α of the arc that lasts 2 phase / p (by bisection of the exact duration)."""
    low, high = 1e-6, 1 - 1e-9
    for _ in range(50):
        middle = 0.5 * (low + high)
        if half_duration(middle * critical, critical, False) < phase:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _times(decay: Decay) -> Array:
    """Times at which the angle, seen with the zero offset, passes zero; shape (count + 1,)."""
    peaks, times, ends = decay.arcs()
    impacts = np.concatenate(([2 * times[0] - ends[0]], ends))
    side = (decay.side + np.arange(decay.count)) % 2
    speed = decay.p[side] * np.sqrt(4 * np.sin(decay.critical[side] - peaks / 2) * np.sin(peaks / 2))
    ending = np.concatenate(([speed[0] / exp(decay.values["restitution"])], speed))
    # The block comes down from the side of the arc that ends: at the first impact from the other side.
    sign = np.concatenate(([1.0 - 2 * side[0]], 2.0 * side - 1))
    return np.asarray(impacts + sign * decay.values["zero_offset"] / ending)


def _jacobian(decay: Decay, names: tuple[str, ...]) -> Array:
    columns = []
    for name in names:
        step = 1e-6 * (decay.values["peak"] if name in ("peak", "zero_offset") else 1.0)
        columns.append((_times(decay.moved({name: step})) - _times(decay.moved({name: -step}))) / (2 * step))
    return np.column_stack(columns)
