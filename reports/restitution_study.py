"""Monte-Carlo study of the identified restitution: `python reports/restitution_study.py [--records N] [--seed N]`."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from monte_carlo.design import BEYOND, SPREAD, Draw, draw
from monte_carlo.levels import judge, judge_bounds, judge_estimators, judge_kinds, judge_levels
from monte_carlo.page import draw_levels, page
from monte_carlo.trial import Trial, run, tried
from study import options, rounded, write_figure, write_numbers

NAME = "restitution-study"
RECORDS, SEED, WORKERS = 5000, 2013, 2

BY_SPEED = -0.02
"""Change of e from the slowest to the fastest impact, in the records where it depends on the speed."""

DRIFT = 0.02
"""Of the zero over the record, in α, in the records where it drifts."""


def run_trials(records: int, seed: int, workers: int) -> dict[str, list[Trial]]:
    """Run so many records of the design, a tenth as many beyond it, and some of blocks that are not of one e."""
    pool, some = Parallel(n_jobs=workers, batch_size=16), max(records // 16, 1)
    return {
        "design": list(pool(delayed(run)(seed, number) for number in range(records))),
        "beyond": list(pool(delayed(run)(seed + 1, number, BEYOND) for number in range(max(records // 10, 1)))),
        "speed": list(pool(delayed(run_by_speed)(seed + 2, number) for number in range(some))),
        "drift": list(pool(delayed(run)(seed + 3, number, drift=DRIFT) for number in range(some))),
    }


def run_by_speed(seed: int, number: int) -> Trial:
    """Run a record whose e changes by `BY_SPEED` over the speeds of its impacts."""
    return tried(changing(draw(seed, number)))


def changing(drawn: Draw) -> Draw:
    """Let e change by `BY_SPEED` from the slowest to the fastest impact of a record, about the mean that was drawn."""
    # At the slowest impact, too, e is below 1.
    restitution = min(drawn.restitution, 1 - SPREAD * drawn.scatter - 1e-3 - abs(BY_SPEED))
    fastest = np.sqrt(drawn.release * (2 - drawn.release))
    speeds = fastest * restitution ** np.arange(drawn.impacts)
    by_speed = BY_SPEED / float(np.ptp(speeds))
    return replace(drawn, restitution=restitution, by_speed=by_speed, mean_speed=float(speeds.mean()))


def numbers(trials: dict[str, list[Trial]], seed: int) -> dict[str, Any]:
    """Everything that the page tells."""
    within, beyond = trials["design"], trials["beyond"]
    apart = {kind: trials[kind] for kind in ("speed", "drift")}
    return {
        "records": len(within),
        "seed": seed,
        "by_speed": BY_SPEED,
        "drift": DRIFT,
        "levels": [asdict(each) for each in judge_levels(within)],
        "kinds": [asdict(each) for each in judge_kinds(within)],
        "departures": [asdict(judge(those, kind, "all")) for kind, those in apart.items()],
        "named": {
            kind: dict(Counter(name for each in those for name in each.departures)) for kind, those in apart.items()
        },
        "bounds": [
            asdict(each) for each in (*judge_bounds(within, "in the design"), *judge_bounds(beyond, "beyond it"))
        ],
        "estimators": [asdict(each) for each in judge_estimators(within)],
    }


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page, numbers and figure into a folder."""
    write_numbers(folder / f"{NAME}.json", rounded(found, 4))
    (folder / f"{NAME}.md").write_text(page(found, f"{NAME}.svg"), encoding="utf-8")
    title = "Bias, coverage and error of the identified restitution, level by level"
    described = "Levels of e, shape, size, release, recorder, noise, offset, length and filter; beside the naive way."
    write_figure(folder / f"{NAME}.svg", draw_levels(found), title, described)


def main() -> None:
    """Run the study and write page, numbers and figure."""
    told = options(__doc__, records=RECORDS, seed=SEED, workers=WORKERS)
    found = numbers(run_trials(told.records, told.seed, told.workers), told.seed)
    write(found, told.folder)


if __name__ == "__main__":
    main()
