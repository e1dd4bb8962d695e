"""Which members in space are run, and likelihoods from them."""

from __future__ import annotations

from typing import Any

import numpy as np

from span_two_and_a_half.counting import VIEWS, Strata, of_view
from span_two_and_a_half.design import GRADES, SEED, SPACE, SPACE_MEMBERS, Cell, cells
from span_two_and_a_half.members import FORWARD, REVERSE
from span_two_and_a_half.space import InSpace, Setting

Job = tuple[Cell, float, int, Setting]


def plan(strata: Strata, members: int = SPACE_MEMBERS) -> list[Job]:
    """Give the arguments of `run_in_space`: so many members of each cell, two of three from the first part."""
    jobs = []
    for number in range(members):
        inside = strata.levels[strata.first if number % 3 < 2 else ~strata.first]
        for place, cell in enumerate(cells(SPACE)):
            random = np.random.default_rng((SEED, place, number))
            jobs.append((cell, float(random.choice(inside if inside.size else strata.levels)), number, Setting()))
    return jobs


def rows(jobs: list[Job], ran: list[InSpace], strata: Strata) -> list[dict[str, Any]]:
    """Give a row for each cell in space."""
    found: dict[Cell, list[InSpace]] = {}
    for job, each in zip(jobs, ran, strict=True):
        found.setdefault(job[0], []).append(each)
    return [_row(cell, each, strata) for cell, each in found.items()]


def _row(cell: Cell, ran: list[InSpace], strata: Strata) -> dict[str, Any]:
    intensity = np.array([each.intensity for each in ran])
    grown = np.array([each.grown[0] for each in ran])
    agree = np.array([each.agree[0] for each in ran])
    row: dict[str, Any] = {
        "cause": cell.cause,
        "grade": "" if len(SPACE[cell.cause].sizes) == 1 else GRADES[cell.grade],
        "members": len(ran),
        "slide_mm": round(1e3 * float(np.median([each.slide for each in ran])), 3),
        "out_of_plane": round(float(np.median([each.out_of_plane for each in ran])), 4),
        "yaw_degrees": round(float(np.degrees(np.median([each.yaw for each in ran]))), 3),
    }
    for view in VIEWS:
        forward = of_view(grown[:, FORWARD] & agree, view)
        row[view] = {
            "pattern": strata.counts(forward, intensity),
            "likelihood": strata.share(strata.counts(forward, intensity)),
            "reverse_likelihood": strata.share(strata.counts(of_view(grown[:, REVERSE] & agree, view), intensity)),
            "span_2.5_alone": strata.share(strata.counts(of_view(grown[:, FORWARD], view), intensity)),
        }
    return row
