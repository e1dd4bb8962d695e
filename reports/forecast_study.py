"""Study of forecasts whose truth is known: `python reports/forecast_study.py [--campaigns N] [--seed N]`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from joblib import Parallel, delayed

from forecasts.campaign import PILOTS, Campaign, run_campaign
from forecasts.judging import judge
from forecasts.page import draw, page
from study import options, write_figure, write_numbers

NAME = "forecast-study"
CAMPAIGNS, TESTS, MEMBERS, SEED, WORKERS = 48, 10, 50, 40, 2


def run_campaigns(campaigns: int, tests: int, members: int, seed: int, workers: int) -> list[Campaign]:
    """Run so many campaigns with so many tests each, every test forecast by so many members."""
    pool = Parallel(n_jobs=workers)
    return list(pool(delayed(run_campaign)(seed, number, tests, members) for number in range(campaigns)))


def study(campaigns: int, seed: int, workers: int, *, tests: int = TESTS, members: int = MEMBERS) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    return {
        "campaigns": campaigns,
        "tests": tests,
        "members": members,
        "pilots": PILOTS,
        "seed": seed,
        "judged": judge(run_campaigns(campaigns, tests, members, seed, workers)),
    }


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page, numbers and figure into a folder."""
    write_numbers(folder / f"{NAME}.json", found)
    (folder / f"{NAME}.md").write_text(page(found, f"{NAME}.svg"), encoding="utf-8")
    title = "Reliability of forecasts of overturning, and PIT of their amplitudes"
    described = "Frequency of overturning over its forecast probability, and the share of tests up to each PIT value."
    write_figure(folder / f"{NAME}.svg", draw(found), title, described)


def main() -> None:
    """Run the study and write page, numbers and figure."""
    told = options(__doc__, campaigns=CAMPAIGNS, seed=SEED, workers=WORKERS)
    write(study(told.campaigns, told.seed, told.workers), told.folder)


if __name__ == "__main__":
    main()
