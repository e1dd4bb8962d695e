"""Noise of a record, from the spectrum of the residual of a fit: its level, and the low-pass of the record."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import log

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array

ORDER = 4
"""Of the Butterworth filter that is looked for, run forwards and backwards."""

SMALLEST_GROUP = 7
"""Frequencies of the spectrum that make one group at least, ..."""

GROUP_SHARE = 0.12
"""... and as a share of their number below it."""

FILTERED = 0.75
"""A low-pass is believed where it leaves less than this share of the flat spectrum's misfit, ..."""

FLOORS = np.array([0.0, 1e-6, 1e-4, 1e-3, 1e-2, 0.1])
"""... shares of the power below the cut-off that were not filtered, one of which it leaves above."""

OUTSTANDING = 6.0
"""Standard errors by which the mean of a spectrum may exceed that by its median, before the median is taken."""


@dataclass(frozen=True)
class Noise:
    """
    Stationary noise, white or low-passed.

    Attributes
    ----------
    level : float
        Power of a sample if the noise were white at the level of its low frequencies, rad².
    cutoff_hz : float or None
        Of the zero-phase Butterworth filter; None for white noise.
    floor : float
        Share of `level` that was not filtered.
    interval : float
        Of the samples, s.
    freedom : float
        Independent values that `level` is from.
    """

    level: float
    cutoff_hz: float | None
    floor: float
    interval: float
    freedom: float

    def spectrum(self, frequency: Array) -> Array:
        """Power at frequencies (Hz), rad²: its mean up to half the sampling rate is the variance."""
        if self.cutoff_hz is None:
            return np.full(frequency.shape, self.level)
        return np.asarray(self.level * (passed_power(frequency, self.cutoff_hz, self.interval) + self.floor))

    @property
    def variance(self) -> float:
        """Of a sample, rad²."""
        return float(self.spectrum(np.linspace(0.0, 0.5 / self.interval, 400)).mean())


def fit_noise(residual: Array, interval: float, *, cutoff_hz: float | None = None) -> Noise:
    """
    Fit white or low-passed noise to the spectrum of residuals.

    Parameters
    ----------
    residual : ndarray, shape (n,)
        rad, at equal steps; NaN where not counted.
    interval : float
        s.
    cutoff_hz : float, optional
        Where the low-pass is known.

    Notes
    -----
    Medians over groups of frequencies are fitted by least absolute differences of their logarithms, so that the few
    frequencies at which a wrong model leaves something do not count.
    """
    counted = np.isfinite(residual)
    power = float(np.mean(residual[counted] ** 2)) if counted.any() else 0.0
    if counted.sum() < 4 * SMALLEST_GROUP or not power > 0:
        return Noise(power, None, 0.0, interval, max(int(counted.sum()), 1))
    frequency, periodogram = _periodogram(residual, interval)
    edges = _edges(periodogram.size)
    middle, level, weight = _groups(frequency, periodogram, edges)
    logarithm = np.log(np.maximum(level, 1e-300))
    _, flat_misfit = _weighted_medians(logarithm[None, :], weight)
    if cutoff_hz is None:
        cutoffs = np.geomspace(max(middle[0], 1e-3 / interval), 0.48 / interval, 60)
        _, _, misfit = _filtered(middle, logarithm, weight, cutoffs, interval)
        cutoff_hz = float(cutoffs[int(np.argmin(misfit))]) if misfit.min() < FILTERED * flat_misfit[0] else None
        if cutoff_hz is not None:
            # Far above the cut-off the spectrum shows the recorder's last digit; near it, the filter.
            near = middle < 1.5 * cutoff_hz
            cutoffs = np.minimum(cutoff_hz * np.geomspace(0.6, 1.6, 41), 0.49 / interval)
            _, _, misfit = _filtered(middle[near], logarithm[near], weight[near], cutoffs, interval)
            cutoff_hz = float(cutoffs[int(np.argmin(misfit))])
    freedom = float(counted.mean())
    if cutoff_hz is None or cutoff_hz >= 0.49 / interval:
        return Noise(_level(periodogram[1:]), None, 0.0, interval, 2 * freedom * (periodogram.size - 1))
    _, floors, _ = _filtered(middle, logarithm, weight, np.array([cutoff_hz]), interval)
    below = np.flatnonzero((frequency > 0) & (frequency < 1.1 * cutoff_hz))
    shape = passed_power(frequency[below], cutoff_hz, interval) + floors[0]
    if below.size < SMALLEST_GROUP:
        lowest = periodogram[1 : 1 + SMALLEST_GROUP]
        return Noise(float(lowest.mean()), None, 0.0, interval, 2 * freedom * SMALLEST_GROUP)
    return Noise(_level(periodogram[below] / shape), cutoff_hz, float(floors[0]), interval, 2 * freedom * below.size)


def _filtered(
    frequency: Array, logarithm: Array, weight: Array, cutoffs: Array, interval: float
) -> tuple[Array, Array, Array]:
    """Level, floor and misfit of the best floor at each cut-off."""
    shape = passed_power(frequency[None, :], cutoffs[:, None], interval)
    shapes = np.log(np.maximum(shape[:, None, :] + FLOORS[None, :, None], 1e-30))
    levels, misfits = _weighted_medians(logarithm - shapes.reshape(-1, frequency.size), weight)
    misfits = misfits.reshape(cutoffs.size, FLOORS.size)
    best = np.argmin(misfits, axis=1)
    rows = np.arange(cutoffs.size)
    return levels.reshape(misfits.shape)[rows, best], FLOORS[best], misfits[rows, best]


