"""A virtual campaign: what is tested, how it is recorded; performed, it becomes raw files and their truth."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.block import Block
from colonnade.laboratory.files import Flavour, delimited_text, put
from colonnade.laboratory.instruments import Imperfections, Transducer, measure
from colonnade.laboratory.table import TableMotion, still
from colonnade.laboratory.truth import Truth, simulate

Array = NDArray[np.float64]

MAIN = "main"
START_SCATTER = 1e-3
"""A recorder that starts late does so within ± this, s: no two starts are alike."""


@dataclass(frozen=True)
class Recorder:
    """
    One recorder and the transducers wired to it.

    Attributes
    ----------
    transducers : tuple of Transducer
    sampling_rate_hz : float
    flavour : Flavour
        How it writes its files.
    late : float
        How long after the main recorder it starts, about, s; its clock begins at its own start.
    align : pair of str, or None
        A channel of the main recorder and one of its own that link the two; None where they start together.
    """

    transducers: tuple[Transducer, ...]
    sampling_rate_hz: float
    flavour: Flavour = field(default_factory=Flavour)
    late: float = 0.0
    align: tuple[str, str] | None = None


@dataclass(frozen=True)
class Setup:
    """
    Recorders, by id with "main" first, the safety frame's catch angle (rad) or None, and what it is, in a line.
    """

    recorders: Mapping[str, Recorder]
    catch: float | None = None
    comment: str = ""


@dataclass(frozen=True)
class Trial:
    """
    One test.

    Attributes
    ----------
    name : str
        Its id.
    kind, setup : str
    duration : float
        Of the record, s.
    table : TableMotion
    theta0, release : float
        Angle at which the specimen is held until it is released, rad and s.
    spikes : int
        Pulses of one sample spread over the channels of the record.
    entry : mapping
        Further keys of the test in the campaign file, such as `{"span": 2.0}`.
    """

    name: str
    kind: str
    setup: str
    duration: float
    table: TableMotion = field(default_factory=still)
    theta0: float = 0.0
    release: float = 0.0
    spikes: int = 0
    entry: Mapping[str, str | float] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """
    A whole campaign.

    Attributes
    ----------
    campaign, title : str
        As in the campaign file.
    specimen : str
        Id.
    shape : mapping
        Keys of the specimen in the campaign file, such as `{"shape": "prism", "width": "86 mm"}`.
    block : Block
        The same specimen for the simulation.
    restitution : float
        True e.
    setups : mapping of str to Setup
    trials : tuple of Trial
    imperfections : Imperfections
    """

    campaign: str
    title: str
    specimen: str
    shape: Mapping[str, str | float]
    block: Block
    restitution: float
    setups: Mapping[str, Setup]
    trials: tuple[Trial, ...]
    imperfections: Imperfections = field(default_factory=Imperfections)


def raw_path(trial: Trial, recorder: str) -> str:
    """Path of a trial's raw file, from the campaign's folder."""
    return f"raw/{trial.name}.csv" if recorder == MAIN else f"raw/{trial.name}-{recorder}.csv"


def perform(plan: Plan, trial: Trial, folder: Path, seed: np.random.SeedSequence) -> dict[str, Any]:
    """
    Perform one test: write its raw files, and its true angle beside them.

    Parameters
    ----------
    plan : Plan
    trial : Trial
    folder : Path
        The campaign's folder; raw files go to `raw/`, the true angle to `truth/<name>.csv`.
    seed : numpy.random.SeedSequence
        Of this test alone.

    Returns
    -------
    record : dict
        What is true of the test, for truth.json.

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    generator = np.random.default_rng(seed)
    setup = plan.setups[trial.setup]
    starts = {
        name: recorder.late + (generator.uniform(-START_SCATTER, START_SCATTER) if recorder.late else 0.0)
        for name, recorder in setup.recorders.items()
    }
    clocks = {
        name: starts[name]
        + np.arange(int((trial.duration - starts[name]) * recorder.sampling_rate_hz)) / recorder.sampling_rate_hz
        for name, recorder in setup.recorders.items()
    }
    truth = simulate(
        plan.block,
        np.unique(np.concatenate(list(clocks.values()))),
        trial.table,
        restitution=plan.restitution,
        theta0=trial.theta0,
        release=trial.release,
        catch=setup.catch or pi / 2,
    )
    spikes = _draw_spikes(trial, setup, clocks, generator)
    errors = {}
    for name, recorder in setup.recorders.items():
        angle = truth.angle[np.searchsorted(truth.time, clocks[name])]
        columns = {}
        for transducer in recorder.transducers:
            value = transducer.sense(plan.block, trial.table, clocks[name], angle)
            struck = spikes.get(transducer.channel, ())
            volts, drawn = measure(value, transducer, plan.imperfections, generator, struck)
            columns[transducer.column] = (transducer.recorded_unit, transducer.written(volts))
            errors[transducer.channel] = {
                "zero_volts": drawn.zero,
                "drift_volts": drawn.drift,
                "spikes": list(drawn.spikes),
            }
        text = delimited_text(clocks[name] - starts[name], columns, recorder.flavour)
        put(folder / raw_path(trial, name), text, recorder.flavour.encoding)

    main = np.searchsorted(truth.time, clocks[MAIN])
    rows = "".join(f"{time:.6f},{angle:.9g}\n" for time, angle in zip(clocks[MAIN], truth.angle[main], strict=True))
    put(folder / "truth" / f"{trial.name}.csv", "time_s,angle_rad\n" + rows)
    return {
        "kind": trial.kind,
        **_facts(truth),
        "pga": float(np.abs(trial.table.acceleration(clocks[MAIN])).max()),
        "theta0": trial.theta0,
        "release": trial.release,
        "recorder_starts": starts,
        "channels": errors,
    }


