"""Calls that do not depend on each other, on processes of this machine or on a Dask cluster that is there already."""

from __future__ import annotations

import os
import re
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from functools import cache
from importlib import import_module
from typing import Any, TypeVar

from colonnade.errors import ColonnadeError
from colonnade.workflow.freshness import source_hash

Item = TypeVar("Item")
Result = TypeVar("Result")

_PATROL = 0.1
"""Seconds between two looks of a worker at whether its parent is alive."""
_PATIENCE = 10
"""Seconds until a scheduler answers, and until it has a worker."""

_ADDRESS = re.compile(r"([a-z]+://)?[^\s/]+:\d{1,5}")

_one_at_a_time = threading.Lock()
"""Held on a cluster's worker: netCDF's library is not made for several threads of one process."""


def spread(
    work: Callable[[Item], Result], items: Sequence[Item], *, workers: int | None = None, scheduler: str | None = None
) -> Iterator[Result]:
    """
    Call a function once for each item.

    Parameters
    ----------
    work : callable
        Of a module, not a lambda: other processes import it.
    items : sequence
        What it takes, light to send.
    workers : int, optional
        Processes of this machine; one a core by default. With one, all is done in this process.
    scheduler : str, optional
        Address of a running Dask scheduler, as "tcp://10.0.0.1:8786": its workers are used instead. Each of their
        processes does one item at a time.

    Yields
    ------
    result
        Of each item, in the order in which they end.

    Raises
    ------
    ColonnadeError
        If a worker was stopped, or the cluster is not there or runs other code.
    """
    if scheduler is not None:
        yield from _on_cluster(work, items, scheduler)
        return
    import joblib

    count = min(workers or joblib.cpu_count(), len(items))
    if count <= 1:
        for item in items:
            yield work(item)
        return
    from joblib.externals.loky.process_executor import BrokenProcessPool

    jobs = [joblib.delayed(_in_process)(work, item, os.getpid()) for item in items]
    with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
        results: Any = joblib.Parallel(n_jobs=count, return_as="generator_unordered", batch_size=1)(jobs)
        try:
            yield from results
        except BrokenProcessPool as error:
            raise ColonnadeError(
                "The system stopped a worker process, most often because memory ran out. What was finished is kept. "
                "Run again with fewer workers (`--workers 1` takes the least memory)."
            ) from error
        finally:
            results.close()  # on Ctrl-C: stops the workers before the lock is given back


def _on_cluster(work: Callable[[Item], Result], items: Sequence[Item], scheduler: str) -> Iterator[Result]:
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        raise ColonnadeError(
            "`--scheduler` needs the package `distributed`, which is not installed here: pip install colonnade[cluster]"
        ) from error
    import joblib

    if not items:
        return
    if not _ADDRESS.fullmatch(scheduler):
        raise ColonnadeError(_no_scheduler(scheduler, "that is no address"))
    try:
        client = distributed.Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except OSError as error:
        raise ColonnadeError(_no_scheduler(scheduler, str(error))) from error
    with closing(client):
        _expect_workers(client, scheduler, distributed)
        jobs = [joblib.delayed(_on_worker)(work, item) for item in items]
        with joblib.parallel_config(backend="dask", client=client):
            results: Any = joblib.Parallel(n_jobs=-1, return_as="generator_unordered", batch_size=1)(jobs)
            try:
                yield from results
            except distributed.KilledWorker as error:
                raise ColonnadeError(
                    f"{scheduler}: its workers were stopped several times over the same work, most often because "
                    "memory ran out. What was finished is kept. Give each worker more memory and run again."
                ) from error
            finally:
                results.close()


def _no_scheduler(scheduler: str, found: str) -> str:
    return (
        f"{scheduler}: no Dask scheduler answers there ({found}). The address that `dask scheduler` shows when it "
        'starts was expected, such as "tcp://10.0.0.1:8786".'
    )


def _expect_workers(client: Any, scheduler: str, distributed: Any) -> None:
    """Refuse a cluster without workers, or whose workers have other sources than this process: results would differ."""
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except (TimeoutError, distributed.TimeoutError) as error:
        raise ColonnadeError(
            f"{scheduler}: this scheduler has no workers. Start some: dask worker {scheduler} --nthreads 1"
        ) from error
    try:
        theirs = client.run(_sources)
    except Exception as error:
        raise ColonnadeError(
            f"{scheduler}: its workers cannot import colonnade ({type(error).__name__}: {error}). Install this version "
            "of colonnade, with the same packages, where they run."
        ) from error
    others = sorted(worker for worker, code in theirs.items() if code != source_hash())
    if others:
        raise ColonnadeError(
            f"{scheduler}: {len(others)} of {len(theirs)} workers run another version of colonnade, the first of them "
            f"{others[0]}. Install the same one everywhere and restart the workers."
        )


def _sources() -> str:
    return source_hash()


def _on_worker(work: Callable[[Item], Result], item: Item) -> Result:
    with _one_at_a_time:
        return work(item)


def _in_process(work: Callable[[Item], Result], item: Item, parent: int) -> Result:
    settle_in(parent)
    return work(item)


@cache
def settle_in(parent: int) -> None:
    """Leave Ctrl-C to the parent, and end when it is gone: a worker without a run's lock may not write."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_PATROL)
    os._exit(1)
