"""Independent calls on several workers, processes or a Dask cluster, as executors; long work in blocks that stay."""

from __future__ import annotations

import os
import shutil
import signal
import threading
import time
import warnings
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError, Executor, Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from functools import partial
from importlib import import_module
from math import ceil
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import IO, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from colonnade.errors import ColonnadeError
from colonnade.interruption import FROM_TERMINAL, expect_none, held_back
from colonnade.sources import package_hash
from colonnade.store import files

# A worker that holds 300 MB more than at first, as by its libraries, ends in order and another takes its place.
warnings.filterwarnings("ignore", category=UserWarning, message="A worker stopped while some jobs were given")

Item = TypeVar("Item")
Result = TypeVar("Result")

STOPPED = "A worker process was stopped by the system, most often because memory ran out"

LOOK = 1.0
"""Seconds without a result after which the workers are looked at."""

_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
"""Environment of a worker: there are as many as cores."""


class WorkersEndedError(ColonnadeError):
    """Workers were stopped, or their scheduler ended, before the work was done: it may succeed later."""


Counted = Callable[[int, int], None]
"""Told how many blocks are done, and of how many."""


class Where(NamedTuple):
    """
    Where blocks are computed, and what follows their progress.

    Attributes
    ----------
    workers : int or None
        Processes of this machine; one a core by default. With one, all is done in this process.
    scheduler : str or None
        Address of a running Dask scheduler, as "tcp://10.0.0.1:8786": its workers are used instead.
    progress : callable
    """

    workers: int | None = None
    scheduler: str | None = None
    progress: Counted = lambda done, total: None


HERE = Where()


class Workers(NamedTuple):
    """
    Workers to hand items to.

    Attributes
    ----------
    pool : Executor
    look : callable
        Raises WorkersEndedError if nobody works any more.
    stop : callable
        Ends calls that have not ended.
    """

    pool: Executor
    look: Callable[[], object]
    stop: Callable[[Iterable[Future[Any]]], object]


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    where: Where = HERE,
    lost: Callable[[Item], Result] | None = None,
) -> Iterator[tuple[int, Result]]:
    """
    Call a function once for each item.

    Parameters
    ----------
    work : callable
        A function of a module, not a lambda: other processes import it.
    items : sequence
        Arguments of the calls, small enough to send.
    where : Where, optional
    lost : callable, optional
        Gives the result of an item that lost its worker even when it was alone; without it that is an error.

    Yields
    ------
    number : int
        Place of an item.
    result
        Of this item; in the order in which they end.

    Raises
    ------
    WorkersEndedError
        If a worker was stopped even alone, or the cluster ends before the work does.
    ColonnadeError
        If the cluster is not there or runs other code.
    """
    if where.scheduler is not None:
        if items:
            with _on_cluster(where.scheduler) as there:
                yield from _handed_out(there, partial(_as_here, work, package_hash()), dict(enumerate(items)))
        return
    import joblib

    count = min(where.workers or joblib.cpu_count(), len(items))
    if count <= 1:
        for number, item in enumerate(items):
            expect_none()
            yield number, work(item)
        return
    waiting, now = dict(enumerate(items)), count
    while waiting:
        try:
            for number, result in _handed_out(_processes(now), work, waiting):
                del waiting[number]
                yield number, result
        except BrokenProcessPool as error:
            if now > 1:  # most often memory ran out: what was not done is tried again with half as many
                now //= 2
                continue
            if lost is None:
                raise WorkersEndedError(
                    f"{STOPPED}, even of one alone. Finished results are kept. Run again with fewer workers "
                    "(`--workers 1` uses the least memory)."
                ) from error
            stopped = next(iter(waiting))
            now = count
            yield stopped, lost(waiting.pop(stopped))


