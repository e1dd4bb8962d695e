"""Whether a measured history could be one more run of a model: recorded like it, and ranked by its distance."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.signals.filters import lowpass

WITHIN = 0.95
"""Largest rank of a measured history that is within a model's own spread."""

BAND = (0.025, 0.5, 0.975)
"""Quantiles that distances are scaled by: the middle, and the edges of the 95 % band on either side of it."""

FEWEST = 20
"""Runs below which no rank is given: with fewer no history can be among the outermost 5 %."""

AT_A_TIME = 1000
"""Samples that are ranked at a time, so that large ensembles need little memory."""

_LEAST = 1e-9
"""rad; half a band is at least as wide."""


def is_within(rank: float) -> bool | None:
    """Whether a measured history of this rank is within the model's own spread; None if it was not ranked."""
    return None if np.isnan(rank) else bool(rank <= WITHIN)


def rank(measured: float, members: Array) -> float:
    """Return the share of the members' values, shape (m,), that are below the measured one, equal ones by half."""
    return float(np.mean(members < measured) + 0.5 * np.mean(members == measured))


def distances(measured: Array, members: Array) -> tuple[float, Array] | None:
    """
    Measure how far a measured history and each run of a model are from the middle of all others.

    Parameters
    ----------
    measured : ndarray, shape (n,)
        rad, up to the horizon; samples that are not finite are left out for all.
    members : ndarray, shape (m, n)
        rad, each with measurement errors of its own, as if it had been recorded.

    Returns
    -------
    measured, members : float and ndarray, shape (m,), or None
        Largest scaled distances from the median; 1 is the edge of the 95 % band of all others. None for fewer than
        `FEWEST` runs, or without a finite sample.

    Notes
    -----
    Each of the m + 1 histories is measured as if it were the measured one: median and band are those of the m others.
    If all m + 1 are drawn alike, each rank is equally likely, so the verdict is wrong in 5 % of the cases, whatever the
    model and the motion (conformal prediction: Vovk, Gammerman & Shafer 2005, ch. 2).
    """
    known = np.isfinite(measured)
    if members.shape[0] < FEWEST or not known.any():
        return None
    everyone = np.vstack((measured[known], members[:, known])).T
    largest = np.zeros(members.shape[0] + 1)
    for taken in np.array_split(everyone, len(everyone) // AT_A_TIME + 1):
        low, middle, high = _without_each(taken)
        half = np.where(taken > middle, high - middle, middle - low)
        largest = np.maximum(largest, (np.abs(taken - middle) / np.maximum(half, _LEAST)).max(axis=0))
    return float(largest[0]), largest[1:]


def _without_each(everyone: Array) -> list[Array]:
    """Quantiles `BAND` of all others, for each history (columns) at each time (rows)."""
    ranked, found = np.sort(everyone, axis=1), []
    for level in BAND:
        below, share = divmod(level * (everyone.shape[1] - 2), 1.0)
        # Without this history, every rank from its own on is that of the next one.
        first, second, third = (ranked[:, int(below) + k, None] for k in range(3))
        lower, upper = np.where(everyone > first, first, second), np.where(everyone > second, second, third)
        found.append((1 - share) * lower + share * upper)
    return found


@dataclass(frozen=True)
class Measurement:
    """
    Errors of a measured rocking angle.

    Attributes
    ----------
    interval : float
        Between samples, s.
    gain : float
        Standard deviation of its calibration, relative.
    zero : float
        Standard deviation of its zero, rad.
    noise : float
        Standard deviation of its noise, after the low-pass, rad.
    drift : ndarray, shape (n,)
        Standard deviation of an error that grows over the record, as of an integrated angle, rad; one draw a record.
    cutoff_hz : float or None
        Of the zero-phase low-pass that it went through; None for none.
    filter_order : int
    start : float or None
        rad, measured angle from which the model starts, in error by the same gain and zero; None if it starts at rest.
    start_error : float
        Standard deviation of what else the start is in error by, rad.
    """

    interval: float
    gain: float
    zero: float
    noise: float
    drift: Array
    cutoff_hz: float | None
    filter_order: int = 4
    start: float | None = None
    start_error: float = 0.0

    @property
    def start_deviation(self) -> float:
        """Standard deviation of the angle that the model starts from, rad."""
        if self.start is None:
            return 0.0
        return float(np.hypot(np.hypot(self.gain * self.start, self.zero), self.start_error))

    def thinned(self, first: int, stride: int) -> Measurement:
        """Return the errors of every `stride`-th sample from `first` on."""
        return replace(self, interval=stride * self.interval, drift=self.drift[first::stride])


def as_measured(
    histories: NDArray[np.float32], starts: Array, measurement: Measurement, random: np.random.Generator
) -> Array:
    """
    Give each run errors of its own.

    Parameters
    ----------
    histories : ndarray, shape (m, n)
        rad.
    starts : ndarray, shape (m,)
        rad, by how much each began above the measured start.
    measurement : Measurement
    random : numpy.random.Generator

    Returns
    -------
    recorded : ndarray, shape (m, n)
        rad.
    """
    angle, error, noise = histories.astype(np.float64), np.empty(histories.shape), np.empty(histories.shape)
    for number, start in enumerate(starts.tolist()):
        gain, zero = _calibration(measurement, start, random)
        angle[number] *= 1 + gain
        error[number] = zero + measurement.drift * random.standard_normal()
        noise[number] = random.standard_normal(angle.shape[1])
    if measurement.cutoff_hz is not None and measurement.cutoff_hz < 0.5 / measurement.interval:
        # What begins at rest or at a peak has its mirror image before it.
        memory = int(3 * measurement.filter_order / (measurement.cutoff_hz * measurement.interval))
        for values in (angle, noise):
            mirrored = np.concatenate((values[:, memory:0:-1], values), axis=1)
            smooth = lowpass(mirrored, measurement.interval, measurement.cutoff_hz, measurement.filter_order)
            values[:] = smooth[:, -values.shape[1] :]
        noise /= noise.std(axis=1, keepdims=True)
    return np.asarray(angle + error + measurement.noise * noise)


def _calibration(measurement: Measurement, start: float, random: np.random.Generator) -> tuple[float, float]:
    """Draw errors of gain and zero; of a run that began above the measured start, those that explain it."""
    drawn = random.standard_normal(3) * (measurement.gain, measurement.zero, measurement.start_error)
    total = measurement.start_deviation**2
    if measurement.start is None or total == 0.0:
        return float(drawn[0]), float(drawn[1])
    # Conditional normal draws: what is measured at the start is (1 + gain) θ + zero + the rest, and is known.
    missing = -start - (drawn[0] * measurement.start + drawn[1] + drawn[2])
    return (
        float(drawn[0] + missing * measurement.gain**2 * measurement.start / total),
        float(drawn[1] + missing * measurement.zero**2 / total),
    )
