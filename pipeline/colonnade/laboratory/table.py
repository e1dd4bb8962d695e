"""The table's motion, what the channels of the virtual laboratory see, and the errors of their chains."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import copysign, cos, inf, pi, sin

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import cumulative_trapezoid

from colonnade.arrays import Array
from colonnade.campaign import Channel
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion

Acceleration = Callable[[float], float]
"""Acceleration, m/s², at a time, s."""

PIECES_PER_CYCLE = 8
"""A sine is cut so finely that its acceleration has at most one extremum in a piece."""


@dataclass(frozen=True)
class TableMotion:
    """
    What the table does along x; it is at rest before the first edge and after the last.

    Attributes
    ----------
    edges : tuple of float
        s, between which the acceleration is smooth; empty for a table that stands still.
    acceleration_in : callable
        Acceleration, m/s², by the formula of the piece with a number, at a time, s.
    displacement : callable
        Displacement, m, at an array of times, s.
    """

    edges: tuple[float, ...]
    acceleration_in: Callable[[int, float], float]
    displacement: Callable[[Array], Array]

    def acceleration(self, time: ArrayLike) -> Array:
        """Acceleration, m/s², at times of shape (n,), s: exactly what the specimen stands on."""
        instants = np.atleast_1d(np.asarray(time, dtype=np.float64))
        pieces = np.minimum(np.searchsorted(self.edges, instants, side="right") - 1, len(self.edges) - 2)
        values = np.zeros(instants.size)
        for moving in np.flatnonzero((pieces >= 0) & (instants <= self.stop)).tolist():
            values[moving] = self.acceleration_in(int(pieces[moving]), float(instants[moving]))
        return values

    def pieces(self, start: float, stop: float) -> Iterator[tuple[float, float, Acceleration]]:
        """Start, stop (s) and acceleration at a time of each piece from one time to another, rest included."""
        for number, both in enumerate(pairwise((-inf, *self.edges, inf)), start=-1):
            left, right = max(both[0], start), min(both[1], stop)
            is_moving = 0 <= number < len(self.edges) - 1
            if right > left:
                yield left, right, partial(self.acceleration_in, number) if is_moving else _rest

    @property
    def stop(self) -> float:
        """Time when the table is at rest again, s."""
        return self.edges[-1] if self.edges else 0.0


def _rest(instant: float) -> float:
    return 0.0


def still() -> TableMotion:
    """Return the motion of a table that does not move."""
    return TableMotion((), lambda piece, instant: 0.0, np.zeros_like)


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

    Notes
    -----
    The displacement is −a/ω² w(t) sin ωt; w goes over each ramp from 0 to 1 by x⁴(35 − 84x + 70x² − 20x³), so that
    acceleration and jerk are continuous everywhere and the table starts and ends at rest where it was.
    """
    omega = 2 * pi * frequency
    edges = start + np.arange((cycles + 2 * ramp) * PIECES_PER_CYCLE + 1) / (PIECES_PER_CYCLE * frequency)
    ramp_duration = ramp / frequency
    end = float(edges[-1])

    def shape(time: Array) -> Array:
        fraction = np.clip(np.minimum(time - start, end - time) / ramp_duration, 0.0, 1.0)
        grown = fraction**4 * (35 + fraction * (-84 + fraction * (70 - 20 * fraction)))
        return np.asarray(-acceleration / omega**2 * grown * np.sin(omega * (time - start)))

    def acceleration_in(piece: int, time: float) -> float:
        x = min(time - start, end - time) / ramp_duration
        phase = omega * (time - start)
        if x >= 1.0:
            return acceleration * sin(phase)
        grown = x**4 * (35 + x * (-84 + x * (70 - 20 * x)))
        first = copysign(140 * x**3 * (1 - x) ** 3 / ramp_duration, end - start - 2 * (time - start))
        second = 420 * x**2 * (1 - x) ** 2 * (1 - 2 * x) / ramp_duration**2
        return acceleration * ((grown - second / omega**2) * sin(phase) - 2 * first / omega * cos(phase))

    return TableMotion(tuple(edges.tolist()), acceleration_in, shape)


