"""Synthetic ground motions for the assessment of real columns, some of them with a pulse."""

from __future__ import annotations

from math import log, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import mavroeidis_papageorgiou
from colonnade.store.files import write_text

INTERVAL = 0.01
"""s."""

MAGNITUDES, DISTANCES = (6.0, 7.5), (10e3, 60e3)
"""Of the earthquakes, drawn uniformly, and their distances, m, uniformly in their logarithm."""

PULSED, NEAR = 3, (5e3, 15e3)
"""One record of so many has a pulse, at such a distance, m."""

AMPLITUDES, CYCLES = (0.4, 1.0), (1.0, 3.0)
"""Of the pulses, m/s, and their γ, drawn uniformly; at a fault A is about 1 m/s (Mavroeidis and Papageorgiou 2003)."""

DURATIONS, HIGHEST = (8.0, 25.0), (4.0, 12.0)
"""D5–95, s, and upper end of the band, Hz, drawn uniformly in their logarithms."""

LOWEST = 0.3
"""Hz, lower end of the band: what is slower is taken off, so that the ground comes to rest."""

SHAPE = 3.0
"""Of the gamma distribution whose density is the square of the envelope (Saragoni and Hart 1974)."""

LIST = "records.csv"


class SyntheticRecord(NamedTuple):
    """A synthetic ground motion, moment magnitude and distance (m) of its earthquake, period of its pulse (s)."""

    name: str
    motion: Motion
    magnitude: float
    distance: float
    pulse_period: float | None


def synthetic_records(count: int = 24, seed: int = 1) -> list[SyntheticRecord]:
    """
    Make a suite of ground motions.

    Parameters
    ----------
    count : int, optional
    seed : int, optional
        Record k draws from a stream of its own, of (seed, k): the same whatever the count.

    Returns
    -------
    records : list of SyntheticRecord
        Every third has a pulse, of the velocity of Mavroeidis and Papageorgiou (2003), log T = −2.2 + 0.4 M.
    """
    return [_record(number, seed) for number in range(count)]


def broad_band(arias: float, duration: float, highest: float, interval: float, random: np.random.Generator) -> Array:
    """
    Make a broad-band ground motion: white noise under an envelope, from `LOWEST` to a highest frequency.

    Parameters
    ----------
    arias, duration, highest : float
        Arias intensity, m/s; D5–95, s, as of the envelope; Hz.
    interval : float
        s.
    random : Generator

    Returns
    -------
    acceleration : ndarray, shape (n,)
        m/s², from rest to rest: the filter has two zeros at frequency 0, and its transient is part of the motion.
    """
    early, late, end = scipy.stats.gamma.ppf([0.05, 0.95, 0.999], SHAPE)
    scale = duration / (late - early)
    time = interval * np.arange(int((end * scale + 3.0 / LOWEST) / interval) + 1)
    envelope = np.where(time < end * scale, np.sqrt(scipy.stats.gamma.pdf(time, SHAPE, scale=scale)), 0.0)
    band = scipy.signal.butter(2, (LOWEST, highest), "bandpass", fs=1 / interval, output="sos")
    values = scipy.signal.sosfilt(band, envelope * random.standard_normal(time.size))
    energy = scipy.integrate.trapezoid(values**2, dx=interval)
    return np.asarray(values * sqrt(arias * 2 * STANDARD_GRAVITY / pi / energy))


def _record(number: int, seed: int) -> SyntheticRecord:
    random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    has_pulse = number % PULSED == PULSED - 1
    magnitude = float(random.uniform(*MAGNITUDES))
    limits = np.log([NEAR if has_pulse else DISTANCES, DURATIONS, HIGHEST])
    distance, duration, highest = np.exp(random.uniform(limits[:, 0], limits[:, 1])).tolist()
    # Median and scatter for strike-slip faulting on rock, after Rezaeian and Der Kiureghian (2010).
    strength = 2.944 * magnitude / 7 - 1.356 * log(max(distance, DISTANCES[0]) / 25e3) + random.normal(0.0, 0.65)
    arias = pi / 2 * STANDARD_GRAVITY * float(np.exp(1.432 * (strength - 2.296) - 4.826))
    acceleration, period = broad_band(arias, duration, highest, INTERVAL, random), None
    if has_pulse:
        period, cycles = 10 ** (0.4 * magnitude - 2.2), float(random.uniform(*CYCLES))
        centre = max(duration / 2, cycles * period / 2)
        acceleration = np.pad(acceleration, (0, int((centre + cycles * period / 2) / INTERVAL) + 2))
        angle = 2 * pi / period * (INTERVAL * np.arange(acceleration.size) - centre)
        pulse = mavroeidis_papageorgiou(cycles, float(random.uniform(0.0, 2 * pi)), angle)
        amplitude = 2 * pi / period * float(random.uniform(*AMPLITUDES))
        acceleration = acceleration + np.where(np.abs(angle) < pi * cycles, amplitude * pulse, 0.0)
    name = f"synthetic-{number + 1:02d}{'-pulse' if has_pulse else ''}"
    return SyntheticRecord(name, Motion(acceleration, INTERVAL), magnitude, distance, period)


def write_suite(folder: Path, records: list[SyntheticRecord]) -> Path:
    """Write the accelerations of a suite as CSV files, and their list, whose path is returned."""
    rows = ["file,unit,interval,record,magnitude,distance [km]"]
    for name, motion, magnitude, distance, _period in records:
        values = "\n".join(f"{value:.6e}" for value in motion.acceleration)
        write_text(folder / f"{name}.csv", f"acceleration [m/s^2]\n{values}\n")
        rows.append(f"{name}.csv,m/s^2,{motion.dt:g} s,{name},{magnitude:.2f},{distance / 1000:.1f}")
    write_text(folder / LIST, "\n".join([*rows, ""]))
    return folder / LIST
