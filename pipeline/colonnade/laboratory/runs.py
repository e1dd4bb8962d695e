"""Writes virtual campaigns: each test is simulated and measured, and results are compared with the truth."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from math import pi
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

from colonnade.arrays import Array
from colonnade.laboratory.campaign_file import FILE_NAME, campaign_text, refuse_foreign
from colonnade.laboratory.experiment import MAIN, Plan, Setup, Trial, begun, raw_path
from colonnade.laboratory.files import Sheet, put
from colonnade.laboratory.programme import load_record, prism_programme
from colonnade.laboratory.site import add_site
from colonnade.laboratory.table import measure
from colonnade.laboratory.truth import Truth, simulate

Result = TypeVar("Result")

START_SCATTER = 1e-3
"""A recorder that starts late does so within ± this, s: no two starts are alike."""


@dataclass(frozen=True)
class WrittenCampaign:
    """
    A virtual campaign on disk.

    Attributes
    ----------
    path : Path
        Its campaign.toml.
    truth : dict
        What truth/truth.json next to it holds: by specimen `restitution` and more, by test `outcome`, `peak_ratio` and
        more. The true angle of each test is in the same folder.
    """

    path: Path
    truth: dict[str, Any]


def write_campaign(
    folder: Path | str,
    *,
    seed: int = 0,
    motion: Path | None = None,
    programme: Callable[..., Plan] | None = None,
    workers: int | None = 1,
    site: bool = False,
) -> WrittenCampaign:
    """
    Write a virtual campaign.

    Parameters
    ----------
    folder : Path or str
        Folder of campaign.toml, raw/ and truth/; made if necessary.
    seed : int, optional
        Of noise, offsets, spikes and the exact releases. The same seed gives the same files.
    motion : Path, optional
        File with the earthquake record; default: El Centro 1940 NS of the extra `demo`.
    programme : callable, optional
        `paper_programme`, or `prism_programme`, the default: its prism's ten tests.
    workers : int or None, optional
        Processes; None takes one a core.
    site : bool, optional
        Also ask whether the real columns stand, on synthetic ground motions.

    Returns
    -------
    written : WrittenCampaign

    Raises
    ------
    ReadError
        If the record is missing or cannot be read.
    CampaignError
        If the folder holds a campaign that the laboratory did not write.
    StoreError
        If a file cannot be written.
    """
    name, record = load_record(motion)
    plan = (programme or prism_programme)(name, record, seed=seed)
    written = write(plan, folder, seed=seed, workers=workers)
    if site:
        add_site(plan, written.path, seed=seed)
    return written


def write(plan: Plan, folder: Path | str, *, seed: int = 0, workers: int | None = 1) -> WrittenCampaign:
    """Run a plan: write its raw files, its truth and its campaign file; see `write_campaign`."""
    folder = Path(folder)
    refuse_foreign(folder)
    truth = truth_of(plan, run_tests(plan, folder, seed, workers), seed)
    put(folder / FILE_NAME, campaign_text(plan).encode())
    return with_its_truth(folder, truth)


def with_its_truth(folder: Path, truth: dict[str, Any]) -> WrittenCampaign:
    """Write truth/truth.json next to a campaign that was written."""
    put(folder / "truth" / "truth.json", (json.dumps(truth, indent=1, ensure_ascii=False) + "\n").encode())
    return WrittenCampaign(folder / FILE_NAME, truth)


def run_tests(plan: Plan, folder: Path, seed: int, workers: int | None) -> dict[str, dict[str, Any]]:
    """Run all tests of a plan, each with a seed of its own, in so many processes; return records by test."""
    seeds = np.random.SeedSequence(seed).spawn(len(plan.trials))
    # Workers that were left waiting may have started in another folder.
    done = spread_over(workers, partial(run_test, plan), plan.trials, [folder.absolute()] * len(seeds), seeds)
    return {trial.name: record for trial, record in zip(plan.trials, done, strict=True)}


def spread_over(workers: int | None, function: Callable[..., Result], *arguments: Collection[Any]) -> Iterable[Result]:
    """Call a function with each of several arguments, as `map` does, in so many processes; None takes one a core."""
    from joblib import Parallel, cpu_count, delayed

    count = min(workers or cpu_count(), len(arguments[0]))
    calls = (delayed(function)(*each) for each in zip(*arguments, strict=True))
    return cast(list[Result], Parallel(count, max_nbytes=None)(calls))


def run_test(plan: Plan, trial: Trial, folder: Path, seed: np.random.SeedSequence) -> dict[str, Any]:
    """Run one test: write its raw files and its true angle; return what is true of it, for truth.json."""
    generator = np.random.default_rng(seed)
    setup, specimen = plan.setups[trial.setup], plan.specimens[plan.specimen_of(trial)]
    starts, clocks = {}, {}
    for name, recorder in setup.recorders.items():
        scatter = generator.uniform(-START_SCATTER, START_SCATTER) if recorder.late else 0.0
        starts[name], rate = recorder.late + scatter, recorder.sampling_rate_hz
        clocks[name] = starts[name] + np.arange(int((trial.duration - starts[name]) * rate)) / rate
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
        "outcome": truth.outcome,
        "peak_ratio": truth.peak_ratio,
        "peak_time": truth.peak_time,
        "release_ratio": truth.release_ratio,
        "overturning_time": truth.overturning_time if np.isfinite(truth.overturning_time) else None,
        "impact_count": int(truth.impact_times.size),
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
            volts, errors[transducer.channel] = measure(value, transducer, plan.imperfections, generator, struck)
            columns[transducer.column] = (transducer.recorded_unit, transducer.written(volts))
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


def truth_of(plan: Plan, records: Mapping[str, Mapping[str, Any]], seed: int) -> dict[str, Any]:
    """Gather what is true: e and properties of each specimen, and of each test."""
    names = ("critical_angle", "pole_distance", "inertia", "p")
    return {
        "seed": seed,
        "specimens": {
            name: {"restitution": specimen.restitution} | {key: getattr(specimen.block, key) for key in names}
            for name, specimen in plan.specimens.items()
        },
        "imperfections": asdict(plan.imperfections),
        "tests": dict(records),
    }


def with_truth(truth: Mapping[str, Any], summary: Path) -> dict[str, Any]:
    """Put what a run found next to what is true: e by specimen; outcome, peak, release by test."""
    read = json.loads(summary.read_text(encoding="utf-8"))
    tests: dict[str, dict[str, Any]] = {}
    for name, true in truth["tests"].items():
        found = read["tests"][name]
        tests[name] = {"predicted": found["predicted"]}
        for key in ("outcome", "peak_ratio", "release_ratio"):
            tests[name] |= {f"true_{key}": true[key], key: found[key]}
    restitution = {
        name: {"true": true["restitution"]} | read["specimens"][name]["restitution"]
        for name, true in truth["specimens"].items()
    }
    return {"restitution": restitution, "tests": tests}
