"""A ground motion as it is measured: its acceleration, velocity and displacement, and how far it drifts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.intensity.wavelet import Pulse, largest_pulse
from colonnade.dynamics.block import STANDARD_GRAVITY

LARGEST_DRIFT = 0.1
"""Default of the largest end velocity over PGV of a record without drift."""


@dataclass(frozen=True)
class Ground:
    """
    A motion on plain arrays; what is derived from it is computed once, when it is first asked for.

    Attributes
    ----------
    acceleration : ndarray, shape (n,)
        m/s², without gaps, linear between its samples.
    interval : float
        s.
    gravity : float
        m/s².
    """

    acceleration: Array
    interval: float
    gravity: float = STANDARD_GRAVITY

    @cached_property
    def velocity(self) -> Array:
        """Integral of the acceleration from rest, m/s: exact at the samples."""
        return np.asarray(scipy.integrate.cumulative_trapezoid(self.acceleration, dx=self.interval, initial=0.0))

    @cached_property
    def displacement(self) -> Array:
        """Integral of the velocity from zero, m: exact at the samples, as the velocity is."""
        trapezoids = scipy.integrate.cumulative_trapezoid(self.velocity, dx=self.interval, initial=0.0)
        # The velocity is a parabola between samples.
        return np.asarray(trapezoids - self.interval**2 / 12 * (self.acceleration - self.acceleration[0]))

    @cached_property
    def drift(self) -> float:
        """Velocity at the end over the largest one; 0 of a motion that has none."""
        peak = float(np.abs(self.velocity).max())
        return abs(float(self.velocity[-1])) / peak if peak > 0.0 else 0.0

    @cached_property
    def pulse(self) -> Pulse:
        """The largest velocity pulse."""
        return largest_pulse(self.velocity, self.interval)
