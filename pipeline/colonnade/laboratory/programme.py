"""
What the virtual laboratory tests, and how it records it: the paper's programme, and ten tests of its prism.

The sine tests climb a ladder of amplitudes at each frequency, through both boundaries of the map. Within 1 % in A of a
step the true outcome does not change, so that what becomes of a test does not hang on the last digits of the table's
motion; tests/laboratory/test_ladder.py looks at every step's neighbourhood. At 1 and 2 Hz a specimen that rocks at all
overturns: no band of lasting rocking is wide enough for a step. From 3 Hz on rocking lasts, at large amplitudes also
sub-harmonic, and beyond the first overturning amplitude islands are survived: of 3 Hz the step at 1.80 is one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade import units
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial
from colonnade.laboratory.files import COMMAS, GERMAN, TABS, FileFormat, Matlab, Tdms
from colonnade.laboratory.table import Transducer, ramped_sine, recorded
from colonnade.readers.motion import EL_CENTRO, el_centro
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

TOP, BOTTOM = 0.440, 0.040
"""Heights of the two displacement transducers on the specimen, m."""

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


def _specimen(shape: str, restitution: float, mass: float, **millimetres: float) -> Specimen:
    sizes = {name: f"{size:g} mm" for name, size in millimetres.items()}
    return Specimen(
        {"shape": shape, **sizes, "mass": f"{mass:.2f} kg", "scale": LENGTH_SCALE},
        getattr(Block, shape)(mass=mass, **{name: size / 1000 for name, size in millimetres.items()}),
        restitution,
    )


SPECIMENS = {
    "prism": _specimen("prism", 0.976, 26.10, width=86, depth=86, height=456),
    "cylinder": _specimen("cylinder", 0.970, 26.30, diameter=97, height=455),
    "cone": _specimen("cone", 0.962, 21.94, base_diameter=97, top_diameter=75.5, height=480),
}
"""
The paper's, with its e of the prism. It gives none of the others: the cylinder's loses the same share, 0.47, of what a
rigid body would lose as the prism does, the cone's 0.57, so that the three cannot be taken for each other.
"""


class Rig(NamedTuple):
    """
    How a specimen is recorded.

    Attributes
    ----------
    radii, ranges : pair of float
        Of the transducers at `TOP` and `BOTTOM`: half width of the specimen, and physical value that gives 10 V, m.
    writers : three FileFormat
        Of the recorder on the bench, of the main one on the table and of its second one.
    catch : float
        Where the safety frame catches it, rad, about 1.4 to 1.5 α.
    columns : four str
        Names in the raw files: of the two transducers, of the table's displacement and of its acceleration.
    """

    radii: tuple[float, float]
    ranges: tuple[float, float]
    writers: tuple[FileFormat, FileFormat, FileFormat]
    catch: float
    columns: tuple[str, str, str, str] = ("LVDT 1", "LVDT 2", "Tischweg", "ACC")


CONE_COLUMNS = ("lvdt_top", "lvdt_bottom", "table_disp", "table_acc")

RIGS = {
    "prism": Rig((0.043, 0.043), (0.150, 0.015), (TABS, GERMAN, COMMAS), 0.28),
    "cylinder": Rig((0.0485, 0.0485), (0.150, 0.020), (Tdms(), Tdms(), COMMAS), 0.30),
    "cone": Rig((0.03865, 0.04760), (0.150, 0.020), (Matlab(), Matlab(), Tdms()), 0.30, CONE_COLUMNS),
}
"""The prism's recorders write text, the others' LabVIEW's and MATLAB's; a wider base asks for a wider range."""


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
    from colonnade.readers.motion import read_motion

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
        steady=(QUIET + ramp / frequency, QUIET + (ramp + cycles) / frequency),
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
    prism = SPECIMENS["prism"]
    sines = (sine(prism.block, *each, cycles=round(4 * each[1]), ramp=RAMP) for each in SINES)
    generator = np.random.default_rng(seed)
    return Plan(
        campaign="virtual-prism",
        title="Rocking of a solid steel prism on a virtual shake table",
        specimens={"prism": prism},
        setups=setups(RIGS["prism"], table_range=0.050),
        trials=(*free_vibrations(prism.block, generator), *sines, *earthquakes(name, record)),
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
    generator = np.random.default_rng(seed)
    trials: list[Trial] = []
    wired: dict[str, Setup] = {}
    for key, specimen in SPECIMENS.items():
        own = (*free_vibrations(specimen.block, generator), *_climbed(key), *earthquakes(name, record))
        prefix = "" if key == "prism" else f"{key}-"
        trials += (replace(each, name=prefix + each.name, setup=f"{key}-{each.setup}", specimen=key) for each in own)
        # At 1 Hz the table goes 61 mm.
        wired |= {f"{key}-{place}": setup for place, setup in setups(RIGS[key], table_range=0.100).items()}
    return Plan(
        campaign="virtual-columns",
        title="Rocking of three solid steel specimens on a virtual shake table",
        specimens=SPECIMENS,
        setups=wired,
        trials=tuple(trials),
    )


def _climbed(specimen: str) -> Iterator[Trial]:
    for frequency, amplitudes in LADDERS[specimen].items():
        cycles, ramp = CYCLES.get(frequency, LASTING), RAMPS.get(frequency, RAMP)
        for amplitude in amplitudes:
            name = f"sine-{frequency:g}Hz-{amplitude:.3f}".removesuffix("0")
            yield sine(SPECIMENS[specimen].block, name, frequency, amplitude, cycles=cycles, ramp=ramp)


def setups(rig: Rig, *, table_range: float) -> dict[str, Setup]:
    """
    Set up the bench for free vibrations and the table, with two recorders of their own rates and starts.

    `table_range` is that of the table's displacement, m.
    """
    transducers, (alone, main, second) = frame(rig.radii, rig.ranges, rig.columns[:2]), rig.writers
    displacement, acceleration = table_displacement(table_range, rig.columns[2]), table_acceleration(rig.columns[3])
    own = Recorder((*transducers, displacement), 500.0, main)
    later = Recorder((acceleration,), 400.0, second, late=LATE, align=(displacement.channel, acceleration.channel))
    said = "Table tests: a second recorder for the accelerometer, at its own rate, started a little later."
    return {
        "bench": Setup(
            {MAIN: Recorder(transducers, 500.0, alone)},
            comment="Free vibrations: the specimen on the table at rest, one recorder.",
        ),
        "table": Setup({MAIN: own, "daq2": later}, rig.catch, said),
    }


def frame(
    radii: tuple[float, float], ranges: tuple[float, float], columns: tuple[str, str] = ("LVDT 1", "LVDT 2")
) -> tuple[Transducer, ...]:
    """
    Wire two displacement transducers, fixed to the table's frame, to the specimen's side at `TOP` and `BOTTOM`.

    `radii` are the half widths of the specimen there, `ranges` the physical values that give 10 V, m.
    """
    return tuple(
        Transducer(channel, column, "displacement", "specimen", full_scale, "mm", at=(radius, 0.0, height))
        for channel, column, full_scale, radius, height in zip(
            ("top", "bottom"), columns, ranges, radii, (TOP, BOTTOM), strict=True
        )
    )


def table_displacement(full_scale: float, column: str = "Tischweg") -> Transducer:
    """Wire the actuator's displacement transducer."""
    return Transducer("table_displacement", column, "displacement", "table", full_scale, "mm")


def table_acceleration(column: str = "ACC") -> Transducer:
    """Wire an accelerometer of ±2 g on the table."""
    full_scale = 2.0 * units.factor_to_si("g", "acceleration")
    return Transducer("table_acceleration", column, "acceleration", "table", full_scale, "g")
