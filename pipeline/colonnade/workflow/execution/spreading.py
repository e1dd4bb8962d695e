"""Independent calls on processes of this machine; for a Dask cluster, see `cluster`."""

from __future__ import annotations

import os
import re
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any, TypeVar

from colonnade.errors import ColonnadeError
from colonnade.interruption import FROM_TERMINAL, expect_none
from colonnade.workflow.execution.cluster import AHEAD, Tell, on_cluster

Item = TypeVar("Item")
Result = TypeVar("Result")

_PATROL = 0.1
"""Seconds between two checks of a worker that its parent is alive."""

_EXIT_CODES = re.compile(r"The exit codes of the workers are \{(.+)\}")
"""How joblib reports processes that ended by themselves, such as "SIGKILL(-9)"."""


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    tell: Tell = lambda sentence: None,
) -> Iterator[Result]:
    """
    Call a function once for each item.

    Parameters
    ----------
    work : callable
        A function of a module, not a lambda: other processes import it.
    items : sequence
        Arguments of the calls, small enough to send.
    workers : int, optional
        Processes of this machine; one a core by default. With one, all is done in this process.
    scheduler : str, optional
        Address of a running Dask scheduler, as "tcp://10.0.0.1:8786": its workers are used instead. Each of their
        processes does one item at a time.
    tell : callable, optional
        Called with a sentence if a worker was stopped.

    Yields
    ------
    result
        Of each item, in the order in which they end.

    Raises
    ------
    ColonnadeError
        If workers were stopped twice, or the cluster is not there, runs other code or ends before the work does.
    """
    if scheduler is not None:
        yield from on_cluster(work, items, scheduler, tell)
        return
    import joblib

    count = min(workers or joblib.cpu_count(), len(items))
    if count <= 1:
        for item in items:
            expect_none()
            yield work(item)
        return
    from joblib.externals.loky.process_executor import BrokenProcessPool

    waiting = dict(enumerate(items))
    for is_last in (False, True):
        try:
            for number, result in on_processes(partial(_numbered, work), list(waiting.items()), count):
                del waiting[number]
                yield result
            return
        except BrokenProcessPool as error:
            if is_last:
                raise ColonnadeError(
                    f"{stopped(error)} twice, most often because memory ran out. Finished results are kept. "
                    "Run again with fewer workers (`--workers 1` uses the least memory)."
                ) from error
            tell(f"{stopped(error)} by the system, most often because memory ran out. Its work was done again.")


def _numbered(work: Callable[[Item], Result], numbered: tuple[int, Item]) -> tuple[int, Result]:
    number, item = numbered
    return number, work(item)


def stopped(error: BaseException) -> str:
    """Say that a worker process ended by itself and, if joblib's exception gives it, how."""
    found = _EXIT_CODES.search(str(error))
    return f"A worker process was stopped{f' ({found[1]})' if found else ''}"


def on_processes(work: Callable[[Item], Result], items: Iterable[Item], count: int) -> Iterator[Result]:
    """
    Call a function once for each item, in processes of this machine; none outlives this process.

    Parameters
    ----------
    work : callable
        A function of a module, not a lambda: other processes import it.
    items : iterable
        Arguments of the calls, small enough to send.
    count : int
        Processes, at least two. They stay for the next call.

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

    # A worker that has grown is replaced, and Ctrl-C leaves work undone: joblib need not warn of either.
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
        for result in results:
            expect_none()
            yield result


@contextmanager
def _stopped_quietly(results: Any) -> Iterator[None]:
    """Stop the workers at the end, on Ctrl-C before the lock is given back."""
    original = threading.excepthook

    def tell(failure: threading.ExceptHookArgs) -> None:
        # Stopped before its first items were sent, loky looks for them in vain once its workers are gone.
        if failure.exc_type is not KeyError:
            original(failure)

    try:
        yield
    finally:
        threading.excepthook = tell
        try:
            results.close()
        finally:
            threading.excepthook = original


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
    before = signal.pthread_sigmask(signal.SIG_BLOCK, FROM_TERMINAL)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _settle_in(parent: int) -> None:
    """Leave Ctrl-C to the parent, and end when it is gone: a worker without a run's lock may not write."""
    for signum in FROM_TERMINAL:
        signal.signal(signum, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_PATROL)
    os._exit(1)
