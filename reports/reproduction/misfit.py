"""What turns rocking three-dimensional: the misfits that the study of the contact model found, judged."""

from __future__ import annotations

from math import exp, log
from typing import Any

VISIBLE = 0.05
"""Of α: a misfit that is seen in a figure of θ(t)/α."""

WORSE = 2.0
"""Times what a disturbance adds to the prism's misfit: so much more for both round bodies is the paper's order."""

ROUND = ("cylinder", "cone")


def added(runs: list[Any], release: float, specimen: str, kind: str) -> list[tuple[float, float]]:
    """Give by size what a disturbance adds to a specimen's misfit, of α."""
    mine = [run for run in runs if (run["release"], run["specimen"]) == (release, specimen)]
    plain = next(run["misfit"]["nonlinear"] for run in mine if run["kind"] == "none")
    return [(run["size"], run["misfit"]["nonlinear"] - plain) for run in mine if run["kind"] == kind]


def visible_from(rows: list[tuple[float, float]]) -> float | None:
    """Give the size from which the added misfit is seen, between two sizes by powers; None where none reaches it."""
    before: tuple[float, float] | None = None
    for size, misfit in rows:
        if misfit >= VISIBLE:
            if before is None or before[1] <= 0.0:
                return size
            share = log(VISIBLE / before[1]) / log(misfit / before[1])
            return exp(log(before[0]) + share * log(size / before[0]))
        before = size, misfit
    return None


def judged(runs: list[Any], release: float) -> dict[str, tuple[float | None, float]]:
    """
    Give by disturbance the size from which both round bodies have the paper's misfit, and the prism's up to there.

    The prism's is the largest up to the first of its sizes that is as large. None instead of the size if a round body
    never has that misfit, or the prism's is not `WORSE` times less.
    """
    found = {}
    for kind in dict.fromkeys(run["kind"] for run in runs if run["kind"] != "none"):
        prism = added(runs, release, "prism", kind) or [(0.0, 0.0)]
        sizes = [visible_from(added(runs, release, specimen, kind)) for specimen in ROUND]
        needed = None if None in sizes else max(size for size in sizes if size is not None)
        beyond = min((size for size, _ in prism if needed is not None and size >= needed), default=prism[-1][0])
        largest = max(misfit for size, misfit in prism if size <= beyond)
        kept = needed if needed is not None and largest <= VISIBLE / WORSE else None
        found[kind] = kept, largest
    return found
