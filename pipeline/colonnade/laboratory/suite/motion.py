"""One synthetic ground motion: modulated and filtered white noise, and a pulse."""

from __future__ import annotations

from math import ceil, pi, sqrt

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.spectra.pulses import mavroeidis_papageorgiou
from colonnade.laboratory.suite.parameters import Shaking

LOWEST = 0.3
"""Hz, of the filter."""

CORNER = 0.15
"""Hz, of the high-pass after which the ground comes to rest."""

SETTLING = 1.5
"""Periods of that corner that are added for it."""

ALMOST_ALL = 0.999
"""Share of the Arias intensity with which the shaking ends."""


def broad_band(shaking: Shaking, interval: float, random: np.random.Generator) -> Array:
    """
    Make a broad-band ground motion.

    Parameters
    ----------
    shaking : Shaking
    interval : float
        s.
    random : Generator

    Returns
    -------
    acceleration : ndarray, shape (n,)
        m/s². Its velocity ends near zero.

    Notes
    -----
    Rezaeian and Der Kiureghian (2008, 2010): white noise goes through a damped oscillator whose frequency changes
    linearly, is brought to unit variance at each instant, and multiplied by an envelope t^(a−1) exp(−b t), of which
    a and b follow from D5–95 and the time of 45 % of the Arias intensity. A critically damped oscillator takes off what
    is slower than `CORNER`. In the end the motion is brought to the Arias intensity that is asked for.
    """
    shape, rate = _envelope(shaking.duration, shaking.middle)
    end = scipy.stats.gamma.ppf(ALMOST_ALL, shape) / rate
    time = interval * np.arange(ceil((end + SETTLING / CORNER) / interval) + 1)
    noise = _filtered(shaking, time[time <= end], random)
    envelope = np.sqrt(scipy.stats.gamma.pdf(time[time <= end], shape, scale=1 / rate))
    values = np.concatenate([envelope * noise, np.zeros(int((time > end).sum()))])
    corner = 2 * pi * CORNER
    highpass = scipy.signal.bilinear([1.0, 0.0, 0.0], [1.0, 2 * corner, corner**2], fs=1 / interval)
    values = scipy.signal.lfilter(*highpass, values)
    energy = scipy.integrate.trapezoid(values**2, dx=interval)
    return np.asarray(values * sqrt(shaking.arias * 2 * 9.81 / pi / energy))


def _envelope(duration: float, middle: float) -> tuple[float, float]:
    """Shape and rate (1/s) of the gamma distribution whose density is the square of the envelope."""

    def excess(shape: float) -> float:
        early, half, late = scipy.stats.gamma.ppf([0.05, 0.45, 0.95], shape)
        return float((late - early) / half - duration / middle)

    # With a shape below 1 the envelope would begin at infinity.
    low, high = 1.0, 400.0
    shape = low if excess(low) < 0 else float(scipy.optimize.brentq(excess, low, high))
    early, late = scipy.stats.gamma.ppf([0.05, 0.95], shape)
    return shape, float((late - early) / duration)


def _filtered(shaking: Shaking, time: Array, random: np.random.Generator) -> Array:
    """White noise through an oscillator whose frequency changes, of unit variance at each instant."""
    frequency = np.maximum(shaking.frequency + shaking.slope * (time - shaking.middle), LOWEST)
    omega, damped = 2 * pi * frequency, sqrt(1 - shaking.damping**2)
    total, variance = np.zeros_like(time), np.zeros_like(time)
    for index, (each, impulse) in enumerate(zip(omega.tolist(), random.standard_normal(time.size), strict=True)):
        since = time[index:] - time[index]
        response = each / damped * np.exp(-shaking.damping * each * since) * np.sin(each * damped * since)
        total[index:] += impulse * response
        variance[index:] += response**2
    return np.asarray(total / np.sqrt(np.where(variance > 0, variance, 1.0)))


def pulse(amplitude: float, period: float, cycles: float, phase: float, centre: float, time: Array) -> Array:
    """
    Acceleration of Mavroeidis and Papageorgiou's velocity pulse, m/s², shape (n,).

    Parameters
    ----------
    amplitude : float
        A, m/s: the largest velocity of a pulse with ν = 0.
    period : float
        1/f_p, s.
    cycles, phase : float
        γ; ν, rad.
    centre : float
        s.
    time : ndarray, shape (n,)
        s.
    """
    omega = 2 * pi / period
    angle = omega * (time - centre)
    inside = np.abs(angle) < pi * cycles
    return np.asarray(np.where(inside, amplitude * omega * mavroeidis_papageorgiou(cycles, phase, angle), 0.0))