def _handed_out(
    workers: Workers, work: Callable[[Item], Result], items: Mapping[int, Item]
) -> Iterator[tuple[int, Result]]:
    """Hand out all items, and give results as they end."""
    pending: dict[Future[Result], int] = {}
    ended: SimpleQueue[Future[Result]] = SimpleQueue()
    try:
        with held_back():
            for number, item in items.items():
                handed = workers.pool.submit(work, item)
                pending[handed] = number
                handed.add_done_callback(ended.put)
        while pending:
            expect_none()
            # `concurrent.futures.wait` would keep locks that the pool needs if Ctrl-C came as it takes them.
            try:
                future = ended.get(timeout=LOOK)
            except Empty:
                workers.look()
                continue
            yield pending.pop(future), future.result()
    finally:
        if pending:
            with held_back():
                workers.stop(pending)


def _processes(count: int) -> Workers:
    """Give processes of this machine, started or those of the last call; none outlives this process."""
    from joblib.executor import get_memmapping_executor

    # Joblib's own kind, which a later `joblib.Parallel` of the caller can follow. Each settles in as it starts, not
    # with its first item: one that never gets any has to notice its parent's end too.
    with held_back():
        settled = {"initializer": settle_in, "initargs": (os.getpid(),), "env": _ONE_THREAD}
        pool: Any = get_memmapping_executor(count, max_nbytes=None, **settled)
    return Workers(pool, expect_none, lambda pending: _stop(pool))


def _stop(pool: Any) -> None:
    """Stop processes, on Ctrl-C before the lock is given back. Loky's thread breaks at a call that is cancelled."""
    original = threading.excepthook

    def tell(failure: threading.ExceptHookArgs) -> None:
        # Stopped before its first items were sent, loky looks for them in vain once its workers are gone.
        if failure.exc_type is not KeyError:
            original(failure)

    threading.excepthook = tell
    try:
        pool.shutdown(wait=True, kill_workers=True)
        for feeder in [each for each in threading.enumerate() if each.name == "QueueFeederThread"]:
            feeder.join(LOOK)  # frozen at the end of the interpreter, it would leave a semaphore half removed
    finally:
        threading.excepthook = original


PATROL = 0.1
"""Seconds between two checks that the parent is alive."""


def settle_in(parent: int) -> None:
    """Leave Ctrl-C to the parent, and end when it is gone, however it ended: a worker without a lock may not write."""
    for signum in FROM_TERMINAL:
        signal.signal(signum, signal.SIG_IGN)

    def end_with_it() -> None:
        while os.getppid() == parent:
            time.sleep(PATROL)
        os._exit(1)

    threading.Thread(target=end_with_it, daemon=True).start()


_PATIENCE = 10
"""Seconds until a scheduler answers, and until it has a worker."""


@contextmanager
def _on_cluster(scheduler: str) -> Iterator[Workers]:
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
        client = distributed.Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, AssertionError) as error:  # the last if its event loop did not start
        raise ColonnadeError(
            f"{scheduler}: no Dask scheduler answers there ({error!r}). The address that `dask "
            'scheduler` shows when it starts was expected, such as "tcp://10.0.0.1:8786".'
        ) from error
    with client:
        _expect_workers(client, scheduler)
        try:
            yield Workers(client.get_executor(pure=False), partial(_expect_workers, client, scheduler), _cancel)
        except ImportError as error:
            raise ColonnadeError(
                f"{scheduler}: its workers cannot import colonnade ({error}). Install this version of colonnade, with "
                "the same packages, where they run."
            ) from error
        except (CancelledError, distributed.CancelledError, distributed.KilledWorker) as error:
            raise _ended(scheduler) from error


def _expect_workers(client: Any, scheduler: str) -> None:
    """Refuse a cluster without workers; none may be there for a while, as workers come and go."""
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise WorkersEndedError(
            f"{scheduler}: this scheduler has no workers. Start some: dask worker {scheduler} --nthreads 1"
        ) from error
    except Exception as error:  # closed, cut off or late: whatever it is, nobody answers
        raise _ended(scheduler) from error


