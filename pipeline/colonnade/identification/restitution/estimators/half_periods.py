"""Coefficient of restitution from the times between impacts alone: no angle has to be calibrated."""

from __future__ import annotations

from math import exp, sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.rocking_arc import peak_of_duration
from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, Decay, first_values
from colonnade.identification.restitution.fitting.mixture import Mean, mean_of_student
from colonnade.identification.restitution.free_vibration import FreeVibration

FEWEST_SPARE = 2
"""Impacts beyond the number of unknowns."""

LOWEST, HIGHEST = 1e-6, 1 - 1e-9
"""Of α: bounds of the peaks to start from, that are hardly ever reached."""

MOST_STEPS = 30
LARGEST_ERROR_OF_P = 0.01
"""Standard error of ln p up to which p is freed if asked for."""


class HalfPeriods(Estimator[Fit]):
    """
    e from the times of successive impacts.

    Notes
    -----
    The time between two impacts says how high the arc between them was (exact period of the nonlinear equation), and
    successive heights say e. Unknowns are ln e, the first arc's height and time, and a zero offset, that moves
    successive zeros to opposite sides by offset / velocity. e and p are correlated by 0.95 to 0.999: all arcs scale
    with 1/p, and only that large ones are longer than small ones by another law separates the two.
    """

    name = "half-periods"
    label = "half-periods"
    assumptions = (
        "plane rocking without slide or bounce; one e for all impacts; the block's critical angles; both sides about "
        "one zero; the angle's scale does not enter"
    )
    description = "the times between impacts, which need no calibration of the angle, but the block's p and α"

    def fit(self, record: FreeVibration) -> Fit:
        """Fit the first impacts that all have a time with an error."""
        impacts, covariance = record.arcs.impacts
        first, angle = record.left_out, record.followed_arcs.peak_angle
        missing = np.flatnonzero(~np.isfinite(np.diag(covariance)[first:]))
        row = slice(first, first + int(missing[0]) if missing.size else None)
        first_side = int(np.nanmedian(angle * (-1.0) ** np.arange(angle.size)) > 0)
        return self.fit_times(
            impacts[row], covariance[row, row], first_side, record.block, free_p="p" in record.free, level=record.level
        )

    def fit_times(
        self,
        impacts: Array,
        covariance: Array,
        first_side: int,
        block: Block,
        *,
        free_p: bool = False,
        level: float = 0.95,
    ) -> Fit:
        """
        Identify e from times of impact alone.

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
        """
        if impacts.size < len(ALWAYS) + FEWEST_SPARE or not np.isfinite(impacts).all():
            reason = f"{len(ALWAYS) + FEWEST_SPARE} impacts in a row are needed; the record has {impacts.size}."
            return self.refuse(level, reason)
        try:
            whitener = np.linalg.inv(np.linalg.cholesky(covariance))
        except np.linalg.LinAlgError:
            return self.refuse(level, "The errors of the impacts' times are not known.")
        fixed = _fit(impacts, whitener, first_side, block, ALWAYS)
        if fixed is None:
            return self.refuse(level, "No value of e and of the first peak gives these times between impacts.")
        if free_p and impacts.size > len(ALWAYS) + FEWEST_SPARE:
            freed = _fit(impacts, whitener, first_side, block, (*ALWAYS, "p"), fixed[0])
            if freed is not None:
                decay, covariance = freed
                error = sqrt(covariance[4, 4])
                if error <= LARGEST_ERROR_OF_P:
                    factor = exp(decay.values["p"])
                    correlation = covariance[0, 4] / sqrt(covariance[0, 0] * covariance[4, 4])
                    said = f"p freed: {factor:.4f} ± {error:.4f} of the block's, correlation with e {correlation:.3f}"
                    return Fit(self.estimate_of(_mean(*freed, impacts.size, level), level, freed=said))
        return Fit(self.estimate_of(_mean(*fixed, impacts.size, level), level, freed="the block's p"))


def _mean(decay: Decay, covariance: Array, count: int, level: float) -> Mean:
    freedom = count - covariance.shape[0]
    return mean_of_student(decay.values["restitution"], sqrt(covariance[0, 0]), freedom, level)


def _fit(
    impacts: Array, whitener: Array, first_side: int, block: Block, names: tuple[str, ...], start: Decay | None = None
) -> tuple[Decay, Array] | None:
    """Least squares (Gauss and Newton); the decay and the covariance of its unknowns; None if no decay fits."""
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
    durations = np.diff(impacts)
    along = [block.sides[(first_side + n) % 2] for n in range(durations.size)]
    phases = [duration * block.side_p(side) / 2 for duration, side in zip(durations.tolist(), along, strict=True)]
    critical = np.array([side.critical_angle for side in along])
    low, high = LOWEST * critical, HIGHEST * critical
    heights = np.array(list(map(peak_of_duration, phases, critical, low, high))) / critical
    peak, time = heights[0] * critical[0], impacts[0] + durations[0] / 2
    values = first_values(heights * (2 - heights), heights, peak=float(peak), time=float(time))
    return Decay(values, first_side, durations.size, block, linearised=False)


def _times(decay: Decay) -> Array:
    """Times at which the angle, seen with the zero offset, passes zero; shape (count + 1,)."""
    _, times, ends = decay.arcs()
    impacts = np.concatenate(([2 * times[0] - ends[0]], ends))
    speed = decay.landing_speeds()
    ending = np.concatenate(([speed[0] / exp(decay.values["restitution"])], speed))
    # The block comes down from the side of the arc that ends: at the first impact from the other side.
    sign = np.concatenate(([1.0 - 2 * decay.side], 2.0 * decay.sides - 1))
    return np.asarray(impacts + sign * decay.values["zero_offset"] / ending)


def _jacobian(decay: Decay, names: tuple[str, ...]) -> Array:
    columns = []
    for name in names:
        if name == "time":
            columns.append(np.ones(decay.count + 1))
            continue
        step = 1e-6 * (decay.values["peak"] if name in ("peak", "zero_offset") else 1.0)
        columns.append((_times(decay.moved({name: step})) - _times(decay.moved({name: -step}))) / (2 * step))
    return np.column_stack(columns)