def _level(power: Array) -> float:
    """Mean power, or where a few frequencies stand out, the level of the others by their median."""
    typical = float(np.median(power)) / _median_of_exponentials(power.size)
    mean = float(power.mean())
    return mean if mean < typical * (1 + OUTSTANDING / np.sqrt(power.size)) else typical


def weighted_products(sensitivity: Array, noise: Noise) -> Array:
    """
    Covariance of the products of sensitivities with the noise: Jᵀ Γ J.

    Parameters
    ----------
    sensitivity : ndarray, shape (n, k)
        At equal steps; zero where a sample is not counted.
    noise : Noise
    """
    if noise.cutoff_hz is None:
        return np.asarray(noise.level * (sensitivity.T @ sensitivity))
    return _by_spectrum(sensitivity, noise.spectrum, noise.interval)


def filtered_products(sensitivity: Array, noise: Noise) -> Array:
    """Products of sensitivities with what the noise's filter makes of them: Jᵀ F J."""
    cutoff = noise.cutoff_hz
    if cutoff is None:
        return np.asarray(sensitivity.T @ sensitivity)
    return _by_spectrum(sensitivity, lambda at: np.sqrt(passed_power(at, cutoff, noise.interval)), noise.interval)


def measured_products(sensitivity: Array, residual: Array, interval: float) -> Array:
    """Jᵀ Γ J as `weighted_products`, with the residuals' own smoothed spectrum for the noise's."""
    frequency, power = _periodogram(residual, interval)
    middle, level, _ = _groups(frequency, power, _edges(power.size), mean=True)
    return _by_spectrum(sensitivity, lambda at: np.interp(at, middle, level), interval)


def _by_spectrum(sensitivity: Array, spectrum: Callable[[Array], Array], interval: float) -> Array:
    from scipy.fft import next_fast_len, rfft, rfftfreq

    size = next_fast_len(2 * sensitivity.shape[0], real=True)
    transform = rfft(sensitivity, n=size, axis=0)
    power = spectrum(rfftfreq(size, interval)) * 2.0 / size
    power[0] /= 2
    if size % 2 == 0:
        power[-1] /= 2
    return np.asarray((transform.conj().T * power) @ transform).real


def passed_power(frequency: Array, cutoff_hz: float | Array, interval: float) -> Array:
    """Share of power that the filter, run both ways, leaves at a frequency (Hz; samples every `interval` s)."""
    phase = np.pi * np.minimum(frequency * interval, 0.4999)
    ratio = np.tan(phase) / np.tan(np.pi * np.asarray(cutoff_hz) * interval)
    return np.asarray((1.0 + np.minimum(ratio, 1e6) ** (2 * ORDER)) ** -2)


def _periodogram(residual: Array, interval: float) -> tuple[Array, Array]:
    """Frequencies, Hz, and power, whose mean is the mean square of what was counted."""
    from scipy.fft import rfft, rfftfreq

    counted = np.isfinite(residual)
    power = np.abs(rfft(np.where(counted, residual, 0.0))) ** 2 / max(int(counted.sum()), 1)
    return rfftfreq(residual.size, interval), power


def _groups(
    frequency: Array, power: Array, edges: NDArray[np.int_], *, mean: bool = False
) -> tuple[Array, Array, Array]:
    """Middle frequency, level and number of members of groups of a spectrum."""
    pieces = list(pairwise(edges))
    if mean:
        levels = np.array([power[first:last].mean() for first, last in pieces])
    else:
        levels = np.array(
            [_median(power[first:last]) / _median_of_exponentials(last - first) for first, last in pieces]
        )
    return 0.5 * (frequency[edges[:-1]] + frequency[edges[1:] - 1]), levels, np.diff(edges).astype(np.float64)


def _median(values: Array) -> float:
    """Median of a few values, without numpy's general preparations."""
    ordered, half = np.sort(values), values.size // 2
    return float(ordered[half] if values.size % 2 else 0.5 * (ordered[half - 1] + ordered[half]))


@cache
def _edges(size: int) -> NDArray[np.int_]:
    edges = [1]
    while edges[-1] + SMALLEST_GROUP <= size:
        edges.append(edges[-1] + max(SMALLEST_GROUP, int(GROUP_SHARE * edges[-1]) | 1))
    edges[-1] = size
    return np.array(edges)


@cache
def _median_of_exponentials(count: int) -> float:
    """Expected median of so many exponential variables of mean one."""
    if count > 60:
        return log(2) + 0.5 / count
    middle = [sum(1.0 / k for k in range(n, count + 1)) for n in {count // 2 + 1, (count + 1) // 2}]
    return sum(middle) / len(middle)


def _weighted_medians(values: Array, weight: Array) -> tuple[Array, Array]:
    """Weighted median of each row, and the weighted sum of absolute differences from it."""
    order = np.argsort(values, axis=1)
    weights = np.cumsum(weight[order], axis=1)
    half = np.argmax(weights >= 0.5 * weights[:, -1:], axis=1)
    medians = np.take_along_axis(values, np.take_along_axis(order, half[:, None], 1), 1)
    return medians[:, 0], (weight * np.abs(values - medians)).sum(axis=1)
