"""
What the virtual laboratory tests, and how it records it: the paper's programme, and ten tests of its prism.

The sine tests climb a ladder of amplitudes at each frequency, through both boundaries of the map. Within 1 % in A of a
step the true outcome does not change, so that what becomes of a test does not hang on the last digits of the table's
motion; tests/laboratory/test_runs.py looks at every step's neighbourhood. At 1 and 2 Hz a specimen that rocks at all
overturns: no band of lasting rocking is wide enough for a step. From 3 Hz on rocking lasts, at large amplitudes also
sub-harmonic, and beyond the first overturning amplitude islands are survived: of 3 Hz the step at 1.80 is one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import sqrt
from pathlib import Path

import numpy as np

from colonnade.campaign import load
from colonnade.campaign.channel import MAIN
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError
from colonnade.laboratory.files import COMMAS, GERMAN, MATLAB, TABS, TDMS, FileFormat
from colonnade.laboratory.plan import Plan, Recorder, Trial
from colonnade.laboratory.table import ramped_sine, recorded
from colonnade.readers.motion import EL_CENTRO, el_centro, read_motion
from colonnade.units.text import format_percent

LENGTH_SCALE = 20
"""The specimens are 1:20 models, so that the time of an earthquake is divided by √20."""

SPANS = (2.0, 2.5, 3.0)

PEAK_PER_SPAN = 1.5
"""Largest table acceleration for each unit of Span, m/s²: with El Centro the prism rocks in all three, and stands."""

RELEASES = (0.60, -0.50, 0.70)
"""θ/α from which the free vibrations start, about."""

QUIET = 1.5
"""Rest before each movement, s."""

LATE = 0.020
"""The second recorder starts this much after the main one, about, s."""

SINES = (("sine-3Hz", 3.0, 0.80), ("sine-5Hz", 5.0, 1.50), ("sine-4Hz", 4.0, 1.80), ("sine-2Hz", 2.0, 1.80))
"""Of the ten tests: id, Hz, A: no rocking, rocking twice, overturning. Each outcome holds for 15 % less and more A."""

MARGIN = 0.01
"""Relative change of A within which the true outcome of every step stays the same."""

KEPT_AWAY = (
    f"The amplitudes of the virtual sine tests keep at least {format_percent(MARGIN)} away from the boundaries between "
    "outcomes, so that outcomes are easier to get right here than in a laboratory."
)
"""What is said with every number of right outcomes."""

Ladder = dict[float, tuple[float, ...]]
"""A = a/(g tan α) of the steps, by frequency in Hz."""

CYCLES = {1.0: 10, 2.0: 15}
"""Cycles at full amplitude by frequency in Hz, where rocking does not last."""

LASTING = 60
"""Cycles at full amplitude at all other frequencies: transients take 20 to 50 of them to die."""

RAMPS = {7.0: 6}
"""Cycles of the ramps before and after by frequency in Hz: with a shorter one no amplitude at 7 Hz overturns surely."""

RAMP = 3
"""Cycles of each ramp at all other frequencies."""

LADDERS: dict[str, Ladder] = {
    "prism": {
        1.0: (0.90, 0.98, 1.05, 1.20),
        2.0: (0.90, 0.98, 1.25, 1.36),
        3.0: (0.90, 0.98, 1.23, 1.59, 1.80, 2.20),
        4.0: (0.90, 0.98, 1.06, 1.20, 1.40, 1.80, 2.22, 2.55, 2.80),
        5.0: (0.98, 1.07, 1.30, 1.60, 2.00, 2.45, 2.61, 3.65),
        6.0: (0.98, 1.07, 1.35, 1.80, 2.40, 3.00, 3.39, 4.80),
        7.0: (0.98, 1.07, 1.40, 1.90, 2.60, 3.10, 4.09, 4.60, 6.24),
    },
    "cylinder": {4.0: (0.98, 1.07, 1.50, 2.00, 2.22, 2.47, 2.85)},
    "cone": {4.0: (0.98, 1.07, 1.50, 2.00, 2.25, 2.57, 2.88)},
}
"""By specimen, for its e."""


RESTITUTION = {"prism": 0.976, "cylinder": 0.970, "cone": 0.962}
"""
The true e: of the prism the paper's. It gives none of the others: the cylinder's loses the same share, 0.47, of what a
rigid body would lose as the prism does, the cone's 0.57, so that the three cannot be taken for each other.
"""

FORMATS = {"prism": (TABS, GERMAN, COMMAS), "cylinder": (TDMS, TDMS, COMMAS), "cone": (MATLAB, MATLAB, TDMS)}
"""Of the recorder on the bench, of the main one on the table and of its second one: text, LabVIEW's and MATLAB's."""

PRISM, COLUMNS = (Path(__file__).with_name(name) for name in ("prism.toml", "columns.toml"))
"""The campaign files of the programmes but for their tests: specimens and set-ups."""


def load_record(path: Path | None) -> tuple[str, Motion]:
    """
    Load the record of a file, or El Centro where none is given.

    Returns
    -------
    name : str
    motion : Motion
        Of a file's record only the shape counts: the programme sets its peak, so that its unit is not asked for and
        any is taken for m/s².

    Raises
    ------
    ReadError
        If the file cannot be read, or nothing moves in it.
    """
    if path is None:
        return EL_CENTRO, el_centro()
    motion = read_motion(path, unit="m/s^2")
    if not motion.peak > 0.0:
        raise ReadError(f"{path}: every acceleration is zero; a record that moves the table was expected.")
    return path.stem, motion


def free_vibrations(block: Block, generator: np.random.Generator) -> Iterator[Trial]:
    """Plan three free vibrations on the bench; the generator draws exact angles and instants of release."""
    for number, ratio in enumerate(RELEASES, start=1):
        yield Trial(
            f"free-{number:02d}",
            "free-vibration",
            "bench",
            duration=20.0,
            theta0=(ratio + generator.uniform(-0.02, 0.02)) * block.critical_angle,
            release=QUIET + generator.uniform(-0.2, 0.2),
            entry={"notes": "held tilted, then released"},
        )


def sine(block: Block, name: str, frequency: float, amplitude: float, *, cycles: int, ramp: int) -> Trial:
    """Plan a sine test: frequency in Hz, amplitude A = a/(g tan α), cycles at full amplitude and of each ramp."""
    acceleration = amplitude * block.uplift_acceleration
    table = ramped_sine(frequency, acceleration, start=QUIET, cycles=cycles, ramp=ramp)
    return Trial(
        name,
        "sine",
        "table",
        duration=table.stop + 4.0,
        table=table,
        entry={"frequency": f"{frequency:g} Hz"},
    )


def earthquakes(name: str, record: Motion) -> Iterator[Trial]:
    """Plan an earthquake at three Spans; its time is divided by √20, its peak set to `PEAK_PER_SPAN` × Span."""
    for span in SPANS:
        gain = PEAK_PER_SPAN * span / record.peak
        table = recorded(Motion(record.acceleration * gain, record.dt / sqrt(LENGTH_SCALE)), start=QUIET)
        yield Trial(
            f"span-{span}",
            "earthquake",
            "table",
            duration=table.stop + 9.0,
            table=table,
            spikes=3,
            entry={"motion": name, "span": span, "time_scale": round(1 / sqrt(LENGTH_SCALE), 6)},
        )


def prism_programme(name: str, record: Motion, *, seed: int = 0) -> Plan:
    """
    Plan three free vibrations, four sine tests and an earthquake at three Spans for the paper's prism.

    Parameters
    ----------
    name : str
        Of the earthquake record.
    record : Motion
        At full scale; its time is divided by √20, and its largest acceleration set to `PEAK_PER_SPAN` × Span.
    seed : int, optional
        Of the exact releases.
    """
    block = load(PRISM).block("prism")
    sines = (sine(block, *each, cycles=round(4 * each[1]), ramp=RAMP) for each in SINES)
    return Plan(
        PRISM.read_text(encoding="utf-8"),
        {"prism": RESTITUTION["prism"]},
        recorders(*FORMATS["prism"]),
        (*free_vibrations(block, np.random.default_rng(seed)), *sines, *earthquakes(name, record)),
    )


def paper_programme(name: str, record: Motion, *, seed: int = 0) -> Plan:
    """
    Plan the paper's programme.

    Three free vibrations and an earthquake at three Spans of prism, cylinder and truncated cone; sine tests of the
    prism from 1 to 7 Hz, of the other two at 4 Hz, with an amplitude ladder through both boundaries.

    Parameters
    ----------
    name : str
        Of the earthquake record.
    record : Motion
        At full scale.
    seed : int, optional
        Of the exact releases.
    """
    generator, columns = np.random.default_rng(seed), load(COLUMNS)
    trials: list[Trial] = []
    wired: dict[str, Mapping[str, Recorder]] = {}
    for key in RESTITUTION:
        block = columns.block(key)
        own = (*free_vibrations(block, generator), *_climbed(key, block), *earthquakes(name, record))
        prefix = "" if key == "prism" else f"{key}-"
        trials += (replace(each, name=prefix + each.name, setup=f"{key}-{each.setup}", specimen=key) for each in own)
        wired |= {f"{key}-{place}": each for place, each in recorders(*FORMATS[key]).items()}
    return Plan(COLUMNS.read_text(encoding="utf-8"), RESTITUTION, wired, tuple(trials))


def _climbed(specimen: str, block: Block) -> Iterator[Trial]:
    for frequency, amplitudes in LADDERS[specimen].items():
        cycles, ramp = CYCLES.get(frequency, LASTING), RAMPS.get(frequency, RAMP)
        for amplitude in amplitudes:
            name = f"sine-{frequency:g}Hz-{amplitude:.3f}".removesuffix("0")
            yield sine(block, name, frequency, amplitude, cycles=cycles, ramp=ramp)


def recorders(alone: FileFormat, main: FileFormat, second: FileFormat) -> dict[str, Mapping[str, Recorder]]:
    """Give the recorder of the bench and the two of the table, with rates and starts of their own."""
    return {
        "bench": {MAIN: Recorder(500.0, alone)},
        "table": {MAIN: Recorder(500.0, main), "daq2": Recorder(400.0, second, LATE)},
    }
