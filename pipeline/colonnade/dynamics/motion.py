"""The base motion: accelerations of the table at equal steps, linear between samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class Motion:
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
        If there is no sample, a sample is not finite, the lengths differ or `dt` is not positive.
    """

    def __init__(
        self,
        acceleration: ArrayLike,
        dt: float,
        vertical: ArrayLike | None = None,
        transverse: ArrayLike | None = None,
    ) -> None:
        if not (np.isfinite(dt) and dt > 0):
            raise ValueError(f"dt is {dt}; a positive sampling interval in seconds was expected")
        self.dt = float(dt)
        self.acceleration = _samples("acceleration", acceleration)
        self.vertical = None if vertical is None else _samples("vertical", vertical, self.acceleration.size)
        self.transverse = None if transverse is None else _samples("transverse", transverse, self.acceleration.size)

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


def _samples(name: str, values: ArrayLike, size: int | None = None) -> Array:
    samples = np.ascontiguousarray(values, dtype=np.float64)
    if samples.ndim != 1 or samples.size == 0:
        raise ValueError(
            f"{name} has shape {samples.shape}; a one-dimensional array with at least one sample was expected"
        )
    if size is not None and samples.size != size:
        raise ValueError(
            f"{name} has {samples.size} samples; {size} were expected, as many as the acceleration along x"
        )
    finite = np.isfinite(samples)
    if not finite.all():
        raise ValueError(f"{name} is not finite at sample {int(np.argmin(finite))}; fill or cut the gap first")
    return samples
