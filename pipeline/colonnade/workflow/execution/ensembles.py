"""A large ensemble in independent parts, on processes of this machine or on a Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import ceil

from colonnade.dynamics.ensembles.ensemble import Ensemble, Part, Plan, gather, run_members
from colonnade.workflow.execution.spreading import spread

FEWEST = 64
"""Members of a part, where there are so many: a part's counts take longer to send than a few members to run."""

MOST_PARTS = 16
"""Of an ensemble: the counts of each are sent whole, up to 45 MB."""


def run_ensemble(plan: Plan, *, workers: int | None = None, scheduler: str | None = None) -> Ensemble:
    """
    Run an ensemble in parts.

    Parameters
    ----------
    plan : Plan
    workers, scheduler : optional
        As of `spread`.

    Returns
    -------
    ensemble : Ensemble
        The same bit for bit as of `dynamics.ensembles.ensemble`, whatever the workers: each member has a stream of its
        own, and counts are whole numbers.

    Raises
    ------
    ValueError
        If an argument of the plan is out of its range.
    ColonnadeError
        If workers fail, or the cluster is not there.
    """
    size = max(ceil(plan.count / MOST_PARTS), FEWEST)
    parts = [(start, min(start + size, plan.count)) for start in range(0, plan.count, size)]
    results: Iterator[Part] = spread(partial(_part, plan), parts, workers=workers, scheduler=scheduler)
    return gather(plan, results)


def _part(plan: Plan, members: tuple[int, int]) -> Part:
    return run_members(plan, *members)
