"""Study of the paper's misfit at Span 2.5: `python reports/span_study.py [--workers N] [--kept FOLDER]`."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from span_two_and_a_half import controls, in_space, sensitivity, telling
from span_two_and_a_half.counting import Strata, likelihoods, of_view, pattern
from span_two_and_a_half.design import (
    ABOUT,
    BOTH,
    EVERY,
    MODELS,
    MORE_SWEEPS,
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
from span_two_and_a_half.members import FORWARD, Judged
from span_two_and_a_half.running import Runner, run_cells
from span_two_and_a_half.space import run_in_space
from span_two_and_a_half.trial import SIGNED, draw
from study import HERE, write_numbers

NAME = "span-2.5"
KEPT = HERE.parent / "build" / "reproduce" / "span-2.5"
WORKERS = 2
SAMPLE = 120
"""Number of the highest intensities, whose members the test runs again."""


@dataclass(frozen=True)
class Size:
    """How much is run; the default is the study."""

    steps: int = STEPS
    sweeps: int = SWEEPS
    more: int = MORE_SWEEPS
    space_members: int = SPACE_MEMBERS
    looked_again: int = 10
    repeated_more: int = 8


def study(runner: Runner, size: Size) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    found, agree = run_cells(runner, steps=size.steps, sweeps=size.sweeps, more=size.more)
    strata = Strata(intensities()[:: STEPS // size.steps], agree)
    jobs = in_space.plan(strata, size.space_members)
    some = strata.levels[:: max(size.steps // 96, 1)]
    return {
        "seed": SEED,
        "members": sum(each.number.size for each in found.values()),
        "agreeing": [int(agree.sum()), int(agree.size)],
        "rows": likelihoods(found, strata),
        "space": in_space.rows(jobs, runner.map(run_in_space, jobs), strata),
        "signs": signs(found),
        "parted": parting(found),
        "sample": sample(found, size),
        "example": example(found),
        "neighbours": runner.map(sensitivity.neighbours, [(some,)])[0],
        "horizons": runner.map(sensitivity.horizons, [(some[::4],)])[0],
        "engines": look_again(runner, found, size.looked_again),
        "repeats": repeat(runner, size),
        "telling": tell(runner, found),
        "processor_s": round(runner.seconds),
    }


def sample(found: dict[Cell, Judged], size: Size) -> dict[str, Any]:
    """Keep which members of a cell grow at the highest intensities, for the test that runs them again."""
    cell, first = Cell("e", 3), max(size.steps - SAMPLE, 0)
    numbers = range(first * size.sweeps, size.steps * size.sweeps)
    return {
        "cause": cell.cause,
        "grade": cell.grade,
        "first": first,
        "sweeps": size.sweeps,
        "grown": [each for each in numbers_that_grow(found[cell]) if each in numbers],
    }


def parting(found: dict[Cell, Judged]) -> list[float]:
    """Give when measured and predicted first differ by 0.05 α in members that grow, s: quantiles 5, 50, 95 %."""
    times = [judged.parted[of_view(judged.grown[:, 0, FORWARD], MODELS[-1]), -1] for judged in found.values()]
    together = np.concatenate(times)
    return [round(float(each), 2) for each in np.quantile(together, (0.05, 0.5, 0.95))] if together.size else []


def signs(found: dict[Cell, Judged]) -> dict[str, list[int]]:
    """Count the members that grow (nonlinear prediction), by cause: whose true value is too large, and all."""
    counted: dict[str, list[int]] = {}
    for cell, judged in found.items():
        if cell.cause in SIGNED and cell.cause not in ("offset", "drift"):
            drawn = [draw(cell, number) for number in numbers_that_grow(judged)]
            positive = sum(getattr(each, cell.cause.replace(" ", "_")) > 0.0 for each in drawn)
            before = counted.setdefault(cell.cause, [0, 0])
            before[0], before[1] = before[0] + positive, before[1] + len(drawn)
    return counted


def numbers_that_grow(judged: Judged) -> list[int]:
    """Give the numbers of the members whose nonlinear prediction grows at Span 2.5."""
    return sorted(judged.number[of_view(judged.grown[:, 0, FORWARD], MODELS[-1])].tolist())


def example(found: dict[Cell, Judged]) -> dict[str, Any] | None:
    """Take the member for the figure: the pattern nearest to 6 s, in both predictions if one is at "about 6 s"."""
    best: dict[str, Any] | None = None
    for view in (BOTH, MODELS[-1]):
        for scope in (EVERY, ONLY):
            for cell, judged in found.items():
                shown = np.flatnonzero(pattern(judged, view=view, scope=scope, direction=FORWARD))
                if shown.size == 0:
                    continue
                away = np.abs(judged.place[shown, FORWARD, -1] - np.mean(ABOUT))
                member = int(shown[np.argmin(away)])
                if best is None or away.min() < best["away"]:
                    best = {
                        "cause": cell.cause,
                        "grade": cell.grade,
                        "scope": scope,
                        "view": view,
                        "number": int(judged.number[member]),
                        "intensity": float(judged.intensity[member]),
                        "away": round(float(away.min()), 3),
                    }
        if best is not None and best["away"] <= np.ptp(ABOUT) / 2:
            break
    return best


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
    rows = []
    for name, (seed, series, scale) in controls.other_runs().items():
        found, agree = run_cells(
            runner,
            steps=size.steps,
            sweeps=1,
            more=size.repeated_more,
            chosen=controls.CELLS,
            other=(seed, series, scale),
        )
        strata = Strata(intensities()[:: STEPS // size.steps], agree)
        rows += [controls.counted(name, cell, judged, strata) for cell, judged in found.items()]
    return rows


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
    write_numbers(folder / f"{NAME}.json", found)
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
