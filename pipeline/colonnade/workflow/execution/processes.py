"""Chains in several processes; none outlives the run."""

from __future__ import annotations

import platform
from collections.abc import Iterator, Mapping, Sequence

from colonnade.errors import ColonnadeError
from colonnade.interruption import expect_none
from colonnade.workflow.chain import Chain, bring_up_to_date, worker_lost
from colonnade.workflow.execution.cluster import AHEAD, Tell
from colonnade.workflow.execution.spreading import on_processes, spread, stopped
from colonnade.workflow.outcome import StageRun


def execute(
    chains: Sequence[Chain],
    workers: int | None,
    scheduler: str | None = None,
    tell: Tell = lambda sentence: None,
) -> Iterator[list[StageRun]]:
    """
    Execute chains that do not depend on each other.

    Parameters
    ----------
    chains : sequence of Chain
    workers : int or None
        Processes; one a core by default. With one, all is done in this process.
    scheduler : str or None
        Address of a running Dask scheduler whose workers are used instead; they share the campaign's folder.
    tell : callable, optional
        Called with a sentence if a worker was stopped.

    Yields
    ------
    runs : list of StageRun
        What became of the stages of one chain; chains in the order in which they end.

    Raises
    ------
    ColonnadeError
        If the cluster does not answer, runs other code, does not see the folder or ends before the work does.

    Notes
    -----
    If the system stops a worker, the chains that it may have worked on are tried again, each alone. One that loses its
    worker again has failed; the others go on.
    """
    if scheduler is not None:
        yield from spread(_in_cluster, chains, scheduler=scheduler, tell=tell)
        return
    import joblib

    count = min(workers or joblib.cpu_count(), len(chains))
    if count <= 1:
        for chain in chains:
            expect_none()
            yield bring_up_to_date(chain)
        return
    from joblib.externals.loky.process_executor import BrokenProcessPool

    waiting = dict(enumerate(chains))
    while waiting:
        try:
            for number, runs in _in_workers(waiting, count):
                del waiting[number]
                yield runs
        except BrokenProcessPool as error:
            suspects = list(waiting)[: AHEAD * count]
            names = ", ".join(waiting[number].subject for number in suspects)
            tell(
                f"{stopped(error)} by the system, most often because memory ran out. One of these tests was being "
                f"worked on, and each was tried again alone: {names}."
            )
            for number in suspects:
                chain = waiting.pop(number)
                try:
                    yield from (runs for _, runs in _in_workers({number: chain}, count))
                except BrokenProcessPool:
                    yield [worker_lost(chain)]


def _in_workers(chains: Mapping[int, Chain], count: int) -> Iterator[tuple[int, list[StageRun]]]:
    yield from on_processes(_in_worker, chains.items(), count)


def _in_worker(numbered: tuple[int, Chain]) -> tuple[int, list[StageRun]]:
    number, chain = numbered
    return number, bring_up_to_date(chain)


def _in_cluster(chain: Chain) -> list[StageRun]:
    """Bring a chain up to date on a worker of a cluster, which has to see the campaign's folder."""
    if not chain.campaign_file.is_file():
        raise ColonnadeError(
            f"{chain.campaign_file}: a worker on {platform.node()} does not see this file. A folder that all of the "
            "cluster's workers share under the same path was expected; put the campaign there."
        )
    if not chain.layout.processed.is_dir():
        raise ColonnadeError(
            f"{chain.layout.processed}: a worker on {platform.node()} does not see this folder of results. A folder "
            "that all of the cluster's workers share under the same path was expected; give another one with --results."
        )
    return bring_up_to_date(chain)
