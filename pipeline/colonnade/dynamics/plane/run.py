"""Runs of the plane models under a recorded or a harmonic base motion, which is not sampled, and how they end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, cos, hypot, inf, pi, sin, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, History
from colonnade.dynamics.models import DEFAULT, Model, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.restitution_law import Given, Restitution, RestitutionLaw, law_of

if TYPE_CHECKING:
    from colonnade.dynamics.plane.march import Forcing
    from colonnade.dynamics.plane.sides import Sides

LARGEST_ACCELERATION = 1e6
"""In g; no table reaches more."""

LONGEST_SAMPLE = 300.0
"""In p dt; hyperbolic functions of more leave the range of floating-point numbers."""

OUTCOMES = ("no-rocking", "rocking", "overturned")
"""What the codes 0, 1 and 2 mean."""

STANDS, ROCKS, OVERTURNS = range(len(OUTCOMES))
"""Indices into `OUTCOMES`."""


def run(
    model: Model, block: Block, motion: Motion, restitution: Given, *, theta0: float, omega0: float, rest_angle: float
) -> History:
    """Run a plane model; arguments and errors as of `rock`."""
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    law = law_of(block, restitution)
    expect_usable(block, motion)
    forcing = forcing_of(motion, block.gravity)
    while True:
        sides = sides_of(block, law, rest_angle)
        angle, velocity, times, before, end = propagate(
            forcing, sides, is_linearised=model.is_linearised, angle=theta0, velocity=omega0
        )
        wider = law.reaching(before) if isinstance(law, RestitutionLaw) else law
        if wider is law:
            break
        law = wider
    e = law(np.abs(before)) if isinstance(law, RestitutionLaw) else np.where(before > 0.0, *law)
    return History(block, motion.time, angle, velocity, times, before, e * before, end.time, model.name)


def forcing_of(motion: Motion, gravity: float) -> Forcing:
    """Put a base motion along x and, if given, z into the form that the kernels take; gravity in m/s²."""
    from colonnade.dynamics.plane.march import NONE, Forcing

    weights = NONE if motion.vertical is None else 1.0 + motion.vertical / gravity
    return Forcing(0.0, 0.5 * pi, motion.dt, NONE, motion.acceleration / gravity, weights)


def expect_usable(block: Block, motion: Motion) -> None:
    """
    Refuse a motion that the plane models cannot run.

    Raises
    ------
    ValueError
        If it is stronger or its samples are longer than they solve, it has a transverse component, or the base falls
        faster than the block.
    """
    fastest = max(block.side_p(block.negative), block.side_p(block.positive))
    if not motion.peak <= LARGEST_ACCELERATION * block.gravity:
        raise ValueError(
            f"The acceleration is {motion.peak:.4g} m/s² at sample {int(np.abs(motion.acceleration).argmax())}; "
            f"at most {LARGEST_ACCELERATION:g} g was expected. Check its unit."
        )
    if fastest * motion.dt > LONGEST_SAMPLE:
        raise ValueError(
            f"dt is {motion.dt} s, {fastest * motion.dt:.4g}/p; a sampling interval below {LONGEST_SAMPLE:g}/p "
            f"({LONGEST_SAMPLE / fastest:.4g} s) was expected"
        )
    if motion.transverse is not None:
        raise ValueError("The plane models take motion along x and z only; a Motion without `transverse` was expected")
    if motion.vertical is not None and not motion.vertical.min() > -block.gravity:
        raise ValueError(
            f"vertical is {motion.vertical.min():.6g} m/s² at sample {int(motion.vertical.argmin())}: the base falls "
            f"faster than the block; more than −{block.gravity:g} m/s² was expected"
        )


class Ends(NamedTuple):
    """
    How the histories of n blocks end.

    Attributes
    ----------
    outcome : ndarray of int8, shape (n,)
        Index into `OUTCOMES`.
    peak_ratio : ndarray, shape (n,)
        Largest |θ|/α at the samples; NaN if the block overturns.
    peak_velocity : ndarray, shape (n,)
        Largest |ω| at the samples up to overturning, rad/s.
    """

    outcome: Codes
    peak_ratio: Array
    peak_velocity: Array


def ends_of(motion: Motion, blocks: Sequence[Sides], *, gravity: float, model: str) -> Ends:
    """
    Run blocks from rest under one motion.

    Parameters
    ----------
    motion : Motion
        Along x and, if given, z; usable as `expect_usable` says.
    blocks : sequence of Sides
        By `sides_of`.
    gravity : float
        m/s².
    model : str
        A plane one.

    Returns
    -------
    ends : Ends
        The same, to the last bit, as outcome and `peak_ratio` of `rock`.

    Notes
    -----
    A block that the motion cannot uplift is not run: with a vertical component none is left out.
    """
    from colonnade.dynamics.plane.march import propagate

    chosen, forcing = plane_model_of(model), forcing_of(motion, gravity)
    largest = np.inf if forcing.weights.size > 0 else float(np.abs(forcing.levels).max())
    codes = np.full(len(blocks), STANDS, dtype=np.int8)
    peaks, speeds = np.zeros((2, len(blocks)))
    for number, sides in enumerate(blocks):
        if largest <= chosen.uplift_threshold(min(sides.critical)):
            continue
        angles, velocities, _, _, (time, _, _) = propagate(forcing, sides, is_linearised=chosen.is_linearised)
        if np.isfinite(time):
            codes[number], peaks[number] = OVERTURNS, np.nan
            speeds[number] = np.abs(velocities[: int(time / motion.dt) + 1]).max()
            continue
        peaks[number] = max(-angles.min() / sides.critical[0], angles.max() / sides.critical[1])
        speeds[number] = np.abs(velocities).max()
        codes[number] = ROCKS if peaks[number] > NO_ROCKING_RATIO else STANDS
    return Ends(codes, peaks, speeds)


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
        rad, rad/s, at the samples asked for; those after the motion's end are as at its end.
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
    Put e into the form that the kernels take: a function is sampled as far as impacts can go up to an A of the base
    motion.

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

    A = a / (g tan α) is `amplitude_ratio`. The history has so many `samples` at an `interval` (s) from time 0, and
    `peak_ratio` counts from `peaks_from` (s) on.
    """
    # Its kernels are compiled on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    times = np.minimum(interval * np.arange(samples), motion.edges[2])
    forcing = motion.forcing(peaks_from, *times)
    levels = forcing.levels * (amplitude_ratio * tan(block.critical_angle))
    linearised = plane_model_of(model).is_linearised
    sides = sides_of(block, restitution_up_to(block, restitution, amplitude_ratio))
    since = int(np.searchsorted(forcing.times, peaks_from))
    angles, velocities, impact_times, impact_velocities, end = propagate(
        forcing._replace(levels=levels), sides, is_linearised=linearised, since=since, floor=inf
    )
    outcome = OUTCOMES[OVERTURNS if np.isfinite(end.time) else ROCKS if end.peak > NO_ROCKING_RATIO else STANDS]
    at = np.searchsorted(forcing.times, times)
    return HarmonicRun(outcome, end.peak, angles[at], velocities[at], impact_times, impact_velocities)


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
