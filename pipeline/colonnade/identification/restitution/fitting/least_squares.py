"""Least squares of a free rocking's unknowns on the samples of a record."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.identification.restitution.arcs.rocking_arc import normal_equations
from colonnade.identification.restitution.fitting.free_decay import Decay
from colonnade.identification.restitution.fitting.noise import passed_power

MOST_STEPS = 25
CONVERGED = 1e-4
"""The sum of squares is at its least where the next step promises less than this share of one sample's mean square."""

MOST_HALVINGS = 8
ABOUT_FILTER = 4.0
"""Of 1 / cut-off: samples on either side of the fitted ones that the filter's effect is computed with."""

SINGULAR = 1e12
"""Largest element of the inverse of the scaled normal equations with which the unknowns can be separated."""

FINEST = 8
"""Most points that represent the recorded samples averaged in one."""


@dataclass(frozen=True)
class Stretch:
    """
    The samples that are fitted.

    Attributes
    ----------
    time, angle : ndarray, shape (n,)
        s, rad; NaN where not counted.
    cutoff_hz : float or None
        Low-pass of the record: the model is filtered in the same way.
    interval : float or None
        s.
    group : int
        Recorded samples averaged in each.
    margin : float
        s; samples this near to an impact are not counted.
    """

    time: Array
    angle: Array
    cutoff_hz: float | None = None
    interval: float | None = None
    group: int = 1
    margin: float = 0.0


@dataclass(frozen=True)
class DecayFit:
    """
    A decay that follows a record as closely as its unknowns allow.

    Attributes
    ----------
    decay : Decay
    angle, residual : ndarray, shape (n,)
        rad; residual NaN where not counted.
    sensitivity : ndarray, shape (n, 5)
        Of the angle to the unknowns of its arc.
    arc : ndarray of int, shape (n,)
        Number of the arc of each sample.
    products, gradients : ndarray, shape (m, 5, 5), (m, 5)
        Sums over each arc, of sensitivities and of these with residuals.
    gradient : ndarray, shape (k,)
        Jᵀ times the residuals.
    inverse : ndarray, shape (k, k)
        Of JᵀJ.
    mean_square : float
        Of the residuals, rad².
    """

    decay: Decay
    angle: Array
    residual: Array
    sensitivity: Array
    arc: NDArray[np.int64]
    products: Array
    gradients: Array
    gradient: Array
    inverse: Array
    mean_square: float

    def jacobian(self, names: tuple[str, ...]) -> Array:
        """Derivatives of the angle by the unknowns named, shape (n, k); zero where a sample is not counted."""
        derivatives = self.decay.derivatives(names)
        jacobian = np.empty((self.arc.size, len(names)))
        for column in range(len(names)):
            jacobian[:, column] = (self.sensitivity * derivatives[self.arc, :, column]).sum(axis=1)
        jacobian[~np.isfinite(self.residual)] = 0.0
        return jacobian


class UnfollowedError(Exception):
    """No decay of this kind follows the record."""


def fit_decay(decay: Decay, stretch: Stretch, names: tuple[str, ...]) -> DecayFit:
    """
    Move a decay's unknowns to the least sum of squares (Gauss and Newton, steps halved where they lead up).

    Parameters
    ----------
    decay : Decay
        Where to start: near enough that each impact is within part of an arc of its place.
    stretch : Stretch
    names : tuple of str
        Of the unknowns that are moved.

    Raises
    ------
    UnfollowedError
        If the unknowns are not determined, or lead to where the block overturns.
    """
    here = _evaluated(decay, stretch, names)
    for _ in range(MOST_STEPS):
        step = here.inverse @ here.gradient
        if float(here.gradient @ step) < CONVERGED * here.mean_square:
            return here
        for halving in range(MOST_HALVINGS):
            tried = decay.moved(dict(zip(names, (0.5**halving * step).tolist(), strict=True)))
            try:
                there = _evaluated(tried, stretch, names)
            except UnfollowedError:
                continue
            if there.mean_square < here.mean_square * (1 + 1e-9):
                break
        else:
            return here
        decay, here = tried, there
    return here


