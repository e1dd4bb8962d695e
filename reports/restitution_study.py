"""Monte-Carlo study of the identified restitution: `python reports/restitution_study.py [--records N] [--seed N]`."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed
from monte_carlo.design import BEYOND
from monte_carlo.levels import judge_bounds, judge_estimators, judge_levels
from monte_carlo.page import draw_levels, page
from monte_carlo.trial import Trial, run

from colonnade import figures

HERE = Path(__file__).resolve().parent
NAME = "restitution-study"
RECORDS, SEED, WORKERS = 4600, 2013, 2


def run_trials(records: int, seed: int, workers: int) -> tuple[list[Trial], list[Trial]]:
    """Run so many records of the design, and a tenth as many beyond it."""
    pool = Parallel(n_jobs=workers, batch_size=16)
    within = pool(delayed(run)(seed, number) for number in range(records))
    beyond = pool(delayed(run)(seed + 1, number, BEYOND) for number in range(max(records // 10, 1)))
    return list(within), list(beyond)


def numbers(within: list[Trial], beyond: list[Trial], seed: int) -> dict[str, Any]:
    """Everything that the page tells."""
    return {
        "records": len(within),
        "seed": seed,
        "levels": [asdict(each) for each in judge_levels(within)],
        "bounds": [
            asdict(each) for each in (*judge_bounds(within, "in the design"), *judge_bounds(beyond, "beyond it"))
        ],
        "estimators": [asdict(each) for each in judge_estimators(within)],
    }


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page, numbers and figure into a folder."""
    (folder / f"{NAME}.json").write_text(json.dumps(_rounded(found), indent=1) + "\n", encoding="utf-8")
    (folder / f"{NAME}.md").write_text(page(found, f"{NAME}.svg"), encoding="utf-8")
    title = "Bias, coverage and error of the identified restitution, level by level"
    described = "Levels of e, shape, size, release, recorder, noise, offset, length and filter; beside the naive way."
    text = figures.to_svg(draw_levels(found), identity=NAME, title=title, description=described)
    (folder / f"{NAME}.svg").write_text(text, encoding="utf-8")


def _rounded(value: Any) -> Any:
    """Numbers with four digits, and None for those that are none."""
    if isinstance(value, dict):
        return {name: _rounded(each) for name, each in value.items()}
    if isinstance(value, list):
        return [_rounded(each) for each in value]
    if isinstance(value, float):
        return float(f"{value:.4g}") if np.isfinite(value) else None
    return value


def main() -> None:
    """Run the study and write page, numbers and figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--records", type=int, default=RECORDS)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--workers", type=int, default=WORKERS)
    parser.add_argument("--folder", type=Path, default=HERE, help="where the results go")
    told = parser.parse_args()
    found = numbers(*run_trials(told.records, told.seed, told.workers), told.seed)
    write(found, told.folder)


if __name__ == "__main__":
    main()
