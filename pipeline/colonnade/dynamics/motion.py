"""The base motion: accelerations of the table at equal steps, linear between samples."""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.units.text import Digested
from colonnade.validation import number, samples

MOST_SAMPLES = 10_000_000
"""Of a motion that is made for a duration: an hour of a small block; more asks for a wrong unit, or does not end."""


class Motion(Digested):
    """
    Acceleration of the base, linear between equally spaced samples.

    Parameters
    ----------
    acceleration : array_like, shape (n,)
        Along x, m/s², positive towards +x. Its first sample is at time 0.
    dt : float
        Sampling interval, s.
    vertical, transverse : array_like, shape (n,), optional
        Along z (positive upwards, gravity not included) and y, m/s².

    Raises
    ------
    ValueError
        If the motion is empty, a sample is not finite, the lengths differ or `dt` is not positive.

    Examples
    --------
    >>> motion = Motion([0.0, 2.0, -1.0], 0.01)
    >>> motion.time.tolist(), motion.duration, motion.peak
    ([0.0, 0.01, 0.02], 0.02, 2.0)
    >>> motion
    <Motion: duration 0.02 s, dt 0.01 s, peak 2 m/s²>
    """

    _ESSENCE = "duration s, dt s, peak m/s²"

    def __init__(
        self,
        acceleration: ArrayLike,
        dt: float,
        vertical: ArrayLike | None = None,
        transverse: ArrayLike | None = None,
    ) -> None:
        self.dt = number("dt", dt, "a positive sampling interval in seconds, Motion(acceleration, dt),", above=0.0)
        self.acceleration = samples("acceleration", acceleration, each="sample")
        self.vertical = None if vertical is None else samples("vertical", vertical, each="sample")
        self.transverse = None if transverse is None else samples("transverse", transverse, each="sample")
        for name, along in (("vertical", self.vertical), ("transverse", self.transverse)):
            if along is not None and along.size != self.acceleration.size:
                raise ValueError(
                    f"{name} has {along.size} samples; {self.acceleration.size} were expected, as many as the "
                    "acceleration along x"
                )

    @property
    def time(self) -> Array:
        """Times of the samples, s, from 0."""
        return np.arange(self.acceleration.size, dtype=np.float64) * self.dt

    @property
    def duration(self) -> float:
        """Time of the last sample, s."""
        return (self.acceleration.size - 1) * self.dt

    @property
    def peak(self) -> float:
        """Largest magnitude of the acceleration along x, m/s²."""
        return float(np.abs(self.acceleration).max())


def at_rest(block: Block, duration: float | None) -> Motion:
    """
    Give a table at rest for a duration in s, sampled at about 1/(500 p).

    Raises
    ------
    ValueError
        If the duration is not positive, or has more than `MOST_SAMPLES`.
    """
    rate = block.p * 500
    expected = f"without a motion a positive duration in seconds, at most {MOST_SAMPLES / rate:.4g},"
    seconds = number("duration", duration, expected, above=0.0, high=MOST_SAMPLES / rate)
    intervals = max(ceil(seconds * rate), 2)
    return Motion(np.zeros(intervals + 1), seconds / intervals)
