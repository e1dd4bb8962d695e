"""Which intensities the costly members in space are run at, and likelihoods from them."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.arrays import Array, Mask
from span_two_and_a_half.counting import LEVEL, VIEWS, interval, of_view
from span_two_and_a_half.design import GRADES, SEED, SPACE, SPACE_MEMBERS, Cell, cells, intensities
from span_two_and_a_half.members import FORWARD, REVERSE, Judged
from span_two_and_a_half.space import InSpace, Setting

LIKELY = 0.8
"""Of all members of the plane models whose prediction grows at Span 2.5: the share that the first stratum holds."""

FIRST_SHARE = 2.0 / 3.0
"""Of the members of a cell in space: those drawn from the first stratum."""


def first_stratum(found: dict[Cell, Judged]) -> Mask:
    """
    Tell which intensities make the first stratum, shape (intensities,).

    They are the fewest that hold `LIKELY` of the members of the plane models in which a prediction grows, whatever the
    cause: there the members in space are worth their cost.
    """
    levels = intensities()
    counts = np.zeros(levels.size)
    for judged in found.values():
        grown = judged.grown[:, 0, FORWARD].any(axis=-1)
        counts += np.bincount(np.searchsorted(levels, judged.intensity[grown] * (1 - 1e-9)), minlength=levels.size)
    order = np.argsort(-counts, kind="stable")
    held = np.cumsum(counts[order])
    needed = int(np.searchsorted(held, LIKELY * held[-1])) + 1
    chosen = np.zeros(levels.size, dtype=bool)
    chosen[order[:needed]] = True
    return chosen


def plan(first: Mask, members: int = SPACE_MEMBERS) -> list[tuple[Cell, float, int, Setting]]:
    """Give the arguments of `run_in_space`: so many members of each cell, two thirds from the first stratum."""
    levels = intensities()
    jobs = []
    for cell in cells(SPACE):
        random = np.random.default_rng((SEED, cells(SPACE).index(cell)))
        from_first = round(FIRST_SHARE * members)
        for number in range(members):
            inside = levels[first] if number < from_first else levels[~first]
            jobs.append((cell, float(random.choice(inside)), number, Setting()))
    return jobs


def weighted(shown: Mask, in_first: Mask, weight: float) -> tuple[float, float, float]:
    """
    Estimate a share over all intensities from two strata.

    Parameters
    ----------
    shown, in_first : ndarray of bool, shape (n,)
        Whether a member shows it; whether it is from the first stratum.
    weight : float
        Share of all intensities that are in the first stratum.

    Returns
    -------
    share, low, high : float
        With limits that hold together with 95 %: each stratum has half of what may fail.
    """
    share = low = high = 0.0
    for part, each in ((in_first, weight), (~in_first, 1.0 - weight)):
        count, of = int(shown[part].sum()), int(part.sum())
        limits = interval(count, of, 1.0 - (1.0 - LEVEL) / 2.0)
        share += each * count / max(of, 1)
        low, high = low + each * limits[0], high + each * limits[1]
    return share, low, high


def rows(jobs: list[tuple[Cell, float, int, Setting]], ran: list[InSpace], first: Mask) -> list[dict[str, Any]]:
    """Give a row for each cell in space."""
    levels = intensities()
    weight = float(first.mean())
    found: dict[Cell, list[InSpace]] = {}
    for job, each in zip(jobs, ran, strict=True):
        found.setdefault(job[0], []).append(each)
    return [_row(cell, each, levels, first, weight) for cell, each in found.items()]


def _row(cell: Cell, ran: list[InSpace], levels: Array, first: Mask, weight: float) -> dict[str, Any]:
    in_first = first[np.searchsorted(levels, [each.intensity * (1 - 1e-9) for each in ran])]
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
        row[view] = {}
        for name, way in (("pattern", FORWARD), ("reverse", REVERSE)):
            alone = of_view(grown[:, way], view)
            shown = of_view(grown[:, way] & agree, view)
            row[view][name] = int(shown.sum())
            row[view][f"{name}_share"] = [round(each, 5) for each in weighted(shown, in_first, weight)]
            row[view][f"{name}_span_2.5_alone"] = [round(each, 5) for each in weighted(alone, in_first, weight)]
        row[view]["agree"] = [round(each, 4) for each in weighted(of_view(agree, view), in_first, weight)]
    return row
