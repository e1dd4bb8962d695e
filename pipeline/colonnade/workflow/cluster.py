"""The workers of a running Dask cluster, as an executor."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import Any

from colonnade.errors import ColonnadeError
from colonnade.sources import package_hash
from colonnade.workflow.executors import LOOK, Workers, WorkersEndedError

_PATIENCE = 10
"""Seconds until a scheduler answers, and until it has a worker."""

_ADDRESS = re.compile(r"([a-z]+://)?[^\s/]+:\d{1,5}")


@contextmanager
def on_cluster(scheduler: str) -> Iterator[Workers]:
    """
    Give the workers of a cluster, see `executors.spread`.

    Raises
    ------
    ColonnadeError
        If the cluster is not there, or its workers have other code or several threads.
    """
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        raise ColonnadeError(
            "`--scheduler` needs the package `distributed`, which is not installed here: pip install colonnade[cluster]"
        ) from error
    try:
        if not _ADDRESS.fullmatch(scheduler):
            raise ValueError("that is not an address")
        client = distributed.Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ColonnadeError(
            f"{scheduler}: no Dask scheduler answers there ({error}). The address that `dask scheduler` shows when it "
            'starts was expected, such as "tcp://10.0.0.1:8786".'
        ) from error
    with client:
        _expect_workers(client, scheduler)
        try:
            yield Workers(client.get_executor(pure=False), _Count(client, scheduler), _cancel)
        except distributed.KilledWorker as error:
            raise _ended(
                scheduler,
                "its workers were stopped several times over the same work, most often because memory ran out",
                "Give each worker more memory and run again.",
            ) from error
        except (CancelledError, distributed.CancelledError) as error:
            raise _gone(scheduler) from error


class _Count:
    """Looks, once a second, how many workers a cluster has."""

    def __init__(self, client: Any, scheduler: str) -> None:
        self._client, self._scheduler = client, scheduler
        self._count, self._looked, self._seen = 1, 0.0, time.monotonic()

    def __call__(self) -> int:
        """Refuse one with several threads; none may be there for a while, as workers come and go."""
        now = time.monotonic()
        if now - self._looked < LOOK:
            return self._count
        self._looked = now
        try:
            there = self._client.ncores()
        except Exception as error:  # closed, cut off or late: whatever it is, nobody answers
            raise _gone(self._scheduler) from error
        _expect_one_thread(there)
        if there:
            self._count, self._seen = len(there), now
        elif now - self._seen > _PATIENCE:
            what = "all its workers ended before the work was done"
            raise _ended(self._scheduler, what, "Start workers and run again.")
        return self._count


def _cancel(pending: Iterable[Future[Any]]) -> None:
    """Cancel what is not done; the scheduler may be gone."""
    with suppress(Exception):
        for future in pending:
            future.cancel()


def _gone(scheduler: str) -> ColonnadeError:
    return _ended(
        scheduler,
        "the scheduler of the Dask cluster ended before the work was done",
        "Its workers write nothing more. Start the cluster again and run again, or run without --scheduler.",
    )


def _ended(scheduler: str, what: str, remedy: str) -> ColonnadeError:
    return WorkersEndedError(f"{scheduler}: {what}. Finished results are kept. {remedy}")


def _expect_workers(client: Any, scheduler: str) -> None:
    """Refuse workers with other sources than this process: results would differ."""
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise ColonnadeError(
            f"{scheduler}: this scheduler has no workers. Start some: dask worker {scheduler} --nthreads 1"
        ) from error
    _expect_one_thread(client.ncores())
    try:
        others = sorted(worker for worker, code in client.run(package_hash).items() if code != package_hash())
    except Exception as error:
        raise ColonnadeError(
            f"{scheduler}: its workers cannot import colonnade ({type(error).__name__}: {error}). Install this version "
            "of colonnade, with the same packages, where they run."
        ) from error
    if others:
        raise ColonnadeError(
            f"{scheduler}: {len(others)} of its workers run another version of colonnade, the first of them "
            f"{others[0]}. Install the same one everywhere and restart the workers."
        )


def _expect_one_thread(threads: dict[str, int]) -> None:
    """Refuse a worker with several threads: netCDF's library does not support them."""
    for worker, count in sorted(threads.items()):
        if count != 1:
            raise ColonnadeError(
                f"{worker}: this worker has {count} threads. Workers with one thread were expected; start it again "
                "with `dask worker --nthreads 1`, and several of them (`--nworkers`) for several cores."
            )