def closest_cutoff(decay: Decay, stretch: Stretch, cutoff_hz: float) -> float:
    """Return the cut-off about the given one (Hz) with which the filtered decay is closest to the record."""
    if stretch.interval is None:
        return cutoff_hz
    sharp, _, _ = decay.angle(stretch.time)
    step, best = 1.3, cutoff_hz
    for _ in range(4):
        cutoffs = best * step ** np.arange(-3.0, 4.0)
        cutoffs = cutoffs[cutoffs < 0.49 / stretch.interval]
        squares = [
            float(np.nanmean((stretch.angle - sharp - blur(decay, replace(stretch, cutoff_hz=each))) ** 2))
            for each in cutoffs.tolist()
        ]
        best, step = float(cutoffs[int(np.argmin(squares))]), step**0.4
    return best


def _evaluated(decay: Decay, stretch: Stretch, names: tuple[str, ...]) -> DecayFit:
    peaks, _, ends = decay.arcs()
    if not np.isfinite(peaks).all():
        raise UnfollowedError("the block would overturn")
    angle, sensitivity, arc = decay.angle(stretch.time)
    seen = angle if stretch.cutoff_hz is None else angle + blur(decay, stretch)
    residual = stretch.angle - seen
    if stretch.margin > 0:
        residual = np.where(nearest(stretch.time, ends) < stretch.margin, np.nan, residual)
    counted = np.isfinite(residual)
    if counted.sum() <= 2 * len(names):
        raise UnfollowedError("too few samples")
    products, gradients = normal_equations(sensitivity, residual, arc, decay.count)
    derivatives = decay.derivatives(names)
    normal = (derivatives.transpose(0, 2, 1) @ products @ derivatives).sum(axis=0)
    scale = np.sqrt(np.diag(normal))
    if not (np.isfinite(scale).all() and (scale > 0).all()):
        raise UnfollowedError("an unknown has no effect")
    scaled = normal / np.outer(scale, scale)
    try:
        inverse = np.linalg.inv(scaled)
    except np.linalg.LinAlgError:
        inverse = np.full(scaled.shape, np.inf)
    if not np.abs(inverse).max() < SINGULAR:
        raise UnfollowedError("the record does not separate the unknowns")
    gradient = np.asarray((derivatives.transpose(0, 2, 1) @ gradients[:, :, None]).sum(axis=0)[:, 0])
    inverse /= np.outer(scale, scale)
    power = float(residual[counted] @ residual[counted]) / int(counted.sum())
    return DecayFit(decay, seen, residual, sensitivity, arc, products, gradients, gradient, inverse, power)


def nearest(time: Array, ends: Array) -> Array:
    """Return the time from each of `time` to the nearest end of an arc, s."""
    after = np.clip(np.searchsorted(ends, time), 1, ends.size - 1)
    return np.minimum(np.abs(time - ends[after - 1]), np.abs(time - ends[after]))


def blur(decay: Decay, stretch: Stretch) -> Array:
    """Filtered less unfiltered angle, rad: what the low-pass does to the corners at impacts."""
    if stretch.cutoff_hz is None or stretch.interval is None:
        return np.zeros(stretch.time.size)
    # On the clock of the recording, or nearly: corners hold frequencies far above those of the samples fitted.
    finer = min(stretch.group, FINEST)
    step, extra = stretch.interval / finer, int(ABOUT_FILTER / (stretch.cutoff_hz * stretch.interval)) + 1
    count = (stretch.time.size + 2 * extra) * finer
    time = stretch.time[0] - extra * stretch.interval + step * (np.arange(count) - 0.5 * (finer - 1))
    wider = replace(decay, count=decay.count + 2)
    angle = wider.angle_alone(time)
    smooth = _filtered(angle, step, stretch.cutoff_hz, stretch.interval / stretch.group)
    rounded = (smooth - angle).reshape(-1, finer).mean(axis=1)
    return np.asarray(rounded[extra:-extra])


def _filtered(angle: Array, step: float, cutoff_hz: float, recorded_step: float) -> Array:
    """Zero-phase low-pass in the frequency domain; beyond its ends the record goes on about a straight line."""
    from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

    size = next_fast_len(angle.size, real=True)
    line = np.linspace(angle[0], angle[-1], angle.size)
    transform = rfft(angle - line, n=size) * np.sqrt(passed_power(rfftfreq(size, step), cutoff_hz, recorded_step))
    return np.asarray(line + irfft(transform, n=size)[: angle.size])
