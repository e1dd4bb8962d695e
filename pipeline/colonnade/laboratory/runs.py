"""Runs the tests of a virtual campaign: each is simulated, measured, and written as raw files with its truth."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.laboratory.experiment import MAIN, Plan, Setup, Trial, raw_path
from colonnade.laboratory.files import Sheet, put
from colonnade.laboratory.instruments import measure
from colonnade.laboratory.plans.schedule import begun
from colonnade.laboratory.truth import Truth, simulate

START_SCATTER = 1e-3
"""A recorder that starts late does so within ± this, s: no two starts are alike."""


def run_tests(plan: Plan, folder: Path, seed: int, workers: int | None) -> dict[str, dict[str, Any]]:
    """
    Run all tests of a plan, each with a seed of its own, in so many processes (None: one a core).

    Returns
    -------
    records : dict
        By test, what `run_test` returns.
    """
    import joblib

    seeds = np.random.SeedSequence(seed).spawn(len(plan.trials))
    count = min(workers or joblib.cpu_count(), len(plan.trials))
    jobs = [
        joblib.delayed(run_test)(plan, trial, folder, own_seed)
        for trial, own_seed in zip(plan.trials, seeds, strict=True)
    ]
    done = joblib.Parallel(n_jobs=count)(jobs)
    return {trial.name: record for trial, record in zip(plan.trials, done, strict=True)}


def run_test(plan: Plan, trial: Trial, folder: Path, seed: np.random.SeedSequence) -> dict[str, Any]:
    """
    Run one test: write its raw files and its true angle.

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
    setup, specimen = plan.setups[trial.setup], plan.specimens[plan.specimen_of(trial)]
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
        specimen.block,
        np.unique(np.concatenate(list(clocks.values()))),
        trial.table,
        restitution=specimen.restitution,
        theta0=trial.theta0,
        release=trial.release,
        catch=setup.catch or pi / 2,
    )
    errors = _record(plan, trial, truth, starts, clocks, folder, generator)
    main = np.searchsorted(truth.time, clocks[MAIN])
    rows = "".join(f"{time:.6f},{angle:.9g}\n" for time, angle in zip(clocks[MAIN], truth.angle[main], strict=True))
    put(folder / "truth" / f"{trial.name}.csv", ("time_s,angle_rad\n" + rows).encode())
    return {
        "kind": trial.kind,
        "specimen": plan.specimen_of(trial),
        **_facts(truth),
        "pga": float(np.abs(trial.table.acceleration(clocks[MAIN])).max()),
        "theta0": trial.theta0,
        "release": trial.release,
        "steady": None if trial.steady is None else list(trial.steady),
        "recorder_starts": starts,
        "channels": errors,
    }


def _record(
    plan: Plan,
    trial: Trial,
    truth: Truth,
    starts: Mapping[str, float],
    clocks: Mapping[str, Array],
    folder: Path,
    generator: np.random.Generator,
) -> dict[str, dict[str, Any]]:
    """Write what each recorder saw, each on its own clock; return the errors of its channels."""
    setup = plan.setups[trial.setup]
    spikes = _draw_spikes(trial, setup, clocks, generator)
    start = np.datetime64(begun(plan.trials.index(trial)), "us")
    errors = {}
    for name, recorder in setup.recorders.items():
        angle = truth.angle[np.searchsorted(truth.time, clocks[name])]
        columns = {}
        for transducer in recorder.transducers:
            value = transducer.sense(truth.block, trial.table, clocks[name], angle)
            struck = spikes.get(transducer.channel, ())
            volts, drawn = measure(value, transducer, plan.imperfections, generator, struck)
            columns[transducer.column] = (transducer.recorded_unit, transducer.written(volts))
            errors[transducer.channel] = {
                "zero_volts": drawn.zero,
                "drift_volts": drawn.drift,
                "spikes": list(drawn.spikes),
            }
        sheet = Sheet(clocks[name] - starts[name], recorder.sampling_rate_hz, columns, start)
        put(folder / raw_path(trial, name, recorder), recorder.flavour.content(sheet))
    return errors


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
        "peak_time": truth.peak_time,
        "release_ratio": truth.release_ratio,
        "overturning_time": truth.overturning_time if overturned else None,
        "impact_count": int(truth.impact_times.size),
    }


def write_truth(plan: Plan, records: Mapping[str, Mapping[str, Any]], folder: Path, seed: int) -> dict[str, Any]:
    """
    Write `truth/truth.json`: e and properties of each specimen, and what is true of each test.

    Returns
    -------
    truth : dict
        Its content.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    truth = {
        "seed": seed,
        "specimens": {
            name: {
                "restitution": specimen.restitution,
                "critical_angle": specimen.block.critical_angle,
                "pole_distance": specimen.block.pole_distance,
                "inertia": specimen.block.inertia,
                "p": specimen.block.p,
            }
            for name, specimen in plan.specimens.items()
        },
        "imperfections": asdict(plan.imperfections),
        "tests": dict(records),
    }
    put(folder / "truth" / "truth.json", (json.dumps(truth, indent=1, ensure_ascii=False) + "\n").encode())
    return truth
