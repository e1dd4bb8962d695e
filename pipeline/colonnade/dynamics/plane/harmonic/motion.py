"""One harmonic base motion on one block, by the kernels of either model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, inf, isfinite, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models.registry import DEFAULT, plane_model_of
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.validation import sided

if TYPE_CHECKING:
    from colonnade.dynamics.plane.harmonic.nonlinear import Series
    from colonnade.dynamics.plane.sides import Sides

Restitution = tuple[float, float] | RestitutionLaw
"""e of impacts that end an arc at θ < 0, and at θ > 0; or e over the speed of the impact."""

OUTCOMES = ("no-rocking", "rocking", "overturned")
"""What the codes 0, 1 and 2 mean."""


@dataclass(frozen=True)
class Harmonic:
    """
    A base motion a(t) = A g tan α · l(t) sin(ω t + phase), from rest at t = 0 and followed by none.

    Attributes
    ----------
    omega : float
        ω, rad/s.
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
        rad, rad/s, at the samples asked for.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    """

    outcome: str
    peak_ratio: float
    angle: Array
    angular_velocity: Array
    impact_times: Array
    impact_velocities: Array


def restitution_up_to(
    block: Block, restitution: Sided | RestitutionLaw | Callable[[float], float] | None, amplitude_ratio: float
) -> Restitution:
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
    if restitution is None:
        return pair(block.restitution)
    if isinstance(restitution, RestitutionLaw):
        return restitution
    if callable(restitution):
        q = amplitude_ratio * tan(block.critical_angle)
        speeds = []
        for side in (block.negative, block.positive):
            alpha = side.critical_angle
            fall = 2.0 * (hypot(1.0, q) - cos(alpha) + q * sin(alpha))
            speeds.append(block.side_p(side) * max(alpha + q, fall**0.5))
        return RestitutionLaw.of(restitution, largest_speed=max(speeds))
    return sided("restitution", restitution, "a number between 0 and 1", low=0.0, high=1.0)


def harmonic_run(
    block: Block,
    motion: Harmonic,
    amplitude_ratio: float,
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None,
    *,
    model: str = DEFAULT,
    samples: int = 0,
    interval: float = 1.0,
    peaks_from: float = 0.0,
    largest_count: int = 4096,
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
    largest_count : int, optional
        Impacts kept.

    Raises
    ------
    ValueError
        If A is not positive, e is not between 0 and 1 or the model is not known.
    """
    # Its kernels are compiled on import.
    from colonnade.dynamics.plane.harmonic.march import Watch, run

    plane_model_of(model)
    if not (isfinite(amplitude_ratio) and amplitude_ratio > 0):
        raise ValueError(f"amplitude_ratio is {amplitude_ratio}; a positive number was expected")
    history, impacts = np.zeros((samples, 2)), np.zeros((largest_count, 2))
    e = restitution_up_to(block, restitution, amplitude_ratio)
    edges, sides, work = _settings(block, motion, e, model)
    forcing = (motion.omega, motion.phase, amplitude_ratio * tan(block.critical_angle))
    watch = Watch(peaks_from, inf, interval, history, impacts)
    overturned, peak, count = run(forcing, edges, sides, watch, work)
    outcome = OUTCOMES[2 if overturned else 1 if peak > NO_ROCKING_RATIO else 0]
    kept = impacts[: min(count, largest_count)]
    return HarmonicRun(outcome, peak, history[:, 0], history[:, 1], kept[:, 0], kept[:, 1])


def harmonic_outcomes(
    block: Block, motion: Harmonic, amplitude_ratio: Array, restitution: Restitution, model: str
) -> Codes:
    """Outcomes of many A under one motion, indices into `OUTCOMES`, shape (n,)."""
    from colonnade.dynamics.plane.harmonic.march import column

    levels = amplitude_ratio * tan(block.critical_angle)
    edges, sides, work = _settings(block, motion, restitution, model)
    return column(motion.omega, motion.phase, levels, edges, sides, NO_ROCKING_RATIO, work)


def _settings(
    block: Block, motion: Harmonic, restitution: Restitution, model: str
) -> tuple[Array, Sides, Series | None]:
    """Put what every run of a motion has in common into the form that the kernels take."""
    from colonnade.dynamics.plane.harmonic.nonlinear import empty_series
    from colonnade.dynamics.plane.sides import sides_of

    return (
        np.array(motion.edges),
        sides_of(block, restitution, DEFAULT_REST_ANGLE),
        None if plane_model_of(model).is_linearised else empty_series(),
    )
