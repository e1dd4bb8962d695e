"""Runs of the plane models under a recorded or a harmonic base motion, which is not sampled, and how they end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, pi, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, History
from colonnade.dynamics.models import Model, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import Given

if TYPE_CHECKING:
    from colonnade.dynamics.plane.sides import Sides

LARGEST_ACCELERATION = 1e6
"""In g; no table reaches more."""

LONGEST_SAMPLE = 300.0
"""In p dt; hyperbolic functions of more leave the range of floating-point numbers."""

OUTCOMES = ("no-rocking", "rocking", "overturned")
"""What the codes 0, 1 and 2 mean."""

STANDS, ROCKS, OVERTURNS = range(len(OUTCOMES))
"""Indices into `OUTCOMES`."""


NONE = np.empty(0)
"""Of what there is not."""


class Forcing(NamedTuple):
    """
    A base motion in parts: a/g = l(t) sin(ω t + phase), with l and the weight 1 + v/g linear between knots.

    Attributes
    ----------
    omega, phase : float
        rad/s; rad. A record has ω = 0 and phase = π/2.
    interval : float
        s, between the knots of a record.
    times : ndarray, shape (n,)
        s, of the knots; empty for a record. Two at the same time make a jump.
    levels, weights : ndarray, shape (n,)
        l and 1 + v/g at the knots; no weights where the base moves along x only.
    """

    omega: float
    phase: float
    interval: float
    times: Array
    levels: Array
    weights: Array


def run(
    model: Model, block: Block, motion: Motion, restitution: Given, *, theta0: float, omega0: float, rest_angle: float
) -> History:
    """Run a plane model; arguments and errors as of `rock`."""
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    sides = sides_of(block, restitution, rest_angle)
    expect_usable(block, motion)
    forcing = forcing_of(motion, block.gravity)
    angle, velocity, times, before, end = propagate(
        forcing, sides, is_linearised=model.is_linearised, angle=theta0, velocity=omega0
    )
    negative, positive = sides.restitution.reshape(2, -1)
    e = np.where(before > 0.0, *(np.interp(np.abs(before), sides.speeds, each) for each in (negative, positive)))
    return History(block, motion.time, angle, velocity, times, before, e * before, end.time, model.name)


def forcing_of(motion: Motion, gravity: float) -> Forcing:
    """Put a base motion along x and, if given, z into the form that the kernels take; gravity in m/s²."""
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
    if not (motion.peak <= LARGEST_ACCELERATION * block.gravity and fastest * motion.dt <= LONGEST_SAMPLE):
        raise ValueError(
            f"The acceleration is {motion.peak:.4g} m/s² at sample {int(np.abs(motion.acceleration).argmax())}, and dt "
            f"is {motion.dt:g} s; at most {LARGEST_ACCELERATION:g} g and {LONGEST_SAMPLE:g}/p "
            f"({LONGEST_SAMPLE / fastest:.4g} s) were expected. Check their units."
        )
    if motion.transverse is not None:
        raise ValueError("The plane models take motion along x and z only; a Motion without `transverse` was expected")
    if motion.vertical is not None and not motion.vertical.min() > -block.gravity:
        raise ValueError(
            f"vertical is {motion.vertical.min():.6g} m/s² at sample {int(motion.vertical.argmin())}: the base falls "
            f"faster than the block; more than −{block.gravity:g} m/s² was expected"
        )


def ends_of(motion: Motion, blocks: Sequence[Sides], *, gravity: float, model: str) -> tuple[Codes, Array]:
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
    outcome : ndarray of int8, shape (n,)
        Index into `OUTCOMES`.
    peak_ratio : ndarray, shape (n,)
        Largest |θ|/α at the samples; NaN if the block overturns. Both the same, to the last bit, as of `rock`.

    Notes
    -----
    A block that the motion cannot uplift is not run: with a vertical component none is left out.
    """
    from colonnade.dynamics.plane.arc import empty_series
    from colonnade.dynamics.plane.march import column

    chosen, forcing = plane_model_of(model), forcing_of(motion, gravity)
    largest = np.inf if forcing.weights.size > 0 else float(np.abs(forcing.levels).max())
    codes = np.full(len(blocks), STANDS, dtype=np.int8)
    peaks = np.zeros(len(blocks))
    is_closed = chosen.is_linearised and forcing.weights.size == 0
    work, once = None if is_closed else empty_series(chosen.is_linearised), np.ones(1)
    for number, sides in enumerate(blocks):
        if largest > chosen.uplift_threshold(min(sides.critical)):
            (codes[number],), (peaks[number],) = column(forcing, once, sides, NO_ROCKING_RATIO, work)
    return codes, peaks


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
        return np.interp(time, (0.0, rise, full, end), (float(rise == 0.0), 1.0, 1.0, float(end == full)))

    def sampled(self, largest: float) -> tuple[Array, float]:
        """Sample it with its largest acceleration (m/s²), shape (n,), and give the sampling interval, s."""
        end = self.edges[2]
        count = max(ceil(end * self.omega / (2 * pi) * SAMPLES_A_CYCLE), 1)
        time = end / count * np.arange(count + 1.0)
        return largest * np.append(self.level(time) * np.sin(self.omega * time + self.phase), 0.0), end / count

    def forcing(self, *times: float) -> Forcing:
        """Put it into the form that the kernels take, with knots at some times (s) too."""
        knots = np.unique([0.0, *self.edges, *(time for time in times if time < self.edges[2])])
        return Forcing(self.omega, self.phase, 0.0, knots, self.level(knots), NONE)


def outcomes_of(amplitude_ratio: Array, *, block: Block, forcing: Forcing, restitution: Given, model: str) -> Codes:
    """Outcomes of many A from rest under a motion that is given over A tan α, indices into `OUTCOMES`, shape (n,)."""
    from colonnade.dynamics.plane.arc import empty_series
    from colonnade.dynamics.plane.march import column
    from colonnade.dynamics.plane.sides import sides_of

    scales = amplitude_ratio * tan(block.critical_angle)
    sides = sides_of(block, restitution)
    work = None if plane_model_of(model).is_linearised else empty_series()
    return column(forcing, scales, sides, NO_ROCKING_RATIO, work)[0]
