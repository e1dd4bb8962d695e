"""Independent calls on the workers of a running Dask cluster."""

from __future__ import annotations

import os
import platform
import queue
import re
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, suppress
from importlib import import_module
from typing import Any, TypeVar

from colonnade.errors import ColonnadeError
from colonnade.interruption import expect_none
from colonnade.sources import package_hash

Item = TypeVar("Item")
Result = TypeVar("Result")
Tell = Callable[[str], None]
"""Takes a sentence about the run itself, such as that the system stopped a worker."""

AHEAD = 2
"""Items handed out to each thread, of which it works on the first; so few are lost if it is stopped."""
_PATIENCE = 10
"""Seconds until a scheduler answers, and until it has a worker."""
_LOOK = 1.0
"""Seconds between two looks at the list of workers."""

_ADDRESS = re.compile(r"([a-z]+://)?[^\s/]+:\d{1,5}")

_one_at_a_time = threading.Lock()
"""Held while a worker works: netCDF's library does not support several threads of one process."""


def on_cluster(work: Callable[[Item], Result], items: Sequence[Item], scheduler: str, tell: Tell) -> Iterator[Result]:
    """
    Call a function once for each item, on the workers of a cluster; see `spreading.spread`.

    Raises
    ------
    ColonnadeError
        If the cluster is not there, runs other code, or ends before the work does.
    """
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        raise ColonnadeError(
            "`--scheduler` needs the package `distributed`, which is not installed here: pip install colonnade[cluster]"
        ) from error
    if not items:
        return
    if not _ADDRESS.fullmatch(scheduler):
        raise ColonnadeError(_no_scheduler(scheduler, "that is not an address"))
    try:
        client = distributed.Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except OSError as error:
        raise ColonnadeError(_no_scheduler(scheduler, str(error))) from error
    with closing(client):
        workers = _expect_workers(client, scheduler, distributed)
        yield from _submitted(client, work, items, _Watch(client, scheduler, workers, tell), distributed)


class _Watch:
    """
    Watches which workers a cluster has.

    Parameters
    ----------
    client : distributed.Client
    scheduler : str
    workers : dict of str to str
        Description of each worker's process, by address.
    tell : callable
    """

    def __init__(self, client: Any, scheduler: str, workers: dict[str, str], tell: Tell) -> None:
        self.scheduler = scheduler
        self._client, self._known, self._tell = client, dict(workers), tell
        self._looked, self._seen = time.monotonic(), time.monotonic()
        self.threads = sum(client.ncores().values())

    def look(self) -> None:
        """
        Report workers that have gone since the last look.

        Raises
        ------
        ColonnadeError
            If there have been none for some time, or the scheduler has gone.
        """
        now = time.monotonic()
        if now - self._looked < _LOOK:
            return
        self._looked = now
        try:
            there = self._client.ncores()
        except Exception as error:  # closed, cut off or late: whatever it is, nobody answers
            raise self.gone() from error
        for address in self._known.keys() - there.keys():
            self._tell(
                f"{address}: this worker ({self._known.pop(address)}) left the cluster before the work was done: it "
                "was stopped, most often because memory ran out. Its work is given to another worker."
            )
        self._known |= dict.fromkeys(there.keys() - self._known.keys(), "one that came later")
        self.threads = sum(there.values()) or self.threads
        self._seen = now if there else self._seen
        if now - self._seen > _PATIENCE:
            raise ColonnadeError(
                f"{self.scheduler}: all its workers ended before the work was done. Finished results are kept. "
                "Start workers and run again."
            )

    def gone(self) -> ColonnadeError:
        """Return the error for a scheduler that does not answer any more."""
        return ColonnadeError(
            f"{self.scheduler}: the scheduler of the Dask cluster ended before the work was done. Finished results are "
            "kept, and its workers write nothing more. Start the cluster again and run again, or run without "
            "--scheduler."
        )


def _submitted(
    client: Any, work: Callable[[Item], Result], items: Sequence[Item], watch: _Watch, distributed: Any
) -> Iterator[Result]:
    """Hand out a few items at a time, and yield results as they end."""
    waiting, left = iter(items), len(items)
    pending: set[Any] = set()
    ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
    try:
        while left:
            expect_none()
            while len(pending) < min(left, AHEAD * watch.threads):
                future = client.submit(_on_worker, work, next(waiting), pure=False)
                pending.add(future)
                future.add_done_callback(ended.put)
            watch.look()
            with suppress(queue.Empty):
                future = ended.get(timeout=_LOOK)
                pending.remove(future)
                left -= 1
                yield _result(future, watch, distributed)
    finally:
        with suppress(Exception):  # the scheduler may be gone
            client.cancel(list(pending), force=True)


def _result(future: Any, watch: _Watch, distributed: Any) -> Any:
    if future.status not in ("finished", "error"):
        raise watch.gone()
    try:
        return _fetched(future, watch, distributed)
    except distributed.KilledWorker as error:
        raise ColonnadeError(
            f"{watch.scheduler}: its workers were stopped several times over the same work, most often because memory "
            f"ran out; the last one was {getattr(error.last_worker, 'address', error.last_worker)}. What was finished "
            "is kept. Give each worker more memory and run again."
        ) from error
    except distributed.CancelledError as error:
        raise watch.gone() from error


def _fetched(future: Any, watch: _Watch, distributed: Any) -> Any:
    """Fetch a result; if the worker that holds it ended, wait only while there are workers to compute it again."""
    while True:
        try:
            return future.result(timeout=_PATIENCE)
        except (TimeoutError, distributed.TimeoutError):
            if future.status == "error":  # the work itself raised it
                raise
            watch.look()


def _no_scheduler(scheduler: str, found: str) -> str:
    return (
        f"{scheduler}: no Dask scheduler answers there ({found}). The address that `dask scheduler` shows when it "
        'starts was expected, such as "tcp://10.0.0.1:8786".'
    )


def _expect_workers(client: Any, scheduler: str, distributed: Any) -> dict[str, str]:
    """
    Refuse a cluster without workers, or whose workers have other sources than this process: results would differ.

    Return which process each worker is, by its address.
    """
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except (TimeoutError, distributed.TimeoutError) as error:
        raise ColonnadeError(
            f"{scheduler}: this scheduler has no workers. Start some: dask worker {scheduler} --nthreads 1"
        ) from error
    try:
        theirs = client.run(_who)
    except Exception as error:
        raise ColonnadeError(
            f"{scheduler}: its workers cannot import colonnade ({type(error).__name__}: {error}). Install this version "
            "of colonnade, with the same packages, where they run."
        ) from error
    others = sorted(worker for worker, (code, _) in theirs.items() if code != package_hash())
    if others:
        raise ColonnadeError(
            f"{scheduler}: {len(others)} of {len(theirs)} workers run another version of colonnade, the first of them "
            f"{others[0]}. Install the same one everywhere and restart the workers."
        )
    return {worker: who for worker, (_, who) in theirs.items()}


def _who() -> tuple[str, str]:
    """Return the hash of the sources that a worker runs, and which process it is."""
    return package_hash(), f"process {os.getpid()} on {platform.node()}"


def _on_worker(work: Callable[[Item], Result], item: Item) -> Result:
    with _one_at_a_time:
        return work(item)
