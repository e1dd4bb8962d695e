"""The motion of the ground or of a table: its acceleration, velocity and displacement, and how far it drifts."""

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

LARGEST_DRIFT_AT_REST = 0.25
"""The same of a table's motion: what a line may take off an integral, over its peak."""

RESTING = 0.02
"""Share of the record of a table, at each end, over which it is taken to rest."""


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
    at_rest : bool
        Whether it is known to begin and to end at rest, as a table does and nobody knows of the ground. A line through
        the means of the first and the last `RESTING` of each integral is then subtracted, as a constant error of the
        acceleration gives no more than a line.
    """

    acceleration: Array
    interval: float
    gravity: float = STANDARD_GRAVITY
    at_rest: bool = False

    @cached_property
    def velocity(self) -> Array:
        """Integral of the acceleration from rest, m/s: exact at the samples."""
        return self._velocity[0]

    @cached_property
    def displacement(self) -> Array:
        """Integral of the velocity from zero, m: exact at the samples, as the velocity is."""
        return self._displacement[0]

    @property
    def drift(self) -> float:
        """Velocity at the end, or what a line took off it, over the largest one; 0 of a motion that has none."""
        return self._velocity[1]

    @property
    def drift_of_displacement(self) -> float:
        """The larger of the drift of the velocity and, of a motion at rest at both ends, of its integral."""
        return max(self.drift, self._displacement[1]) if self.at_rest else self.drift

    @cached_property
    def _velocity(self) -> tuple[Array, float]:
        return self._settled(_integral(self.acceleration, self.interval))

    @cached_property
    def _displacement(self) -> tuple[Array, float]:
        # The velocity is a parabola between samples.
        curved = self.interval**2 / 12 * (self.acceleration - self.acceleration[0])
        return self._settled(_integral(self.velocity, self.interval) - curved)

    def _settled(self, whole: Array) -> tuple[Array, float]:
        """Return an integral, less the line through its ends if it rests there, and its drift over its peak."""
        off = abs(float(whole[-1]))
        if self.at_rest:
            size = max(int(RESTING * whole.size), 1)
            first, last = float(whole[:size].mean()), float(whole[-size:].mean())
            off = abs(last - first)
            steps = (np.arange(whole.size) - (size - 1) / 2) / max(whole.size - size, 1)
            whole = whole - first - (last - first) * steps
        peak = float(np.abs(whole).max())
        return whole, off / peak if peak > 0.0 else 0.0

    @cached_property
    def pulse(self) -> Pulse:
        """The largest velocity pulse."""
        from colonnade.assessment.intensity.wavelet import largest_pulse

        return largest_pulse(self.velocity, self.interval)


def _integral(values: Array, interval: float) -> Array:
    """Integrate from zero by trapezoids, without scipy, which the check of a campaign file must not load."""
    return np.concatenate(([0.0], np.cumsum(0.5 * interval * (values[1:] + values[:-1]))))
