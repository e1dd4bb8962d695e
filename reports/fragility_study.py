"""Study of fragility curves whose truth is known: `python reports/fragility_study.py [--repetitions N] [--seed N]`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from fragilities.page import page
from fragilities.population import Population
from fragilities.trial import run
from study import options, write_numbers

NAME = "fragility-study"
REPETITIONS, SEED, WORKERS = 500, 2015, 2

POPULATIONS = {
    "30 records, 10 draws, β 0.40 and 0.15": Population(),
    "20 records, 10 draws, β 0.40 and 0.15": Population(records=20),
    "40 records, 5 draws, β 0.30 and 0.30": Population(records=40, draws=5, of_records=0.3, of_parameters=0.3),
    "12 records, 10 draws, 8 levels, β 0.40 and 0.20": Population(records=12, levels=8, of_parameters=0.2),
    **{
        f"{records} records, 1 draw, {levels} levels, β 0.40": Population(records, 1, levels, of_parameters=0.0)
        for records in (6, 10, 20, 50, 100)
        for levels in (6, 12)
    },
    "two kinds, 30 records": Population(two_kinds=True),
    "two kinds, 20 records": Population(records=20, two_kinds=True),
}


def study(repetitions: int, seed: int, workers: int) -> dict[str, Any]:
    """Run all repetitions of all populations, and gather what the page gives."""
    pool = Parallel(n_jobs=workers, batch_size=4)
    designs = {}
    for name, population in POPULATIONS.items():
        held = list(pool(delayed(run)(population, seed, number) for number in range(repetitions)))
        shares = {key: share_of([each[key] for each in held]) for key in held[0]}
        designs[name] = {"population": asdict(population), "shares": shares}
    return {"repetitions": repetitions, "seed": seed, "designs": designs}


def share_of(held: list[bool | None]) -> float | None:
    """Share of the intervals given that hold; None if none is given."""
    given = [each for each in held if each is not None]
    return float(np.mean(given)) if given else None


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page and numbers into a folder."""
    write_numbers(folder / f"{NAME}.json", found)
    (folder / f"{NAME}.md").write_text(page(found), encoding="utf-8")


def main() -> None:
    """Run the study and write page and numbers."""
    given = options(__doc__, repetitions=REPETITIONS, seed=SEED, workers=WORKERS)
    write(study(given.repetitions, given.seed, given.workers), given.folder)


if __name__ == "__main__":
    main()
