"""What a column's signal looks like: constant, a counter, a steady sine, or decaying."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array

LONGEST = 1 << 20
"""Samples that are examined; enough to see the shape of any test."""

SINE_SHARE = 0.6
"""A signal with this share of its power at one frequency is a steady sine."""

FEWEST_CYCLES = 4
"""Of a sine that is distinguished from a pulse."""

QUIET_END = 0.1
"""A signal whose last sixth varies by less than this fraction of the first half has died away."""


@dataclass(frozen=True)
class Shape:
    """
    What a signal looks like.

    Attributes
    ----------
    spread : float
        Standard deviation, in the file's unit; NaN if there is no number.
    counts : bool
        Whether it rises by one from sample to sample.
    sine : float or None
        Frequency of a steady sine, Hz.
    dies_away : bool
    """

    spread: float
    counts: bool
    sine: float | None
    dies_away: bool

    @property
    def is_dead(self) -> bool:
        """Whether nothing ever changes in it."""
        return not self.spread > 0.0


def shape_of(values: Array, time: Array | None) -> Shape:
    """
    Look at a signal.

    Parameters
    ----------
    values : ndarray, shape (n,)
    time : ndarray, shape (n,), or None
        s; without it no frequency is found.
    """
    known = np.isfinite(values) if time is None else np.isfinite(values) & np.isfinite(time)
    signal = values[known][:LONGEST]
    if signal.size < 2 or not np.ptp(signal) > 0:
        return Shape(0.0 if signal.size else np.nan, False, None, False)
    counts = bool(np.all(np.diff(signal) == 1.0))
    interval = 0.0 if time is None else float(np.median(np.diff(time[known][:LONGEST])))
    sine = steady_sine(signal, interval) if interval > 0 and not counts else None
    with np.errstate(over="ignore"):
        spread = float(signal.std())
    return Shape(spread, counts, sine, _dies_away(signal))


def steady_sine(signal: Array, interval: float) -> float | None:
    """
    Frequency of a signal that is a steady sine while it moves; None if it is not.

    Parameters
    ----------
    signal : ndarray, shape (n,)
    interval : float
        s.

    Returns
    -------
    frequency : float or None
        Hz.

    Examples
    --------
    >>> round(steady_sine(np.sin(2 * np.pi * 3.0 * np.arange(0, 10, 0.005)), 0.005), 2)
    3.0
    """
    moving = np.flatnonzero(np.abs(signal - np.median(signal)) > 0.3 * np.abs(signal - np.median(signal)).max())
    part = signal[moving[0] : moving[-1] + 1]
    if part.size < 32:
        return None
    with np.errstate(over="ignore", invalid="ignore"):
        power = np.abs(np.fft.rfft((part - part.mean()) * np.hanning(part.size))) ** 2
    power[0] = 0.0
    peak = int(power.argmax())
    total = float(power.sum())
    if (
        not np.isfinite(total)
        or not FEWEST_CYCLES <= peak < power.size - 2
        or power[peak - 3 : peak + 4].sum() < SINE_SHARE * total
    ):
        return None
    left, middle, right = np.log(np.maximum(power[peak - 1 : peak + 2], 1e-300))
    shift = 0.5 * (left - right) / (left - 2 * middle + right)
    return float((peak + shift) / (part.size * interval))


def _dies_away(signal: Array) -> bool:
    half, sixth = signal.size // 2, signal.size // 6
    with np.errstate(over="ignore"):
        return sixth > 8 and float(signal[-sixth:].std()) < QUIET_END * float(signal[:half].std())
