"""A ground motion as it is measured: its acceleration, velocity and displacement, and how far it drifts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY

if TYPE_CHECKING:
    from colonnade.assessment.intensity.wavelet import Pulse

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
        return _integral(self.acceleration, self.interval)

    @cached_property
    def displacement(self) -> Array:
        """Integral of the velocity from zero, m: exact at the samples, as the velocity is."""
        # The velocity is a parabola between samples.
        return np.asarray(
            _integral(self.velocity, self.interval) - self.interval**2 / 12 * (self.acceleration - self.acceleration[0])
        )

    @cached_property
    def drift(self) -> float:
        """Velocity at the end over the largest one; 0 of a motion that has none."""
        peak = float(np.abs(self.velocity).max())
        return abs(float(self.velocity[-1])) / peak if peak > 0.0 else 0.0

    @cached_property
    def pulse(self) -> Pulse:
        """The largest velocity pulse."""
        from colonnade.assessment.intensity.wavelet import largest_pulse

        return largest_pulse(self.velocity, self.interval)


def _integral(values: Array, interval: float) -> Array:
    """Integrate from zero by trapezoids, without scipy, which the check of a campaign file must not load."""
    return np.concatenate(([0.0], np.cumsum(0.5 * interval * (values[1:] + values[:-1]))))