def recorded(motion: Motion, *, start: float) -> TableMotion:
    """
    Play a record, linear between its samples, that begins at `start` (s).

    Notes
    -----
    An acceleration c₀ + c₁ t is taken off the whole record such that velocity and displacement end at zero; the
    displacement is then the exact double integral of the acceleration that the specimen stands on. For El Centro 1940
    NS this takes off 4e-5 of the largest acceleration.
    """
    dt, duration = motion.dt, motion.duration
    velocity, displacement = _integrate(motion.acceleration, dt)
    # ∫∫ of c₀ + c₁ t from rest: c₀ T + c₁ T²/2 and c₀ T²/2 + c₁ T³/6 have to equal what is left at the end.
    system = np.array([[duration, duration**2 / 2], [duration**2 / 2, duration**3 / 6]])
    constant, slope = np.linalg.solve(system, [velocity[-1], displacement[-1]])
    acceleration = motion.acceleration - constant - slope * motion.time
    velocity, displacement = _integrate(acceleration, dt)

    rates = np.diff(acceleration) / dt
    edges = tuple(start + k * dt for k in range(rates.size + 1))
    levels, slopes = acceleration.tolist(), rates.tolist()

    def line(piece: int, instant: float) -> float:
        return float(levels[piece] + slopes[piece] * (instant - edges[piece]))

    def shape(instants: Array) -> Array:
        k = np.clip(((instants - start) / dt).astype(np.int64), 0, rates.size - 1)
        passed = instants - start - k * dt
        inside = displacement[k] + passed * (velocity[k] + passed * (acceleration[k] / 2 + passed * rates[k] / 6))
        return np.where((instants > start) & (instants < start + duration), inside, 0.0)

    return TableMotion(edges, line, shape)


def _integrate(acceleration: Array, dt: float) -> tuple[Array, Array]:
    """Velocity and displacement of a piecewise-linear acceleration, from rest, exactly."""
    velocity = cumulative_trapezoid(acceleration, dx=dt, initial=0.0)
    steps = velocity[:-1] * dt + (2 * acceleration[:-1] + acceleration[1:]) * dt**2 / 6
    return velocity, np.concatenate(([0.0], np.cumsum(steps)))


VOLTS = 10.0
"""Every chain puts out ±10 V."""
BITS = 16
STEP = 2 * VOLTS / 2**BITS
"""Smallest step of the converter, V."""


def sense(channel: Channel, block: Block, table: TableMotion, time: Array, angle: Array) -> Array:
    """Physical value of a channel without any error, m or m/s², at times (s) with the angles of the block."""
    along = np.array(channel.direction)
    if channel.on == "table":
        motion = table.displacement(time) if channel.quantity == "displacement" else table.acceleration(time)
        return np.asarray(motion * along[0])
    if channel.quantity != "displacement" or channel.at is None:
        raise ValueError(
            f"{channel.column}: on the specimen, the virtual laboratory has only displacement transducers with a "
            f"point `at`; {channel.quantity} at {channel.at} was asked for"
        )
    moved = point_displacement(angle, channel.at, block)[0] @ along
    return np.asarray(moved + (table.displacement(time) * along[0] if channel.relative_to == "ground" else 0.0))


@dataclass(frozen=True)
class Imperfections:
    """
    Errors of a measuring chain, as fractions of its range.

    Attributes
    ----------
    noise : float
        Standard deviation of white noise.
    drift : float
        Change of the zero over a record, even in time; its sign is drawn.
    zero : float
        The zero offset is drawn between ± this.
    """

    noise: float = 0.0005
    drift: float = 0.001
    zero: float = 0.02


def measure(
    value: Array,
    channel: Channel,
    imperfections: Imperfections,
    generator: np.random.Generator,
    spikes: tuple[int, ...] = (),
) -> Array:
    """
    Turn a physical value (SI) into what the recorder writes: its converter has ±10 V for the range of the channel.

    At `spikes`, samples, a pulse of 2 to 5 V comes on top, towards the middle of the range.
    """
    zero = VOLTS * imperfections.zero * generator.uniform(-1.0, 1.0)
    drift = VOLTS * imperfections.drift * generator.choice([-1.0, 1.0])
    a_volt = (channel.range_recorded or VOLTS) / VOLTS
    volts = (value - channel.offset) / channel.factor / a_volt
    volts = volts + zero + drift * np.linspace(0.0, 1.0, value.size)
    volts += VOLTS * imperfections.noise * generator.standard_normal(value.size)
    for sample in spikes:
        volts[sample] -= np.copysign(generator.uniform(2.0, 5.0), volts[sample])
    codes = np.clip(np.rint(volts / STEP), -(2 ** (BITS - 1)), 2 ** (BITS - 1) - 1)
    return np.asarray(codes * STEP * a_volt)
