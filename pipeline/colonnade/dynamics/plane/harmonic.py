"""One harmonic base motion on one block, without sampling that motion."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, hypot, inf, isfinite, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models import DEFAULT, plane_model_of
from colonnade.dynamics.plane.run import OUTCOMES
from colonnade.dynamics.restitution_law import Given, Restitution, law_of

if TYPE_CHECKING:
    from colonnade.dynamics.plane.march import Forcing

SAMPLES_A_CYCLE = 100
"""Samples of a sine for models without harmonic kernels, linear between them: error at most 5e-4 of its amplitude."""


@dataclass(frozen=True)
class Harmonic:
    """
    A base motion a(t) = A g tan α · l(t) sin(ω t + phase), from rest at t = 0 and followed by none.

    Attributes
    ----------
    omega : float
        ω, rad/s; 0 for a constant, with phase = π/2.
    phase : float
        rad.
    edges : tuple of float
        s: end of the linear rise of l from 0 to 1, of its constant part, and of its fall; equal ones leave a part out.
    """

    omega: float
    phase: float
    edges: tuple[float, float, float]

    @classmethod
    def cycles(cls, omega: float, cycles: float, *, phase: float = 0.0, ramp: float = 0.0) -> Harmonic:
        """Whole or broken cycles at full amplitude between a rise and a fall of `ramp` cycles each."""
        period = 2 * pi / omega
        edges = (ramp * period, (ramp + cycles) * period, (2 * ramp + cycles) * period)
        return cls(omega, phase, edges)

    def level(self, time: Array) -> Array:
        """Give l at times up to its end, s."""
        rise, full, end = self.edges
        level = np.ones_like(time)
        if rise > 0.0:
            level = np.minimum(level, time / rise)
        if end > full:
            level = np.minimum(level, (end - time) / (end - full))
        return level

    def sampled(self, largest: float) -> tuple[Array, float]:
        """Sample it with its largest acceleration (m/s²), shape (n,), and give the sampling interval, s."""
        end = self.edges[2]
        count = max(ceil(end * self.omega / (2 * pi) * SAMPLES_A_CYCLE), 1)
        time = end / count * np.arange(count + 1.0)
        return largest * np.append(self.level(time) * np.sin(self.omega * time + self.phase), 0.0), end / count

    def forcing(self, *times: float) -> Forcing:
        """Put it into the form that the kernels take, with knots at some times (s) too."""
        from colonnade.dynamics.plane.march import NONE, Forcing

        knots = np.unique([0.0, *self.edges, *(time for time in times if time < self.edges[2])])
        return Forcing(self.omega, self.phase, 0.0, knots, self.level(knots), NONE)


@dataclass(frozen=True)
class HarmonicRun:
    """
    What one run gives.

    Attributes
    ----------
    outcome : str
        Of `OUTCOMES`.
    peak_ratio : float
        Largest |θ|/α under the motion up to overturning, from the time asked for on.
    angle, angular_velocity : ndarray, shape (n,)
        rad, rad/s, at the samples asked for; 0 after the motion's end, unless the block lies.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    """

    outcome: str
    peak_ratio: float
    angle: Array
    angular_velocity: Array
    impact_times: Array
    impact_velocities: Array


def restitution_up_to(block: Block, restitution: Given, amplitude_ratio: float) -> Restitution:
    """
    Put e into the form that the kernels take: a function is sampled as far as impacts can go.

    Parameters
    ----------
    block : Block
    restitution : float, pair of float, RestitutionLaw or function, optional
        As of `rock`.
    amplitude_ratio : float
        Largest A that the base motion comes to.

    Raises
    ------
    ValueError
        If e is not between 0 and 1.

    Notes
    -----
    With q the largest a/g, no impact of a block that has not overturned is faster than p (α + q) in the linear model,
    whose S = h' − (h − α) obeys S' = −S − q sin φ; nor, in the nonlinear one, than the fall from α + atan q inwards
    under −q throughout, ω²/p² = 2 (sqrt(1 + q²) − cos α + q sin α).
    """
    q, speeds = amplitude_ratio * tan(block.critical_angle), []
    for side in block.sides:
        alpha = side.critical_angle
        fall = 2.0 * (hypot(1.0, q) - cos(alpha) + q * sin(alpha))
        speeds.append(block.side_p(side) * max(alpha + q, fall**0.5))
    return law_of(block, restitution, max(speeds))


def harmonic_run(
    block: Block,
    motion: Harmonic,
    amplitude_ratio: float,
    restitution: Given,
    *,
    model: str = DEFAULT,
    samples: int = 0,
    interval: float = 1.0,
    peaks_from: float = 0.0,
) -> HarmonicRun:
    """
    Run a block from rest under a harmonic motion, without sampling that motion.

    Parameters
    ----------
    block : Block
    motion : Harmonic
    amplitude_ratio : float
        A = a / (g tan α).
    restitution : float, pair of float, RestitutionLaw or function
        As of `rock`; None for the rigid-body value.
    model : str, optional
        A plane one.
    samples : int, optional
        Number of samples of the history wanted, at `interval` (s) from time 0.
    interval : float, optional
    peaks_from : float, optional
        s, from when on `peak_ratio` counts.

    Raises
    ------
    ValueError
        If A is not positive, e is not between 0 and 1 or the model is not known.
    """
    # Its kernels are compiled on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    chosen = plane_model_of(model)
    if not (isfinite(amplitude_ratio) and amplitude_ratio > 0):
        raise ValueError(f"amplitude_ratio is {amplitude_ratio}; a positive number was expected")
    times = interval * np.arange(samples)
    forcing = motion.forcing(peaks_from, *times)
    levels = forcing.levels * (amplitude_ratio * tan(block.critical_angle))
    sides = sides_of(block, restitution_up_to(block, restitution, amplitude_ratio))
    since = int(np.searchsorted(forcing.times, peaks_from))
    angles, velocities, impact_times, impact_velocities, end = propagate(
        forcing._replace(levels=levels), sides, is_linearised=chosen.is_linearised, since=since, floor=inf
    )
    history, under = np.zeros((2, samples)), times <= motion.edges[2]
    history[:, under] = np.stack([angles, velocities])[:, np.searchsorted(forcing.times, times[under])]
    if abs(angles[-1]) >= 0.5 * pi:
        history[0, ~under] = angles[-1]
    outcome = OUTCOMES[2 if np.isfinite(end.time) else 1 if end.peak > NO_ROCKING_RATIO else 0]
    return HarmonicRun(outcome, end.peak, history[0], history[1], impact_times, impact_velocities)


def harmonic_outcomes(
    block: Block, motion: Harmonic, amplitude_ratio: Array, restitution: Restitution, model: str
) -> Codes:
    """Outcomes of many A under one motion, indices into `OUTCOMES`, shape (n,)."""
    from colonnade.dynamics.plane.march import column
    from colonnade.dynamics.plane.series import empty_series
    from colonnade.dynamics.plane.sides import sides_of

    scales = amplitude_ratio * tan(block.critical_angle)
    sides = sides_of(block, restitution)
    work = None if plane_model_of(model).is_linearised else empty_series()
    return column(motion.forcing(), scales, sides, NO_ROCKING_RATIO, work)