def _draw_spikes(
    trial: Trial, setup: Setup, clocks: Mapping[str, Array], generator: np.random.Generator
) -> dict[str, tuple[int, ...]]:
    """Samples with a spike, by channel: one in each of equal parts of the record, away from its ends."""
    wired = [
        (each.channel, clocks[name].size) for name, recorder in setup.recorders.items() for each in recorder.transducers
    ]
    drawn: dict[str, tuple[int, ...]] = {}
    for part in range(trial.spikes):
        channel, size = wired[int(generator.integers(len(wired)))]
        sample = int((part + generator.uniform(0.1, 0.9)) / trial.spikes * size)
        drawn[channel] = (*drawn.get(channel, ()), sample)
    return drawn


def _facts(truth: Truth) -> dict[str, Any]:
    """Return outcome and figures, in JSON's terms."""
    overturned = bool(np.isfinite(truth.overturning_time))
    return {
        "outcome": truth.outcome,
        "peak_ratio": truth.peak_ratio,
        "peak_time": None if overturned else float(truth.time[np.argmax(truth.amplitude)]),
        "overturning_time": truth.overturning_time if overturned else None,
        "impact_count": int(truth.impact_times.size),
    }


def write_truth(plan: Plan, records: Mapping[str, Mapping[str, Any]], folder: Path, seed: int) -> dict[str, Any]:
    """
    Write `truth/truth.json`: e, the specimen's properties, and what is true of each test.

    Returns
    -------
    truth : dict
        Its content.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    block = plan.block
    truth = {
        "seed": seed,
        "restitution": plan.restitution,
        "specimen": {
            "id": plan.specimen,
            "critical_angle": block.critical_angle,
            "pole_distance": block.pole_distance,
            "inertia": block.inertia,
            "p": block.p,
        },
        "imperfections": asdict(plan.imperfections),
        "tests": dict(records),
    }
    put(folder / "truth" / "truth.json", json.dumps(truth, indent=1, ensure_ascii=False) + "\n")
    return truth
