"""Study of the paper's misfit at Span 2.5: `python reports/span_study.py [--workers N] [--kept FOLDER]`."""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from span_two_and_a_half import controls, sensitivity, strata, telling
from span_two_and_a_half.counting import likelihoods, of_view, pattern
from span_two_and_a_half.design import (
    BOTH,
    EVERY,
    MODELS,
    ONLY,
    SEED,
    SPACE_MEMBERS,
    STEPS,
    SWEEPS,
    Cell,
    cells,
    intensities,
)
from span_two_and_a_half.fixed import text as fixed_text
from span_two_and_a_half.members import FORWARD, Judged, run_members
from span_two_and_a_half.running import Runner, run_cells
from span_two_and_a_half.space import run_in_space

HERE = Path(__file__).resolve().parent
NAME = "span-2.5"
KEPT = HERE.parent / "build" / "reproduce" / "span-2.5"
WORKERS = 2


@dataclass(frozen=True)
class Size:
    """How much is run; the default is the study."""

    steps: int = STEPS
    sweeps: int = SWEEPS
    space_members: int = SPACE_MEMBERS
    looked_again: int = 40
    repeated_sweeps: int = 2


def study(runner: Runner, size: Size) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    found = run_cells(runner, steps=size.steps, sweeps=size.sweeps)
    first = strata.first_stratum(found)
    jobs = strata.plan(first, size.space_members)
    in_space = runner.map(run_in_space, jobs)
    some = intensities()[STEPS // 96 // 2 :: max(STEPS // 96, STEPS // size.steps)]
    return {
        "seed": SEED,
        "members": sum(each.number.size for each in found.values()),
        "rows": likelihoods(found),
        "space": strata.rows(jobs, in_space, first),
        "first_stratum": round(float(first.mean()), 4),
        "example": example(found),
        "neighbours": runner.map(sensitivity.neighbours, [(some,)])[0],
        "horizons": runner.map(sensitivity.horizons, [(some[::4],)])[0],
        "engines": look_again(runner, found, size.looked_again),
        "repeats": repeat(runner, size),
        "telling": tell(runner, found),
        "processor_s": round(runner.seconds),
    }


def example(found: dict[Cell, Judged]) -> dict[str, Any] | None:
    """Take the member for the figure: the first with the whole pattern in both predictions, else in one of them."""
    for view, scope in ((BOTH, EVERY), (BOTH, ONLY), ("nonlinear", EVERY), ("nonlinear", ONLY)):
        for cell, judged in found.items():
            shown = np.flatnonzero(pattern(judged, view=view, scope=scope, direction=FORWARD))
            if shown.size:
                member = int(shown[0])
                return {
                    "cause": cell.cause,
                    "grade": cell.grade,
                    "scope": scope,
                    "view": view,
                    "number": int(judged.number[member]),
                    "intensity": float(judged.intensity[member]),
                }
    return None


def grown_members(found: dict[Cell, Judged], most: int, model: str = MODELS[-1]) -> dict[Cell, list[tuple[int, float]]]:
    """Give by cell the first members whose prediction by a model grows at Span 2.5: number and intensity."""
    chosen = {}
    for cell, judged in found.items():
        shown = np.flatnonzero(of_view(judged.grown[:, 0, FORWARD], model))[:most]
        chosen[cell] = [(int(judged.number[each]), float(judged.intensity[each])) for each in shown]
    return chosen


def look_again(runner: Runner, found: dict[Cell, Judged], most: int) -> dict[str, Any]:
    """Look at members that grow, and at as many others, with other engines."""
    jobs = []
    for cell in controls.CELLS:
        if cell not in found:
            continue
        judged = found[cell]
        jobs += [(cell, *each) for each in grown_members({cell: judged}, most)[cell]]
        others = np.flatnonzero(~judged.grown[:, 0, FORWARD].any(axis=-1))
        for each in others[:: max(others.size // most, 1)][:most]:
            jobs.append((cell, int(judged.number[each]), float(judged.intensity[each])))
    return controls.summarised(runner.map(controls.engines, jobs))


def repeat(runner: Runner, size: Size) -> list[dict[str, Any]]:
    """Run some cells with another seed, series of the record and time scale."""
    levels = intensities()[:: STEPS // size.steps]
    rows = []
    for name, (seed, series, scale) in controls.other_runs().items():
        jobs = [
            (cell, levels[start : start + 60], start * size.repeated_sweeps, size.repeated_sweeps, seed, series, scale)
            for cell in controls.CELLS
            for start in range(0, levels.size, 60)
        ]
        counted: dict[tuple[str, int], list[Judged]] = {}
        for job, judged in zip(jobs, runner.map(run_other, jobs), strict=True):
            counted.setdefault((job[0].cause, job[0].grade), []).append(judged)
        rows += [controls.counted(name, *cell, judged) for cell, judged in counted.items()]
    return rows


def run_other(cell: Cell, levels: np.ndarray, first: int, sweeps: int, seed: int, series: str, scale: float) -> Judged:
    """Run members with another seed, series or time scale."""
    return run_members(cell, levels, first, sweeps, seed=seed, shape=controls.other_motion(series, scale))


def tell(runner: Runner, found: dict[Cell, Judged]) -> list[dict[str, Any]]:
    """Simulate further measurements for members in which Span 2.5 misbehaves."""
    chosen = grown_members(found, telling.MEMBERS)
    jobs = [(cell, *each) for cell, members in chosen.items() for each in members]
    told = runner.map(telling.tell, jobs)
    return [
        {
            "cause": cell.cause,
            "grade": cell.grade,
            **telling.summarised([each for job, each in zip(jobs, told, strict=True) if job[0] == cell]),
        }
        for cell in chosen
        if cell in cells()
    ]


def write(found: dict[str, Any], folder: Path) -> None:
    """Write pages, numbers and figures into a folder."""
    from span_two_and_a_half.drawings import draw_all
    from span_two_and_a_half.page import page

    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{NAME}.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    (folder / f"{NAME}.md").write_text(page(found), encoding="utf-8")
    (folder / f"{NAME}-design.md").write_text(fixed_text(), encoding="utf-8")
    for name, text in draw_all(found).items():
        (folder / name).write_text(text, encoding="utf-8")


def main() -> None:
    """Run the study and write pages, numbers and figures; what was run before by the same code is not run again."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=WORKERS)
    parser.add_argument("--kept", type=Path, default=KEPT, help="where results of blocks are kept")
    parser.add_argument("--folder", type=Path, default=HERE / "manos", help="where the results go")
    told = parser.parse_args()
    write(study(Runner(told.kept, told.workers), Size()), told.folder)


if __name__ == "__main__":
    main()
