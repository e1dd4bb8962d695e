"""Chains in several processes, none of which outlives the run."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

from colonnade.errors import ColonnadeError
from colonnade.workflow.chain import Chain, walk
from colonnade.workflow.results import StageRun

_PATROL = 0.1
"""Seconds between two looks of a worker at whether its parent is alive."""


def execute(chains: Sequence[Chain], workers: int | None) -> Iterator[list[StageRun]]:
    """
    Execute chains that do not depend on each other.

    Parameters
    ----------
    chains : sequence of Chain
    workers : int or None
        Processes; one a core by default. With one, all is done in this process.

    Yields
    ------
    ended : list of StageRun
        Of one chain, in the order in which they end.

    Raises
    ------
    ColonnadeError
        If the system stopped a worker.
    """
    import joblib

    count = min(workers or joblib.cpu_count(), len(chains))
    if count <= 1:
        for chain in chains:
            yield walk(chain)
        return
    from joblib.externals.loky.process_executor import BrokenProcessPool

    jobs = [joblib.delayed(_in_worker)(chain, os.getpid()) for chain in chains]
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


def _in_worker(chain: Chain, parent: int) -> list[StageRun]:
    _settle_in(parent)
    return walk(chain)


@cache
def _settle_in(parent: int) -> None:
    """Leave Ctrl-C to the parent, and end when it is gone: a worker without a run's lock may not write."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_PATROL)
    os._exit(1)