def _cancel(pending: Iterable[Future[Any]]) -> None:
    """Cancel what is not done; the scheduler may be gone."""
    with suppress(Exception):
        for future in pending:
            future.cancel()


def _ended(scheduler: str) -> Exception:
    return WorkersEndedError(
        f"{scheduler}: the Dask cluster ended before the work was done, or its workers were stopped several times over "
        "the same work. Finished results are kept, and nothing more is written. Start the cluster again, with more "
        "memory for each worker if it ran out, and run again, or run without --scheduler."
    )


def _as_here(work: Callable[[Item], Result], code: str, item: Item) -> Result:
    """Work in a worker of a cluster that does it as this process would: with its code, and in one thread."""
    worker: Any = import_module("distributed").get_worker()
    if package_hash() != code:
        raise ColonnadeError(
            f"{worker.address}: this worker runs another version of colonnade. Install the same one everywhere and "
            "restart the workers."
        )
    if worker.state.nthreads != 1:  # netCDF's library does not support several
        raise ColonnadeError(
            f"{worker.address}: this worker has {worker.state.nthreads} threads. Workers with one thread were "
            "expected; start it again with `dask worker --nthreads 1`, and several of them (`--nworkers`) for several "
            "cores."
        )
    return work(item)


Arrays = dict[str, NDArray[Any]]

Run = Callable[..., list[Arrays]]
"""Works on blocks, as `in_blocks` of a place and a key: takes the work, the blocks and, of several kinds, `part`."""

MOST_BLOCKS = 128
"""Of a map: enough for any cluster, and few enough to keep."""


def blocks_of(number: int) -> list[range]:
    """Divide a number of columns into at most `MOST_BLOCKS` blocks of equal size, the last one smaller."""
    size = ceil(number / MOST_BLOCKS)
    return [range(start, min(start + size, number)) for start in range(0, number, size)]


def in_blocks(
    work: Callable[[Item], Mapping[str, NDArray[Any]]],
    blocks: Sequence[Item],
    folder: Path,
    key: str,
    where: Where = HERE,
    part: str = "",
) -> list[Arrays]:
    """
    Work on each block, or take the blocks that an interrupted earlier call finished.

    Parameters
    ----------
    work : callable
        Of a module; takes a block and returns its arrays by name. What it returns may depend on the block alone.
    blocks : sequence
    folder : Path
        Where finished blocks are kept; for this work only. The caller removes it when their sum is stored.
    key : str
        Hash of all that the result depends on; blocks under another key are removed.
    where : Where, optional
    part : str, optional
        Name of these blocks among those of a result that has several kinds.

    Returns
    -------
    results : list of dict
        Of each block, in the order of `blocks`, whatever the order in which they ended.

    Raises
    ------
    StoreError
        If a block cannot be written.
    ColonnadeError
        If workers fail; the blocks that are finished stay.
    """
    here = folder / part / key[:16]
    for other in (folder / part).glob("*"):
        if other != here:
            shutil.rmtree(other, ignore_errors=True)
    paths = [here / f"{number:06d}.npz" for number in range(len(blocks))]
    found = {number: kept for number, path in enumerate(paths) if (kept := _kept(path)) is not None}
    missing = [number for number in range(len(blocks)) if number not in found]
    where.progress(len(found), len(blocks))
    asked = [blocks[number] for number in missing]
    for place, arrays in spread(work, asked, where):
        files.write_stream(paths[missing[place]], partial(_write, arrays))
        found[missing[place]] = dict(arrays)
        where.progress(len(found), len(blocks))
    return [found[number] for number in range(len(blocks))]


def _write(arrays: Mapping[str, NDArray[Any]], stream: IO[bytes]) -> None:
    np.savez(stream, allow_pickle=False, **arrays)


def _kept(path: Path) -> Arrays | None:
    """Arrays of a finished block; None if it is missing or unreadable."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        return None
