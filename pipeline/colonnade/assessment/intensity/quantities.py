"""What the measures of a ground motion compute, each from the motion as it is."""

from __future__ import annotations

from math import pi

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.intensity.ground import Ground
from colonnade.dynamics.block import Block
from colonnade.dynamics.spectra.response import response_spectrum
from colonnade.signals.intensity import arias_intensity

HOUSNER_PERIODS = np.linspace(0.1, 2.5, 121)
"""s, of the oscillators whose pseudo-velocities are integrated: steps of 0.02 s."""

EARLY, LATE = 0.05, 0.95
"""Shares of the Arias intensity between which the significant duration lies."""


def peak_velocity(ground: Ground) -> float:
    """Largest |v|, m/s."""
    return float(np.abs(ground.velocity).max())


def ratio_of_peaks(ground: Ground) -> float:
    """PGV over PGA, s; NaN of a motion at rest."""
    peak = float(np.abs(ground.acceleration).max())
    return peak_velocity(ground) / peak if peak > 0.0 else float("nan")


def arias(ground: Ground) -> float:
    """Arias intensity, m/s."""
    return arias_intensity(ground.acceleration, ground.interval, ground.gravity)


def cumulative_velocity(ground: Ground) -> float:
    """Integral of |a| by trapezoids, m/s."""
    return float(scipy.integrate.trapezoid(np.abs(ground.acceleration), dx=ground.interval))


def significant_duration(ground: Ground) -> float:
    """Time between 5 and 95 % of ∫ a² dt, s, by trapezoids, linear between samples; NaN of a motion at rest."""
    energy = scipy.integrate.cumulative_trapezoid(ground.acceleration**2, dx=ground.interval, initial=0.0)
    if not energy[-1] > 0.0:
        return float("nan")
    begin, end = (_first_time(energy, share * float(energy[-1])) for share in (EARLY, LATE))
    return (end - begin) * ground.interval


def _first_time(rising: Array, level: float) -> float:
    """Give when a rising curve first comes to a level, in samples."""
    after = max(int(np.searchsorted(rising, level)), 1)
    low, high = float(rising[after - 1]), float(rising[after])
    return after - 1 + (level - low) / (high - low)


def spectral_acceleration(ground: Ground, period: float) -> float:
    """Pseudo-acceleration of an oscillator of this period (s), damped by 5 %, m/s²."""
    return float(response_spectrum(ground.acceleration, ground.interval, [period]).pseudo_acceleration[0])


def housner(ground: Ground) -> float:
    """Integral of the pseudo-velocity over periods from 0.1 to 2.5 s, m."""
    spectrum = response_spectrum(ground.acceleration, ground.interval, HOUSNER_PERIODS)
    return float(scipy.integrate.trapezoid(2 * pi / spectrum.period * spectrum.displacement, spectrum.period))


def acceleration_ratio(ground: Ground, block: Block | None) -> float:
    """PGA over g tan α; NaN without a block."""
    return float("nan") if block is None else float(np.abs(ground.acceleration).max()) / block.uplift_acceleration


def velocity_ratio(ground: Ground, block: Block | None) -> float:
    """p PGV over g tan α; NaN without a block."""
    return float("nan") if block is None else block.p * peak_velocity(ground) / block.uplift_acceleration
