"""The kinds of test that the paper's programme is made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.experiment import Trial
from colonnade.laboratory.table import ramped_sine, recorded

LENGTH_SCALE = 20
"""The specimens are 1:20 models, so that the time of an earthquake is divided by √20."""

SPANS = (2.0, 2.5, 3.0)

PEAK_PER_SPAN = 1.5
"""Largest table acceleration for each unit of Span, m/s²: with El Centro the prism rocks in all three, and stands."""

RELEASES = (0.60, -0.50, 0.70)
"""θ/α from which the free vibrations start, about."""

QUIET = 1.5
"""Rest before each movement, s."""


@dataclass(frozen=True)
class Placed:
    """
    A specimen as tests name it.

    Attributes
    ----------
    specimen : str
        Its id.
    block : Block
    bench, table : str
        Ids of its setups for free vibrations and for table tests.
    prefix : str
        What the ids of its tests begin with.
    """

    specimen: str
    block: Block
    bench: str
    table: str
    prefix: str = ""


def free_vibrations(placed: Placed, generator: np.random.Generator) -> Iterator[Trial]:
    """Plan three free vibrations; the generator draws exact angles and instants of release."""
    for number, ratio in enumerate(RELEASES, start=1):
        yield Trial(
            f"{placed.prefix}free-{number:02d}",
            "free-vibration",
            placed.bench,
            duration=20.0,
            theta0=(ratio + generator.uniform(-0.02, 0.02)) * placed.block.critical_angle,
            release=QUIET + generator.uniform(-0.2, 0.2),
            entry={"notes": "held tilted, then released"},
            specimen=placed.specimen,
        )


def sine(placed: Placed, name: str, frequency: float, amplitude: float, *, cycles: int, ramp: int) -> Trial:
    """
    Plan a sine test.

    Parameters
    ----------
    placed : Placed
    name : str
        Its id, without the prefix.
    frequency, amplitude : float
        Hz; A = a/(g tan α).
    cycles, ramp : int
        Of full amplitude, and of each ramp.
    """
    acceleration = amplitude * placed.block.uplift_acceleration
    table = ramped_sine(frequency, acceleration, start=QUIET, cycles=cycles, ramp=ramp)
    return Trial(
        placed.prefix + name,
        "sine",
        placed.table,
        duration=table.stop + 4.0,
        table=table,
        entry={"frequency": f"{frequency:g} Hz"},
        specimen=placed.specimen,
        steady=(QUIET + ramp / frequency, QUIET + (ramp + cycles) / frequency),
    )


def earthquakes(placed: Placed, name: str, record: Motion) -> Iterator[Trial]:
    """
    Plan an earthquake at three Spans.

    Parameters
    ----------
    placed : Placed
    name : str
        Of the record.
    record : Motion
        At full scale; its time is divided by √20, and its largest acceleration set to `PEAK_PER_SPAN` × Span.
    """
    for span in SPANS:
        gain = PEAK_PER_SPAN * span / record.peak
        table = recorded(Motion(record.acceleration * gain, record.dt / sqrt(LENGTH_SCALE)), start=QUIET)
        yield Trial(
            f"{placed.prefix}span-{span}",
            "earthquake",
            placed.table,
            duration=table.stop + 9.0,
            table=table,
            spikes=3,
            entry={"motion": name, "span": span, "time_scale": round(1 / sqrt(LENGTH_SCALE), 6)},
            specimen=placed.specimen,
        )
