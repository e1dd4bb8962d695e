"""Writes virtual campaigns: each test is simulated and measured, and results are compared with the truth."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.campaign import FILE_NAME, Campaign, load
from colonnade.campaign.channel import MAIN
from colonnade.laboratory.files import Sheet
from colonnade.laboratory.plan import Plan, Trial, begun, claim
from colonnade.laboratory.programme import load_record, prism_programme
from colonnade.laboratory.table import measure, sense
from colonnade.laboratory.truth import simulate
from colonnade.store.files import write_changed, write_text

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
    return write((programme or prism_programme)(name, record, seed=seed), folder, seed=seed, workers=workers)


def write(plan: Plan, folder: Path | str, *, seed: int = 0, workers: int | None = 1) -> WrittenCampaign:
    """Run a plan: write its campaign file, its raw files and its truth; see `write_campaign`."""
    done = shake(folder, plan.campaign_text(), partial(run_test, plan), plan.trials, seed=seed, workers=workers)
    specimens = {name: {"restitution": restitution} for name, restitution in plan.restitution.items()}
    records = {trial.name: record for trial, record in zip(plan.trials, done, strict=True)}
    return with_its_truth(folder, {"seed": seed, "specimens": specimens, "tests": records})


def shake(
    folder: Path | str, text: str, one: Callable[..., Any], asked: Collection[Any], *, seed: int, workers: int | None
) -> list[Any]:
    """Write the campaign file, and record each of what is asked with a seed of its own; `workers` None: one a core."""
    from joblib import Parallel, cpu_count, delayed

    claim(Path(folder))
    write_text(Path(folder, FILE_NAME), text)
    campaign = load(Path(folder).absolute())  # as workers that were left waiting may have started in another folder
    seeds = np.random.SeedSequence(seed).spawn(len(asked))
    calls = (delayed(one)(campaign, each, own) for each, own in zip(asked, seeds, strict=True))
    return list(Parallel(min(workers or cpu_count(), len(asked)), max_nbytes=None)(calls))


def with_its_truth(folder: Path | str, truth: dict[str, Any]) -> WrittenCampaign:
    """Write truth/truth.json next to a campaign that was written."""
    write_text(Path(folder, "truth", "truth.json"), json.dumps(truth, indent=1, ensure_ascii=False) + "\n")
    return WrittenCampaign(Path(folder, FILE_NAME), truth)


def run_test(plan: Plan, campaign: Campaign, trial: Trial, seed: np.random.SeedSequence) -> dict[str, Any]:
    """Run one test: write its raw files and its true angle; return what is true of it, for truth.json."""
    generator, test = np.random.default_rng(seed), campaign.tests[trial.name]
    starts, clocks = {}, {}
    for name, recorder in plan.recorders[trial.setup].items():
        scatter = generator.uniform(-START_SCATTER, START_SCATTER) if recorder.late else 0.0
        starts[name], rate = recorder.late + scatter, recorder.sampling_rate_hz
        clocks[name] = starts[name] + np.arange(int((trial.duration - starts[name]) * rate)) / rate
    truth = simulate(
        campaign.block(test.specimen),
        np.unique(np.concatenate(list(clocks.values()))),
        trial.table,
        restitution=plan.restitution[test.specimen],
        theta0=trial.theta0,
        release=trial.release,
        catch=campaign.setups[trial.setup].catch or pi / 2,
    )
    angles = {name: truth.angle[np.searchsorted(truth.time, clock)] for name, clock in clocks.items()}
    channels = campaign.channels(test)
    wired = [(key, clocks[channel.recorder].size) for key, channel in channels.items()]
    spikes = _draw_spikes(trial.spikes, wired, generator)
    start = np.datetime64(begun(plan.trials.index(trial)), "us")
    for name, recorder in plan.recorders[trial.setup].items():
        columns = {}
        for key, channel in channels.items():
            if channel.recorder == name:
                value = sense(channel, truth.block, trial.table, clocks[name], angles[name])
                written = measure(value, channel, plan.imperfections, generator, spikes.get(key, ()))
                columns[str(channel.column)] = (channel.unit or "", written)
        sheet = Sheet(clocks[name] - starts[name], recorder.sampling_rate_hz, columns, start)
        write_changed(test.files[name], recorder.format.content(sheet))
    rows = "".join(f"{time:.6f},{angle:.9g}\n" for time, angle in zip(clocks[MAIN], angles[MAIN], strict=True))
    write_text(campaign.folder / "truth" / f"{trial.name}.csv", "time_s,angle_rad\n" + rows)
    peak_ratio, peak_time = truth.peak
    return {
        "kind": trial.kind,
        "specimen": test.specimen,
        "outcome": truth.outcome,
        "peak_ratio": peak_ratio,
        "peak_time": peak_time,
        "release_ratio": float(truth.amplitude[0]) if truth.angle[0] != 0.0 else None,
        "recorder_starts": starts,
    }


def _draw_spikes(
    count: int, wired: Sequence[tuple[str, int]], generator: np.random.Generator
) -> dict[str, tuple[int, ...]]:
    """Samples with a spike, by channel: one in each of equal parts of the record, away from its ends."""
    drawn: dict[str, tuple[int, ...]] = {}
    for part in range(count):
        channel, size = wired[int(generator.integers(len(wired)))]
        sample = int((part + generator.uniform(0.1, 0.9)) / count * size)
        drawn[channel] = (*drawn.get(channel, ()), sample)
    return drawn


def with_truth(truth: Mapping[str, Any], summary: Path) -> dict[str, Any]:
    """
    Put what a run found next to what is true.

    Of a specimen e, of a test its outcome, peak and release; of one of several bodies the one that moved farthest.
    """
    read = json.loads(summary.read_text(encoding="utf-8"))
    tests: dict[str, dict[str, Any]] = {}
    for name, true in truth["tests"].items():
        found = read["tests"][name]
        tests[name] = {"predicted": found["predicted"]}
        for key in ("outcome", "peak_ratio", "release_ratio"):
            tests[name] |= {f"true_{key}": true[key], key: found[key]} if key in true else {}
        stood = {body: _moved(each) for body, each in true.get("bodies", {}).items() if each["outcome"] != "overturned"}
        bodies = found.get("bodies", {})
        measured = [body for body in stood if body in bodies and bodies[body]["residual_x"] is not None]
        if farthest := max(measured, key=lambda body: stood[body], default=None):
            tests[name] |= {"body": farthest, "moved": _moved(bodies[farthest]), "true_moved": stood[farthest]}
    restitution = {
        name: {"true": true["restitution"]} | read["specimens"][name]["restitution"]
        for name, true in truth.get("specimens", {}).items()
    }
    return {"restitution": restitution, "tests": tests} if restitution else {"tests": tests}


def _moved(body: Mapping[str, Any]) -> float:
    return float(np.hypot(body["residual_x"], body["residual_y"]))
