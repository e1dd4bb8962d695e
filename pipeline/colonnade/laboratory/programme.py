"""The paper's programme on the virtual table: what is done with the prism, and how it is recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np

from colonnade import units
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.campaign_file import FILE_NAME, campaign_text, refuse_foreign
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Trial, perform, write_truth
from colonnade.laboratory.files import COMMAS, GERMAN, TABS, put
from colonnade.laboratory.instruments import Transducer
from colonnade.laboratory.record import load_record
from colonnade.laboratory.table import ramped_sine, recorded

RESTITUTION = 0.976
"""The paper's coefficient of restitution of the prism."""

CATCH = 0.28
"""rad, about 1.5 α."""

LENGTH_SCALE = 20
"""The prism is a 1:20 model, so that time is divided by √20."""

SPANS = (2.0, 2.5, 3.0)

PEAK_PER_SPAN = 1.5
"""Largest table acceleration of an earthquake test for each unit of Span, m/s²: with El Centro all three rock."""

RELEASES = (0.60, -0.50, 0.70)
"""θ/α from which the free vibrations start, about."""

SINES = (("sine-3Hz", 3.0, 0.80), ("sine-5Hz", 5.0, 1.50), ("sine-4Hz", 4.0, 1.80), ("sine-2Hz", 2.0, 1.80))
"""Id, Hz, A: no rocking, rocking twice, overturning; each outcome holds for 15 % less and more of A."""

QUIET = 1.5
"""Rest before each movement, s."""


@dataclass(frozen=True)
class WrittenCampaign:
    """
    A virtual campaign on disk.

    Attributes
    ----------
    path : Path
        Its campaign.toml.
    truth_path : Path
        Its truth.json; the true angle of each test lies beside it.
    truth : dict
        What truth.json holds: `restitution`, `specimen`, and by test `outcome`, `peak_ratio` and more.
    """

    path: Path
    truth_path: Path
    truth: dict[str, Any]


def write_campaign(folder: Path | str, *, seed: int = 0, motion: Path | None = None) -> WrittenCampaign:
    """
    Write the virtual campaign of the paper's programme.

    Parameters
    ----------
    folder : Path or str
        Where campaign.toml, raw/ and truth/ go; made where it is not there.
    seed : int, optional
        Of noise, offsets, spikes and the exact releases. The same seed gives the same files.
    motion : Path, optional
        File with the earthquake record; default: El Centro 1940 NS of the extra `demo`.

    Returns
    -------
    written : WrittenCampaign

    Raises
    ------
    ReadError
        If the record is not there or cannot be read.
    CampaignError
        If the folder holds a campaign that the laboratory did not write.
    StoreError
        If a file cannot be written.
    """
    name, record = load_record(motion)
    return write(prism_programme(name, record, seed=seed), folder, seed=seed)


def write(plan: Plan, folder: Path | str, *, seed: int = 0) -> WrittenCampaign:
    """Perform a plan: write its raw files, its truth and its campaign file; see `write_campaign`."""
    folder = Path(folder)
    refuse_foreign(folder)
    seeds = np.random.SeedSequence(seed).spawn(len(plan.trials))
    records = {
        trial.name: perform(plan, trial, folder, own_seed) for trial, own_seed in zip(plan.trials, seeds, strict=True)
    }
    truth = write_truth(plan, records, folder, seed)
    put(folder / FILE_NAME, campaign_text(plan))
    return WrittenCampaign(folder / FILE_NAME, folder / "truth" / "truth.json", truth)


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
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    shape = {"shape": "prism", "width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.10 kg"}
    trials = (*_free_vibrations(block, np.random.default_rng(seed)), *_sines(block), *_earthquakes(name, record))
    return Plan(
        campaign="virtual-prism",
        title="Rocking of a solid steel prism on a virtual shake table",
        specimen="prism",
        shape={**shape, "scale": LENGTH_SCALE},
        block=block,
        restitution=RESTITUTION,
        setups=prism_setups(),
        trials=trials,
    )


def prism_setups() -> dict[str, Setup]:
    """Set up the free vibrations with one recorder and the table tests with two."""
    frame = (
        Transducer("top", "LVDT 1", "displacement", "specimen", 0.150, "mm", at=(0.043, 0.0, 0.440)),
        Transducer("bottom", "LVDT 2", "displacement", "specimen", 0.015, "mm", at=(0.043, 0.0, 0.040)),
    )
    table = Transducer("table_displacement", "Tischweg", "displacement", "table", 0.050, "mm")
    acceleration = Transducer(
        "table_acceleration", "ACC", "acceleration", "table", 2.0 * units.factor_to_si("g", "acceleration"), "g"
    )
    return {
        "bench": Setup(
            {MAIN: Recorder(frame, 500.0, TABS)},
            comment="Free vibrations: the specimen on the table at rest, one recorder.",
        ),
        "table": Setup(
            {
                MAIN: Recorder((*frame, table), 500.0, GERMAN),
                "daq2": Recorder(
                    (acceleration,), 400.0, COMMAS, late=0.020, align=("table_displacement", "table_acceleration")
                ),
            },
            catch=CATCH,
            comment="Table tests: a second recorder for the accelerometer, at its own rate, started a little later.",
        ),
    }


def _free_vibrations(block: Block, generator: np.random.Generator) -> Sequence[Trial]:
    return [
        Trial(
            f"free-{number:02d}",
            "free-vibration",
            "bench",
            duration=20.0,
            theta0=(ratio + generator.uniform(-0.02, 0.02)) * block.critical_angle,
            release=QUIET + generator.uniform(-0.2, 0.2),
            entry={"notes": "held tilted, then released"},
        )
        for number, ratio in enumerate(RELEASES, start=1)
    ]


def _sines(block: Block) -> Sequence[Trial]:
    trials = []
    for name, frequency, amplitude in SINES:
        cycles = round(4 * frequency)
        table = ramped_sine(frequency, amplitude * block.uplift_acceleration, start=QUIET, cycles=cycles, ramp=3)
        entry = {"frequency": f"{frequency:g} Hz"}
        trials.append(Trial(name, "sine", "table", duration=table.stop + 4.0, table=table, entry=entry))
    return trials


def _earthquakes(name: str, record: Motion) -> Sequence[Trial]:
    trials = []
    for span in SPANS:
        gain = PEAK_PER_SPAN * span / record.peak
        table = recorded(Motion(record.acceleration * gain, record.dt / sqrt(LENGTH_SCALE)), start=QUIET)
        entry: dict[str, str | float] = {"motion": name, "span": span, "time_scale": round(1 / sqrt(LENGTH_SCALE), 6)}
        duration = table.stop + 9.0
        trials.append(Trial(f"span-{span}", "earthquake", "table", duration, table, spikes=3, entry=entry))
    return trials
