"""The input of the fusion: readings of each kind of transducer, the table's motion, and circumstances of the test."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array


@dataclass(frozen=True)
class Readings:
    """
    What the transducers of one kind read.

    Attributes
    ----------
    values : ndarray, shape (m, n)
        Changes from rest, SI; NaN where missing.
    noise, cutoff_hz : ndarray, shape (m,)
        Standard deviation after the low-pass, and its cut-off.
    """

    values: Array
    noise: Array
    cutoff_hz: Array

    def white(self, interval: float) -> Array:
        """Noise of each sample were it white: what integration and smoothing have to count with."""
        return self.noise / np.sqrt(np.minimum(2 * self.cutoff_hz * interval, 1.0))


@dataclass(frozen=True)
class TableReadings:
    """Displacement (m) and acceleration (m/s²) of the table, shape (3, n); acceleration None if it is not known."""

    displacement: Array
    acceleration: Array | None


@dataclass(frozen=True)
class Circumstances:
    """How a test went: sampling interval and shortest rest in s, and whether it ends at rest for sure or starts so."""

    interval: float
    rest_duration: float
    ends_at_rest: bool
