"""The table's motion: smooth pieces of acceleration with the displacement that belongs to them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import copysign, cos, pi, sin

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.motion import Motion

PIECES_PER_CYCLE = 8
"""A sine is cut so finely that its acceleration has at most one extremum in a piece."""


@dataclass(frozen=True)
class Piece:
    """Acceleration (m/s²) as a smooth function of time between `start` and `stop`, s."""

    start: float
    stop: float
    acceleration: Callable[[float], float]


@dataclass(frozen=True)
class TableMotion:
    """
    What the table does along x; it is at rest before the first piece and after the last.

    Attributes
    ----------
    pieces : tuple of Piece
        In order and without gaps; empty for a table that stands still.
    displacement_of : callable
        Displacement, m, at an array of times, s.
    """

    pieces: tuple[Piece, ...]
    displacement_of: Callable[[Array], Array]

    def acceleration(self, time: ArrayLike) -> Array:
        """Acceleration, m/s², at times of shape (n,), s: exactly what the specimen stands on."""
        instants = np.atleast_1d(np.asarray(time, dtype=np.float64))
        starts = np.array([piece.start for piece in self.pieces])
        index = np.searchsorted(starts, instants, side="right") - 1
        values = np.zeros(instants.size)
        for position, (instant, number) in enumerate(zip(instants.tolist(), index.tolist(), strict=True)):
            if number >= 0 and instant <= self.pieces[number].stop:
                values[position] = self.pieces[number].acceleration(instant)
        return values

    def displacement(self, time: ArrayLike) -> Array:
        """Displacement, m, at times of shape (n,), s."""
        return self.displacement_of(np.atleast_1d(np.asarray(time, dtype=np.float64)))

    @property
    def stop(self) -> float:
        """Time when the table is at rest again, s."""
        return self.pieces[-1].stop if self.pieces else 0.0


def still() -> TableMotion:
    """Return the motion of a table that does not move."""
    return TableMotion((), np.zeros_like)


def ramped_sine(frequency: float, acceleration: float, *, start: float, cycles: int, ramp: int) -> TableMotion:
    """
    Shake by a sine whose amplitude grows and dies smoothly.

    Parameters
    ----------
    frequency : float
        Hz.
    acceleration : float
        Amplitude between the ramps, m/s².
    start : float
        s, when the table begins to move.
    cycles, ramp : int
        Whole cycles at full amplitude, and of each ramp.

    Raises
    ------
    ValueError
        If a number is not positive.

    Notes
    -----
    The displacement is −a/ω² w(t) sin ωt; w goes over each ramp from 0 to 1 by x⁴(35 − 84x + 70x² − 20x³), so that
    acceleration and jerk are continuous everywhere and the table starts and ends at rest where it was.
    """
    if not (frequency > 0 and acceleration > 0 and cycles > 0 and ramp > 0):
        raise ValueError(
            f"{frequency} Hz, {acceleration} m/s², {cycles} cycles and ramps of {ramp} were given; "
            "positive numbers were expected"
        )
    omega = 2 * pi * frequency
    edges = start + np.arange((cycles + 2 * ramp) * PIECES_PER_CYCLE + 1) / (PIECES_PER_CYCLE * frequency)
    ramp_duration = ramp / frequency
    end = float(edges[-1])

    def shape(time: Array) -> Array:
        fraction = np.clip(np.minimum(time - start, end - time) / ramp_duration, 0.0, 1.0)
        grown = fraction**4 * (35 + fraction * (-84 + fraction * (70 - 20 * fraction)))
        return np.asarray(-acceleration / omega**2 * grown * np.sin(omega * (time - start)))

    def acceleration_at(time: float) -> float:
        x = min(time - start, end - time) / ramp_duration
        phase = omega * (time - start)
        if x >= 1.0:
            return acceleration * sin(phase)
        grown = x**4 * (35 + x * (-84 + x * (70 - 20 * x)))
        first = copysign(140 * x**3 * (1 - x) ** 3 / ramp_duration, end - start - 2 * (time - start))
        second = 420 * x**2 * (1 - x) ** 2 * (1 - 2 * x) / ramp_duration**2
        return acceleration * ((grown - second / omega**2) * sin(phase) - 2 * first / omega * cos(phase))

    pieces = tuple(Piece(left, right, acceleration_at) for left, right in pairwise(edges.tolist()))
    return TableMotion(pieces, shape)


def recorded(motion: Motion, *, start: float) -> TableMotion:
    """
    Play a record, linear between its samples, that begins at `start` (s).

    Notes
    -----
    An acceleration c₀ + c₁ t is taken off the whole record such that velocity and displacement end at zero; the
    displacement is then the exact double integral of the acceleration that the specimen stands on. For El Centro 1940
    NS this takes off 4e-5 of the largest acceleration.
    """
    time, dt = motion.time, motion.dt
    velocity, displacement = _integrate(motion.acceleration, dt)
    duration = motion.duration
    # ∫∫ of c₀ + c₁ t from rest: c₀ T + c₁ T²/2 and c₀ T²/2 + c₁ T³/6 have to equal what is left at the end.
    system = np.array([[duration, duration**2 / 2], [duration**2 / 2, duration**3 / 6]])
    constant, slope = np.linalg.solve(system, [velocity[-1], displacement[-1]])
    acceleration = motion.acceleration - constant - slope * time
    velocity, displacement = _integrate(acceleration, dt)

    def line(instant: float, *, origin: float, level: float, rate: float) -> float:
        return level + rate * (instant - origin)

    rates = np.diff(acceleration) / dt
    pieces = tuple(
        Piece(
            start + k * dt,
            start + (k + 1) * dt,
            partial(line, origin=start + k * dt, level=float(acceleration[k]), rate=float(rates[k])),
        )
        for k in range(rates.size)
    )

    def shape(instants: Array) -> Array:
        k = np.clip(((instants - start) / dt).astype(np.int64), 0, rates.size - 1)
        passed = instants - start - k * dt
        inside = displacement[k] + passed * (velocity[k] + passed * (acceleration[k] / 2 + passed * rates[k] / 6))
        return np.where((instants > start) & (instants < start + duration), inside, 0.0)

    return TableMotion(pieces, shape)


def _integrate(acceleration: Array, dt: float) -> tuple[Array, Array]:
    """Velocity and displacement of a piecewise-linear acceleration, from rest, exactly."""
    before, after = acceleration[:-1], acceleration[1:]
    velocity = np.concatenate(([0.0], np.cumsum((before + after) * dt / 2)))
    steps = velocity[:-1] * dt + (2 * before + after) * dt**2 / 6
    return velocity, np.concatenate(([0.0], np.cumsum(steps)))
