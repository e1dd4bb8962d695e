"""Noise of a record, white or of power 1/f below a knee, and what a low-pass does to the corners at impacts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

ORDER = 4
"""Of the Butterworth filter, run forwards and backwards."""

PASSED = 0.05
"""Share of power that a low-pass leaves at least of the frequencies that count."""

ABOUT_FILTER = 4.0
"""Of 1 / cut-off: time about an impact in which the filter rounds its corner."""

FINEST_CUTOFF = 0.45
"""Of the sampling rate of the samples fitted: a filter above it rounds nothing that they see."""

KNEES = 12
"""Frequencies tried below which noise of power 1/f exceeds white noise."""

BAND = 0.1
"""Width of a band of frequencies, as a share of its lowest, over which a spectrum is averaged."""


def passed(frequency: Array, cutoff_hz: float | None, step: float) -> Array:
    """Share of the amplitude that the low-pass leaves at frequencies (Hz) of a record with samples every `step` s."""
    if cutoff_hz is None:
        return np.ones(frequency.shape)
    ratio = np.tan(np.pi * np.minimum(frequency * step, 0.4999)) / np.tan(np.pi * cutoff_hz * step)
    return np.asarray(1.0 / (1.0 + np.minimum(ratio, 1e6) ** (2 * ORDER)))


def knees_of(frequency: Array, power: Array, freedom: Array) -> tuple[Array, Array]:
    """
    Hold a spectrum, averaged over bands, against noise with each of some knees.

    `power` has so many degrees of freedom at each `frequency` (Hz). Returns the knees (Hz), the first 0 for white
    noise, and the logarithm of Whittle's likelihood of each, at its likeliest level.
    """
    edges = [0]
    while edges[-1] < power.size:
        edges.append(edges[-1] + max(1, int(BAND * edges[-1])))
    starts = np.array(edges[:-1])
    knees = np.append(0.0, np.geomspace(frequency[0], 3 * frequency[-1], KNEES))
    middle = np.add.reduceat(frequency, starts) / np.diff([*edges[:-1], power.size])
    power, freedom = (np.add.reduceat(each, starts) for each in (power, freedom))
    shape = 1 + knees[:, None] / middle
    level = (power / shape).sum(axis=-1, keepdims=True) / freedom.sum()
    return knees, np.asarray(-0.5 * (freedom * np.log(level * shape)).sum(axis=-1))


@dataclass(frozen=True, eq=False)
class Filter:
    """
    A low-pass, and the mean over a group of samples, as they round a corner at time 0.

    Attributes
    ----------
    cutoff_hz : float or None
    step, interval : float
        Of the recording, and of the means, s.
    time : ndarray, shape (n,)
        s, evenly from −reach to reach.
    of_speed, of_acceleration : ndarray, shape (n,)
        Filtered less unfiltered, for a unit jump of the velocity, s, and of the acceleration, s².
    """

    cutoff_hz: float | None
    step: float
    interval: float
    time: Array
    of_speed: Array
    of_acceleration: Array

    def is_coloured(self, residual: Array) -> bool:
        """Whether any knee is likelier than white noise for a residual, NaN where not counted, before its low-pass."""
        frequency = scipy.fft.rfftfreq(residual.size, self.interval)[1:]
        left = passed(frequency, self.cutoff_hz, self.step) ** 2
        kept = left > PASSED
        power = np.abs(np.fft.rfft(np.nan_to_num(residual)))[1:][kept] ** 2 / left[kept]
        _, likelihoods = knees_of(frequency[kept], power, np.full(power.size, 2.0))
        return bool(np.argmax(likelihoods) > 0)

    def whitened(self, columns: Array, knee: float) -> tuple[Array, Array, float]:
        """
        Turn columns (1 + k, n), the first of values that were filtered, others not, into rows with white noise.

        Parameters
        ----------
        columns : ndarray, shape (1 + k, n)
        knee : float
            Hz, of noise whose power is (1 + knee / frequency) of what the low-pass leaves; 0 for white noise.

        Returns
        -------
        rows, frequency : ndarray, shape (1 + k, 2 f), (f,)
            Hz.
        share : float
            Of the samples that count as independent.
        """
        count = columns.shape[1]
        size = int(scipy.fft.next_fast_len(2 * count, real=True))
        padded = np.zeros((columns.shape[0], size))
        padded[:, :count] = columns
        frequency = scipy.fft.rfftfreq(size, self.interval)
        left = passed(frequency, self.cutoff_hz, self.step)
        kept = left**2 > PASSED
        weight = np.full(frequency.size, 2.0 / size)
        weight[0] /= 2
        if size % 2 == 0:
            weight[-1] /= 2
        share = float(weight[kept].sum())
        frequency = np.maximum(frequency, 0.5 / (count * self.interval))[kept]
        rows = scipy.fft.rfft(padded, overwrite_x=True)[:, kept] * np.sqrt(weight[kept] / (1 + knee / frequency))
        # Only the record was filtered: what is taken off it again is white noise, and the sharp columns.
        rows[0] /= left[kept]
        return np.ascontiguousarray(rows).view(np.float64), frequency, share


@lru_cache(maxsize=32)
def filter_of(cutoff_hz: float | None, step: float, group: int) -> Filter:
    """Compute how a low-pass rounds corners in a record of which groups of samples are averaged."""
    length = group * step
    reach = max(ABOUT_FILTER / cutoff_hz if cutoff_hz else 0.0, length)
    half = int(np.ceil(8 * reach / min(length, 0.2 / cutoff_hz if cutoff_hz else length)))
    time, fine = np.linspace(-reach, reach, 2 * half + 1, retstep=True)
    frequency = scipy.fft.rfftfreq(8 * half, fine)
    response = passed(frequency, cutoff_hz, step) * (np.sinc(frequency * length) if group > 1 else 1.0)
    pulse = np.fft.fftshift(np.fft.irfft(response))[4 * half - half : 4 * half + half + 1] / fine
    pulse /= scipy.integrate.trapezoid(pulse, dx=fine)
    once = scipy.integrate.cumulative_trapezoid(pulse, dx=fine, initial=0.0)
    twice = scipy.integrate.cumulative_trapezoid(once, dx=fine, initial=0.0)
    thrice = scipy.integrate.cumulative_trapezoid(twice, dx=fine, initial=0.0)
    after = np.maximum(time, 0.0)
    of_speed, of_acceleration = twice - after, thrice - after**2 / 2
    # Beyond the corner the mean of a parabola is above its middle: that is taken off where samples are averaged.
    return Filter(
        cutoff_hz, step, length, time, of_speed, of_acceleration - np.where(time > 0, of_acceleration[-1], 0.0)
    )


@kernel
def corners(
    time: Array, ends: Array, jumps: Array, bends: Array, offsets: Array, of_speed: Array, of_acceleration: Array
) -> Array:
    """Filtered less unfiltered angle (rad) at times (s), of impacts with jumps of the velocity and acceleration."""
    total = np.zeros(time.size)
    reach, fine = offsets[-1], offsets[1] - offsets[0]
    for k in range(ends.size):
        if np.isnan(ends[k]) or np.isnan(jumps[k]):
            continue
        for i in range(np.searchsorted(time, ends[k] - reach), np.searchsorted(time, ends[k] + reach)):
            place = (time[i] - ends[k] + reach) / fine
            low = min(int(place), offsets.size - 2)
            share = place - low
            total[i] += jumps[k] * (of_speed[low] + share * (of_speed[low + 1] - of_speed[low]))
            total[i] += bends[k] * (of_acceleration[low] + share * (of_acceleration[low + 1] - of_acceleration[low]))
    return total


def find_knee(rows: Array, frequency: Array, precision: Array, level: float) -> float:
    """
    Find the knee (Hz) of the residual in the first of the rows, or 0 for white noise.

    Parameters
    ----------
    rows, frequency : ndarray, shape (1 + k, 2 f), (f,)
        As transformed of white noise: residual, and columns that were fitted to it.
    precision : ndarray, shape (k,)
        1 / variance of what multiplies the columns.
    level : float
        Variance of the noise.
    """
    columns = rows[1:]
    normal = columns @ columns.T / level + np.diag(precision)
    size = np.sqrt(np.diag(normal))
    # A fit takes up noise as well as signal, mostly of low frequencies.
    solved = np.linalg.pinv(normal / np.outer(size, size), hermitian=True) @ (columns / size[:, None])
    taken = (solved / size[:, None] * columns).sum(axis=0) / level
    power = (rows[0] ** 2).reshape(-1, 2).sum(axis=1)
    freedom = np.maximum(1 - taken.reshape(-1, 2).sum(axis=1), 1e-3)
    knees, found = knees_of(frequency, power, freedom)
    best = int(np.argmax(found))
    # White noise is as likely beforehand as all others together.
    return float(knees[best]) if found[best] > found[0] + np.log(KNEES) else 0.0
