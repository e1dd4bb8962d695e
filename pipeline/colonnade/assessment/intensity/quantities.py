"""What the measures of a ground motion compute, each from the motion as it is."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.intensity.ground import Ground
from colonnade.dynamics.block import Block
from colonnade.dynamics.spectra.response import response_spectrum

HOUSNER_PERIODS = np.linspace(0.1, 2.5, 121)
"""s, of the oscillators whose pseudo-velocities are integrated: steps of 0.02 s."""

EARLY, LATE = 0.05, 0.95
"""Shares of the Arias intensity between which the significant duration lies."""


def peak_acceleration(ground: Ground) -> float:
    """Largest |a|, m/s²."""
    return float(np.abs(ground.acceleration).max())


def peak_displacement(ground: Ground) -> float:
    """Largest displacement, m."""
    return float(np.abs(ground.displacement).max())


def peak_velocity(ground: Ground) -> float:
    """Largest |v|, m/s."""
    return float(np.abs(ground.velocity).max())


def ratio_of_peaks(ground: Ground) -> float:
    """PGV over PGA, s; NaN of a motion at rest."""
    peak = peak_acceleration(ground)
    return peak_velocity(ground) / peak if peak > 0.0 else float("nan")


def arias(ground: Ground) -> float:
    """Arias intensity, m/s."""
    return float(pi / (2 * ground.gravity) * scipy.integrate.trapezoid(ground.acceleration**2, dx=ground.interval))


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
    return float("nan") if block is None else peak_acceleration(ground) / block.uplift_acceleration


def velocity_ratio(ground: Ground, block: Block | None) -> float:
    """p PGV over g tan α; NaN without a block."""
    return float("nan") if block is None else block.p * peak_velocity(ground) / block.uplift_acceleration


def _of_motion(quantity: Callable[[Ground], float]) -> Callable[[Ground, Block | None], float]:
    return lambda ground, _block: quantity(ground)


QUANTITIES: dict[str, Callable[[Ground, Block | None], float]] = {
    "pga": _of_motion(peak_acceleration),
    "pgv": _of_motion(peak_velocity),
    "pgd": _of_motion(peak_displacement),
    "pgv_pga": _of_motion(ratio_of_peaks),
    "arias": _of_motion(arias),
    "cav": _of_motion(cumulative_velocity),
    "d5_95": _of_motion(significant_duration),
    "housner": _of_motion(housner),
    "pulse_period": _of_motion(lambda ground: ground.pulse.period),
    "pulse_indicator": _of_motion(lambda ground: ground.pulse.indicator),
    "pga_ratio": acceleration_ratio,
    "pgv_ratio": velocity_ratio,
}
"""What each measure of the registry computes, by its id."""
