"""Calls that do not depend on each other, on processes of this machine or on a Dask cluster that is there already."""

from __future__ import annotations

import os
import re
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from importlib import import_module
from typing import Any, TypeVar

from colonnade.errors import ColonnadeError
from colonnade.workflow.freshness import source_hash

Item = TypeVar("Item")
Result = TypeVar("Result")

AHEAD = 2
"""Items that are handed out a process, the first of which it works on."""
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

    try:
        yield from on_processes(work, items, count)
    except BrokenProcessPool as error:
        raise ColonnadeError(
            "The system stopped a worker process, most often because memory ran out. What was finished is kept. "
            "Run again with fewer workers (`--workers 1` takes the least memory)."
        ) from error


def on_processes(work: Callable[[Item], Result], items: Iterable[Item], count: int) -> Iterator[Result]:
    """
    Call a function once for each item, in processes of this machine none of which outlives this one.

    Parameters
    ----------
    work : callable
        Of a module, not a lambda: other processes import it.
    items : iterable
        What it takes, light to send.
    count : int
        Processes, two at least. They stay for the next call.

    Yields
    ------
    result
        Of each item, in the order in which they end.

    Raises
    ------
    BrokenProcessPool
        If a process was stopped.
    """
    import joblib

    # A worker that has grown is replaced, and Ctrl-C leaves work undone: of neither does joblib have to tell.
    warnings.filterwarnings("ignore", "A worker stopped while some jobs were given", UserWarning)
    warnings.filterwarnings("ignore", ".*You could benefit from adjusting the input task iterator", UserWarning)
    # Each settles in as it starts, not with its first item: one that never gets any has to notice its parent's end too.
    settled = {"initializer": _settle_in, "initargs": (os.getpid(),)}
    with ExitStack() as stack:
        with _interrupts_held_back():
            stack.enter_context(joblib.parallel_config(backend="loky", inner_max_num_threads=1, **settled))
            parallel = joblib.Parallel(
                n_jobs=count, return_as="generator_unordered", batch_size=1, pre_dispatch=AHEAD * count
            )
            results: Any = parallel([joblib.delayed(work)(item) for item in items])
            stack.enter_context(_stopped_quietly(results))
        yield from results


@contextmanager
def _stopped_quietly(results: Any) -> Iterator[None]:
    """Stop the workers at the end, on Ctrl-C before the lock is given back."""
    told = threading.excepthook

    def tell(failure: threading.ExceptHookArgs) -> None:
        # Stopped before its first items were sent, loky looks for them in vain once its workers are gone.
        if failure.exc_type is not KeyError:
            told(failure)

    try:
        yield
    finally:
        threading.excepthook = tell
        try:
            results.close()
        finally:
            threading.excepthook = told


@contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Keep Ctrl-C from processes that are started here, which inherit that: it would tear them from their imports."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    from joblib.externals.loky.backend import resource_tracker as of_loky

    for tracker in (resource_tracker, of_loky):  # whose own start would let Ctrl-C through again
        tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


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


def _settle_in(parent: int) -> None:
    """Leave Ctrl-C to the parent, and end when it is gone: a worker without a run's lock may not write."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_PATROL)
    os._exit(1)
