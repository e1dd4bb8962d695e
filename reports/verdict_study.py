"""Study of the verdict "within its own spread": `python reports/verdict_study.py [--tests N] [--seed N]`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from joblib import Parallel, delayed

from colonnade.campaign.settings import EnsembleSettings
from spread_verdicts.judging import judge
from spread_verdicts.page import draw_ranks, page
from spread_verdicts.trial import Trial, run
from study import options, write_figure, write_numbers

NAME = "verdict-study"
TESTS, SEED, WORKERS = 1000, 22, 2
WRONG = 0.01
"""Error of e for the power."""

OTHER_MEMBERS = (20, 50, 200)
"""Runs of an ensemble, beside the default."""

SHARE = 5
"""Of the tests, one in so many is repeated with other numbers of runs."""


def run_trials(tests: int, seed: int, wrong: float, members: int, workers: int) -> list[Trial]:
    """Run so many tests around an e that is wrong by so much."""
    pool = Parallel(n_jobs=workers, batch_size=8)
    return list(pool(delayed(run)(seed, number, wrong, members) for number in range(tests)))


def study(tests: int, seed: int, workers: int) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    members = EnsembleSettings().members
    whole = {wrong: run_trials(tests, seed, wrong, members, workers) for wrong in (0.0, WRONG)}
    counts = []
    for number in sorted((*OTHER_MEMBERS, members)):
        part = {
            wrong: whole[wrong][: tests // SHARE]
            if number == members
            else run_trials(tests // SHARE, seed, wrong, number, workers)
            for wrong in (0.0, WRONG)
        }
        counts.append({"members": number, **judge(part[0.0], part[WRONG], number)})
    kinds = dict.fromkeys(trial.kind for trial in whole[0.0])
    return {
        "tests": tests,
        "seed": seed,
        "members": members,
        "wrong": WRONG,
        "all": judge(whole[0.0], whole[WRONG], members),
        "kinds": [
            {
                "kind": kind,
                **judge(*([trial for trial in whole[wrong] if trial.kind == kind] for wrong in (0.0, WRONG)), members),
            }
            for kind in kinds
        ],
        "counts": counts,
        "ranks": {name: [round(trial.rank, 4) for trial in whole[wrong]] for name, wrong in _NAMES.items()},
    }


_NAMES = {"true": 0.0, "wrong": WRONG}


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page, numbers and figure into a folder."""
    write_numbers(folder / f"{NAME}.json", found)
    (folder / f"{NAME}.md").write_text(page(found, f"{NAME}.svg"), encoding="utf-8")
    title = "Ranks of measured histories among the runs of a model"
    described = "Share of the tests up to each rank: under a true model, and with an e that is wrong."
    write_figure(folder / f"{NAME}.svg", draw_ranks(found), title, described)


def main() -> None:
    """Run the study and write page, numbers and figure."""
    told = options(__doc__, tests=TESTS, seed=SEED, workers=WORKERS)
    write(study(told.tests, told.seed, told.workers), told.folder)


if __name__ == "__main__":
    main()
