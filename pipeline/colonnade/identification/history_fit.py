"""Coefficient of restitution from the whole history of a free vibration: simulated rocking fitted to the angle."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, hypot, isfinite, log, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize, stats

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution import Restitution

Array = NDArray[np.float64]

METHOD = "whole history: simulated rocking, least squares, errors that allow for residuals correlated from arc to arc"

POINTS_PER_UNIT = 20
"""Points fitted in each 1/p of time: an arc of usual height has some 30."""

FEWEST_ARCS = 6

STRETCHES = 3
"""Stretches of the record whose residuals are taken as independent of each other."""

DISAGREEMENT = 3.0
"""Standard errors, of both together, beyond which this value and that of the peaks disagree, ..."""

NEGLIGIBLE = 0.01
"""... if the difference is more than this share of the loss 1 − e: a smaller one changes no prediction."""


@dataclass(frozen=True)
class HistoryFit:
    """
    e of a whole history by one model, or the reason why there is none.

    Attributes
    ----------
    model : str
    value, low, high, standard_error : float or None
        e and its interval of confidence at the level of the peaks' result; None where refused.
    residual : float or None
        RMS of measured − simulated over the fitted part, rad.
    start, stop : float or None
        s, the fitted part: from the first used peak to the last.
    reason : str
        Why refused; empty otherwise.
    """

    model: str
    value: float | None = None
    low: float | None = None
    high: float | None = None
    standard_error: float | None = None
    residual: float | None = None
    start: float | None = None
    stop: float | None = None
    reason: str = ""

    def disagreement(self, peaks: Restitution) -> str:
        """Say by how much the value is off that of the peaks, where this is beyond their errors; else nothing."""
        if self.value is None or self.standard_error is None or peaks.value is None or peaks.standard_error is None:
            return ""
        difference, error = self.value - peaks.value, hypot(self.standard_error, peaks.standard_error)
        if abs(difference) <= max(DISAGREEMENT * error, NEGLIGIBLE * (1 - peaks.value)):
            return ""
        return (
            f"The whole history gives e = {self.value:.5f} ({self.model} model), the peaks {peaks.value:.5f}: "
            f"{abs(difference) / error:.2g} standard errors apart; at most {DISAGREEMENT:g} were expected. The times "
            "of impact are not quite those of this block: look at its dimensions and mass, and for slide or rotation "
            "out of plane. The value of the peaks is used."
        )


def fit_history(
    time: ArrayLike, angle: ArrayLike, block: Block, peaks: Restitution, *, model: str = "nonlinear"
) -> HistoryFit:
    """
    Identify e as the value with which simulated free rocking follows the measured angle most closely.

    Parameters
    ----------
    time, angle : array_like, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
        Its critical angles and p are taken as given.
    peaks : Restitution
        Of the same record by its peaks: where to start, and which part to fit.
    model : {"linear", "nonlinear"}

    Returns
    -------
    fit : HistoryFit

    Notes
    -----
    Fitted are e, the angle and velocity at the first used peak, and the zero offset; nothing holds e to the rigid-body
    value. The times of the impacts weigh most: a wrong p or critical angle, a drifting zero or three-dimensional
    rocking enter e here, where the peaks hardly see them, so that a difference between the two is a finding.

    Residuals of such a fit last for arcs. The standard error is a sandwich's: scores summed over each arc, and Bartlett
    weights over the following third of the arcs (Newey and West 1987, with arcs for samples) where these add to it.
    Three such stretches are in the record, so Student's t has three degrees of freedom; this makes up for residuals
    being smaller than errors.

    Each impact's own e, where it varies, is carried along by all later impacts' times. What this adds is seen in the
    residuals only in part; the interval of the peaks, which has a term for it, is the wider one then.
    """
    if peaks.value is None:
        return HistoryFit(model, reason="The peaks give no value to start from.")
    used = np.flatnonzero(peaks.peaks.used)
    if used.size < FEWEST_ARCS:
        return HistoryFit(model, reason=f"{used.size} arcs are too few; at least {FEWEST_ARCS} are needed.")
    times, angles = np.asarray(time, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    start, stop = (float(peaks.peaks.time[used[index]]) for index in (0, -1))
    kept = np.isfinite(angles) & (times >= start) & (times <= stop)
    times, angles = times[kept], angles[kept]
    if times.size < 4 * used.size:
        return HistoryFit(model, reason=f"{times.size} samples for {used.size} arcs are too few.")
    thinned = slice(None, None, max(int(times.size / ((stop - start) * block.p * POINTS_PER_UNIT)), 1))
    times, angles = times[thinned] - start, angles[thinned]
    simulated = _Simulation(block, model, times)
    peak = float(peaks.peaks.angle[used[0]])
    scale = np.array([1.0, abs(peak), block.p * abs(peak), abs(peak)])
    parameters = np.array([log(peaks.value), peak / scale[1], 0.0, peaks.zero_offset / scale[3]])
    solution = optimize.least_squares(
        lambda x: simulated(x * scale) - angles,
        parameters,
        x_scale=np.array([1e-2, 1e-1, 1e-1, 1e-2]),
        diff_step=1e-6,
        method="trf",
        max_nfev=40,
    )
    residuals = np.asarray(solution.fun, dtype=np.float64)
    rms = float(np.sqrt(np.mean(residuals**2)))
    if not solution.success or rms > 0.5 * float(np.std(angles)):
        return HistoryFit(
            model,
            residual=rms,
            start=start,
            stop=stop,
            reason=f"No simulated history follows the record: {rms / block.critical_angle:.2g} α is left over.",
        )
    arc = np.searchsorted(peaks.peaks.time[used], times + start, side="right")
    error = _sandwich(np.asarray(solution.jac), residuals, arc)
    half = float(stats.t.ppf((1 + peaks.level) / 2, STRETCHES)) * error
    low, value, high = (exp(bound) for bound in (solution.x[0] - half, solution.x[0], solution.x[0] + half))
    if not all(isfinite(bound) for bound in (low, value, high)):
        return HistoryFit(model, residual=rms, start=start, stop=stop, reason="The fit gives no finite interval.")
    return HistoryFit(model, value, low, high, value * error, rms, start, stop)


class _Simulation:
    """Free rocking at given times from ln e, angle, velocity (rad, rad/s) and zero offset (rad)."""

    def __init__(self, block: Block, model: str, time: Array) -> None:
        self._block, self._model, self._time = block, model, time
        self._duration = float(time[-1])
        # Interpolation between steps errs by h² θ̈ / 8: with 60 steps in each 1/p by 3e-5 of α.
        self._motion = Motion(np.zeros(int(self._duration * block.p * 60) + 2), 1.0 / (60 * block.p))

    def __call__(self, parameters: Array) -> Array:
        restitution, angle, velocity, offset = parameters
        history = rock(
            self._block,
            self._motion,
            restitution=min(exp(restitution), 1.0),
            model=self._model,
            theta0=float(angle),
            omega0=float(velocity),
        )
        return np.asarray(np.interp(self._time, history.time, history.angle) + offset)


def _sandwich(jacobian: Array, residuals: Array, arc: NDArray[np.int_]) -> float:
    """Standard error of the first parameter; `arc` numbers the arc of each residual."""
    scores = np.array([jacobian[arc == number].T @ residuals[arc == number] for number in np.unique(arc)])
    count, parameters = scores.shape
    bread = np.linalg.pinv(jacobian.T @ jacobian)
    # The part of each arc in the error of the first parameter.
    parts = scores @ bread[0]
    alone = float(parts @ parts)
    reach = count // STRETCHES
    shared = sum(2 * (1 - lag / reach) * float(parts[lag:] @ parts[:-lag]) for lag in range(1, reach))
    return sqrt(max(alone, alone + shared) * count / max(count - parameters, 1))
