"""What the table does: whether it moves under a free vibration, and the steady part of its sine."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.signals.samples import stretches

LEAST_MOTION = 0.003
"""Share of p α, the RMS change of the block's angular velocity by the base above which the table moves."""

STEADY = 0.05
"""Largest departure of the amplitude from its level, as a fraction, within the steady part."""

FEWEST_CYCLES = 3
"""A steady part is at least this many periods long."""


def base_velocity(acceleration: Array, interval: float, block: Block) -> float:
    """
    Size of a base motion as a rocking block feels it.

    Parameters
    ----------
    acceleration : ndarray, shape (n,)
        Of the base along x, m/s², at equal steps; missing samples are NaN and count as no motion.
    interval : float
        s.
    block : Block

    Returns
    -------
    share : float
        RMS change of the angular velocity that the motion causes within about 1/p, as a share of p α.

    Notes
    -----
    Between impacts θ̈ = p² (θ ∓ α − a/g): an acceleration of frequency ω changes the angular velocity by
    p (a/g) / sqrt(1 + (ω/p)²). This weighs what matters to the block, and little of the white noise of an
    accelerometer. The mean is not counted: it is an accelerometer's bias or a tilt, not a motion.
    """
    if not np.isfinite(acceleration).any():
        return 0.0
    values = np.nan_to_num(acceleration - np.nanmean(acceleration))
    # Twice the length, so that the end of the record does not act on its start.
    size = 2 * values.size
    frequency = 2 * np.pi * np.fft.rfftfreq(size, interval) / block.p
    felt = np.fft.irfft(np.fft.rfft(values, size) / np.sqrt(1 + frequency**2), size)[: values.size]
    return float(np.sqrt(np.mean(felt**2)) / (block.gravity * block.critical_angle))


def table_moves(acceleration: Array, interval: float, block: Block) -> bool:
    """
    Decide whether the table moves under a free vibration; arguments as for `base_velocity`.

    Notes
    -----
    Above `LEAST_MOTION` the recorded acceleration drives identification and prediction; below it the table is at rest.
    """
    return base_velocity(acceleration, interval, block) > LEAST_MOTION


class Forcing(NamedTuple):
    """
    A steady sine.

    Attributes
    ----------
    frequency : float
        Hz.
    amplitude : float
        In the unit of the motion, of the fundamental over the steady part.
    start, stop : float
        s, of the steady part.
    distortion : float
        RMS of what is not the fundamental over that of the fundamental.
    """

    frequency: float
    amplitude: float
    start: float
    stop: float
    distortion: float


def fit_forcing(time: ArrayLike, motion: ArrayLike) -> Forcing | None:
    """
    Fit a sine to the steady part of a base motion.

    Parameters
    ----------
    time, motion : array_like, shape (n,)
        s, at equal steps; the motion in any unit. Samples that are not finite are taken as zero.

    Returns
    -------
    forcing : Forcing or None
        None if no stretch of `FEWEST_CYCLES` periods has an even amplitude.

    Notes
    -----
    The first guess of the frequency is the highest line of the spectrum. The motion times exp(−2πi f t), averaged over
    one period, is the complex amplitude at each instant: its modulus shows where the motion is steady, and the slope of
    its phase there corrects the frequency. Amplitude and distortion are then by least squares.
    """
    times = np.asarray(time, dtype=np.float64)
    values = np.nan_to_num(np.asarray(motion, dtype=np.float64))
    if times.size < 16 or not np.any(values):
        return None
    interval = float(times[-1] - times[0]) / (times.size - 1)
    # The highest line of the spectrum; zero padding makes the lines four times as dense.
    spectrum = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(values.size), 4 * values.size))
    frequency = float((int(np.argmax(spectrum[1:])) + 1) / (4 * values.size * interval))
    steady = slice(0, 0)
    for _ in range(3):
        samples = round(1 / (frequency * interval))
        if samples < 4 or samples * FEWEST_CYCLES > times.size:
            return None
        turning = values * np.exp(-2j * np.pi * frequency * times)
        level = 2 * scipy.ndimage.uniform_filter1d(turning, samples, mode="constant")
        steady = _steady_part(np.abs(level), samples)
        if steady.stop - steady.start < FEWEST_CYCLES * samples:
            return None
        phase = np.unwrap(np.angle(level[steady]))
        frequency += float(np.polyfit(times[steady] - times[steady.start], phase, 1)[0]) / (2 * np.pi)
    times, values = times[steady], values[steady]
    angle = 2 * np.pi * frequency * (times - times[0])
    design = np.column_stack((np.ones_like(angle), np.sin(angle), np.cos(angle)))
    coefficients, *_ = np.linalg.lstsq(design, values, rcond=None)
    amplitude = float(np.hypot(coefficients[1], coefficients[2]))
    distortion = float(np.sqrt(2 * np.mean((values - design @ coefficients) ** 2))) / amplitude
    return Forcing(frequency, amplitude, float(times[0]), float(times[-1]), distortion)


def _steady_part(level: Array, samples: int) -> slice:
    """Longest stretch on which the level stays within `STEADY` of its usual height, but for its ends."""
    usual = float(np.median(level[level > 0.5 * level.max()]))
    for _ in range(3):
        near = np.abs(level - usual) <= STEADY * usual
        starts, stops = stretches(near)
        if not starts.size:
            return slice(0, 0)
        longest = int(np.argmax(stops - starts))
        usual = float(np.median(level[starts[longest] : stops[longest]]))
    # The level is an average over a period, and a ramp begins gently: half a period at either end is left out.
    start, stop = int(starts[longest]) + samples // 2, int(stops[longest]) - samples // 2
    return slice(start, stop) if stop - start > samples else slice(0, 0)
