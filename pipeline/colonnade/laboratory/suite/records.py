"""A suite of synthetic ground motions, as functions of a seed, and its files with their list."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from io import StringIO
from math import pi
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.suite.motion import broad_band, pulse
from colonnade.laboratory.suite.parameters import drawn_shaking
from colonnade.store import files

INTERVAL = 0.01
"""s."""

MAGNITUDES, DISTANCES = (6.0, 7.5), (10e3, 60e3)
"""Of the earthquakes, drawn uniformly, and their distances, m, uniformly in their logarithm."""

PULSED = 3
"""One record of so many has a pulse."""

NEAR = (5e3, 15e3)
"""m, distances of records with a pulse."""

AMPLITUDES, CYCLES = (0.4, 1.0), (1.0, 3.0)
"""Of the pulses, m/s, and their γ, drawn uniformly; at a fault A is about 1 m/s (Mavroeidis and Papageorgiou 2003)."""

LIST = "records.csv"


@dataclass(frozen=True)
class SyntheticRecord:
    """
    A synthetic ground motion and the earthquake that it is drawn for.

    Attributes
    ----------
    name : str
        Begins with "synthetic".
    motion : Motion
    magnitude, distance : float
        Moment magnitude; m.
    pulse_period : float or None
        s, of the pulse that was added.
    """

    name: str
    motion: Motion
    magnitude: float
    distance: float
    pulse_period: float | None


def synthetic_records(count: int = 24, seed: int = 1) -> list[SyntheticRecord]:
    """
    Make a suite.

    Parameters
    ----------
    count : int, optional
    seed : int, optional
        Record k draws from a stream of its own, of (seed, k): the same whatever the count.

    Returns
    -------
    records : list of SyntheticRecord
        Every third has a pulse.

    Notes
    -----
    The period of a pulse follows Mavroeidis and Papageorgiou (2003), log T = −2.2 + 0.4 M.
    """
    return [_record(number, seed) for number in range(count)]


def _record(number: int, seed: int) -> SyntheticRecord:
    random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    has_pulse = number % PULSED == PULSED - 1
    magnitude = float(random.uniform(*MAGNITUDES))
    distance = float(np.exp(random.uniform(*np.log(NEAR if has_pulse else DISTANCES))))
    shaking = drawn_shaking(magnitude, max(distance, DISTANCES[0]), random)
    acceleration, period = broad_band(shaking, INTERVAL, random), None
    if has_pulse:
        period, cycles = float(10 ** (0.4 * magnitude - 2.2)), float(random.uniform(*CYCLES))
        half = 0.5 * cycles * period
        centre = max(shaking.middle, half)
        size = max(acceleration.size, int((centre + half) / INTERVAL) + 2)
        amplitude, phase = float(random.uniform(*AMPLITUDES)), float(random.uniform(0.0, 2 * pi))
        whole: Array = pulse(amplitude, period, cycles, phase, centre, INTERVAL * np.arange(size, dtype=np.float64))
        whole[: acceleration.size] += acceleration
        acceleration = whole
    name = f"synthetic-{number + 1:02d}{'-pulse' if has_pulse else ''}"
    return SyntheticRecord(name, Motion(acceleration, INTERVAL), magnitude, distance, period)


def write_suite(folder: Path, records: list[SyntheticRecord]) -> Path:
    """
    Write the accelerations of a suite as CSV files, and their list.

    Parameters
    ----------
    folder : Path
        Made if it is not there.
    records : list of SyntheticRecord

    Returns
    -------
    path : Path
        Of the list, `LIST`: file, unit, interval, record, magnitude, distance.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rows: list[tuple[str, ...]] = [("file", "unit", "interval", "record", "magnitude", "distance [km]")]
    for record in records:
        values = "\n".join(f"{value:.6e}" for value in record.motion.acceleration)
        files.write_text(folder / f"{record.name}.csv", f"acceleration [m/s^2]\n{values}\n")
        earthquake = (f"{record.magnitude:.2f}", f"{record.distance / 1000:.1f}")
        rows.append((f"{record.name}.csv", "m/s^2", f"{record.motion.dt:g} s", record.name, *earthquake))
    written = StringIO()
    csv.writer(written, lineterminator="\n").writerows(rows)
    files.write_text(folder / LIST, written.getvalue())
    return folder / LIST
