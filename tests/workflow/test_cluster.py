"""A real Dask scheduler with two workers on loopback does what this process does; one that is not there is told."""

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from functools import partial

import pytest

from colonnade.errors import ColonnadeError
from colonnade.store import files
from colonnade.workflow.executors import Where, spread

distributed = pytest.importorskip("distributed", reason="the extra `cluster` is not installed")
pytestmark = pytest.mark.whole
of_posix = pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@contextmanager
def started(*arguments):
    """A scheduler or a worker, until it is no longer needed."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    command = [sys.executable, "-m", *arguments, "--host", "127.0.0.1", "--no-dashboard"]
    with subprocess.Popen(command, **quiet) as process:
        try:
            yield process
        finally:
            process.kill()


@contextmanager
def scheduling():
    """A scheduler: its address and its process."""
    port = str(free_port())
    with started("distributed.cli.dask_scheduler", "--port", port) as process:
        with distributed.Client(f"tcp://127.0.0.1:{port}", timeout=60, set_as_default=False):
            pass
        yield f"tcp://127.0.0.1:{port}", process


@contextmanager
def working(scheduler, *threads):
    """Workers of a scheduler, one process for each number of threads."""
    worker = partial(started, "distributed.cli.dask_worker", scheduler, "--no-nanny", "--nthreads")
    with ExitStack() as stack:
        processes = [stack.enter_context(worker(number)) for number in threads]
        with distributed.Client(scheduler, timeout=60, set_as_default=False) as client:
            client.wait_for_workers(len(threads), timeout=60)
        yield processes


def _address():
    with scheduling() as (address, _):
        yield address


scheduler = pytest.fixture(_address, scope="module", name="scheduler")
another_scheduler = pytest.fixture(_address, scope="module", name="another_scheduler")
"""Addresses of schedulers, without workers yet; workers of the second are stopped."""


@pytest.fixture(scope="module")
def cluster(scheduler):
    """The same with two workers."""
    with working(scheduler, "1", "1"):
        yield scheduler


@pytest.fixture
def soon(monkeypatch):
    """Look at the workers more often."""
    monkeypatch.setattr("colonnade.workflow.executors.LOOK", 0.1)
    monkeypatch.setattr("colonnade.workflow.executors._PATIENCE", 1.0)


def whose(number):
    time.sleep(0.05)
    return number**2, os.getpid()


def test_a_scheduler_without_workers_is_told_with_what_to_do(scheduler, soon):
    with pytest.raises(ColonnadeError, match=r"has no workers\. Start some: dask worker tcp://"):
        list(spread(whose, [1], Where(scheduler=scheduler)))


@pytest.mark.parametrize(
    "address",
    [f"tcp://127.0.0.1:{free_port()}", "no address", "127.0.0.1:notaport"],
    ids=["nobody", "no-address", "no-port"],
)
def test_what_is_no_scheduler_is_told(soon, address):
    with pytest.raises(ColonnadeError, match="no Dask scheduler answers there"):
        list(spread(whose, [1], Where(scheduler=address)))


def test_all_workers_of_the_cluster_work_and_none_of_this_machine(cluster):
    results = list(spread(whose, range(12), Where(scheduler=cluster)))
    assert sorted(square for _, (square, _) in results) == [number**2 for number in range(12)]
    processes = {process for _, (_, process) in results}
    assert len(processes) == 2
    assert os.getpid() not in processes


def test_a_worker_with_several_threads_is_refused_by_name(another_scheduler):
    with working(another_scheduler, "2"), pytest.raises(ColonnadeError, match="this worker has 2 threads"):
        list(spread(whose, [1], Where(scheduler=another_scheduler)))


def test_workers_with_other_code_are_refused(cluster, monkeypatch):
    monkeypatch.setattr("colonnade.workflow.executors.package_hash", lambda: str(os.getpid()))
    with pytest.raises(ColonnadeError, match="another version of colonnade"):
        list(spread(whose, [1], Where(scheduler=cluster)))


def test_a_campaign_run_on_the_cluster_is_that_of_one_process(cluster, untouched, undisturbed):
    assert not untouched.run(scheduler=cluster).failed
    assert untouched.contents() == undisturbed.contents()
    assert untouched.summary() == undisturbed.summary()


@of_posix
@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM], ids=lambda sent: sent.name)
def test_a_run_whose_scheduler_ends_says_so_and_nobody_writes_after_it(untouched, undisturbed, resumes, soon, sent):
    with scheduling() as (address, process), working(address, "1"):

        def kill(stage, done, total):
            process.send_signal(sent)

        with pytest.raises(ColonnadeError, match="the Dask cluster ended before the work was done"):
            untouched.run(scheduler=address, progress=kill)
        left = untouched.files()
        assert untouched.contents().items() <= undisturbed.contents().items()
        time.sleep(2.0)
        # What the cluster's worker was writing then is given up; nothing else changes.
        assert untouched.files() == {name: seen for name, seen in left.items() if not name.endswith(files.PARTIAL)}
    resumes()


@of_posix
def test_the_work_of_a_worker_that_is_stopped_is_done_by_another(soon, another_scheduler):
    with working(another_scheduler, "1", "1") as (worker, _):
        results = spread(whose, range(30), Where(scheduler=another_scheduler))
        first = next(results)
        worker.kill()
        squares = [square for _, (square, _) in (first, *results)]
    assert sorted(squares) == [number**2 for number in range(30)]


@of_posix
def test_a_cluster_whose_workers_all_end_is_told_and_not_waited_for(soon, another_scheduler):
    with working(another_scheduler, "1") as (worker,):
        results = spread(whose, range(30), Where(scheduler=another_scheduler))
        next(results)
        worker.kill()
        with pytest.raises(ColonnadeError, match="has no workers"):
            list(results)
