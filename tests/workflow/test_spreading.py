"""A real Dask scheduler with two workers on loopback does what this process does; one that is not there is told."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles import Plan
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.errors import ColonnadeError
from colonnade.store import files
from colonnade.workflow.chain import Chain
from colonnade.workflow.ensembles import run_ensemble
from colonnade.workflow.map_plans import Wanted
from colonnade.workflow.maps import make_maps
from colonnade.workflow.processes import execute
from colonnade.workflow.spreading import spread

distributed = pytest.importorskip("distributed", reason="the extra `cluster` is not installed")


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def start(*arguments: str) -> subprocess.Popen[bytes]:
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([sys.executable, "-m", *arguments, "--host", "127.0.0.1", "--no-dashboard"], **quiet)


def end(processes) -> None:
    for process in processes:
        process.terminate()
    for process in processes:
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def scheduler():
    """Address of a scheduler, without workers yet."""
    port = free_port()
    process = start("distributed.cli.dask_scheduler", "--port", str(port))
    with distributed.Client(f"tcp://127.0.0.1:{port}", timeout=60, set_as_default=False):
        pass
    yield f"tcp://127.0.0.1:{port}"
    end([process])


@pytest.fixture(scope="module")
def cluster(scheduler):
    """The same with two workers, one of them with two threads."""
    processes = [start("distributed.cli.dask_worker", scheduler, "--no-nanny", "--nthreads", n) for n in ("1", "2")]
    with distributed.Client(scheduler, timeout=60, set_as_default=False) as client:
        client.wait_for_workers(2, timeout=60)
    yield scheduler
    end(processes)


def whose(number: int) -> tuple[int, int]:
    import time

    time.sleep(0.05)
    return number**2, os.getpid()


def refuse(number: int) -> None:
    raise ColonnadeError(f"number {number} cannot be")


def test_a_scheduler_without_workers_is_told_with_what_to_do(scheduler, monkeypatch):
    monkeypatch.setattr("colonnade.workflow.spreading._PATIENCE", 1)
    with pytest.raises(ColonnadeError, match=r"has no workers\. Start some: dask worker tcp://"):
        list(spread(whose, [1], scheduler=scheduler))


def test_a_scheduler_that_is_not_there_is_told(monkeypatch):
    monkeypatch.setattr("colonnade.workflow.spreading._PATIENCE", 1)
    with pytest.raises(ColonnadeError, match="no Dask scheduler answers there"):
        list(spread(whose, [1], scheduler=f"tcp://127.0.0.1:{free_port()}"))


@pytest.mark.parametrize("address", ["no address", "127.0.0.1:notaport"], ids=str)
def test_what_is_no_address_is_told(address):
    with pytest.raises(ColonnadeError, match="that is no address"):
        list(spread(whose, [1], scheduler=address))


def test_all_workers_of_the_cluster_work_and_none_of_this_machine(cluster):
    results = list(spread(whose, range(12), scheduler=cluster))
    assert sorted(square for square, _ in results) == [number**2 for number in range(12)]
    processes = {process for _, process in results}
    assert len(processes) == 2
    assert os.getpid() not in processes


def test_an_error_on_a_worker_is_told_as_here(cluster):
    with pytest.raises(ColonnadeError, match="number 3 cannot be"):
        list(spread(refuse, [3], scheduler=cluster))


def test_workers_with_other_code_are_refused(cluster, monkeypatch):
    monkeypatch.setattr("colonnade.workflow.spreading.source_hash", lambda: "another")
    with pytest.raises(ColonnadeError, match="another version of colonnade"):
        list(spread(whose, [1], scheduler=cluster))


def test_a_campaign_run_on_the_cluster_is_that_of_one_process(cluster, untouched, undisturbed):
    assert not untouched.run(scheduler=cluster).failed
    assert untouched.contents() == undisturbed.contents()
    assert untouched.summary() == undisturbed.summary()


def test_workers_that_do_not_see_the_campaign_are_told(cluster, untouched):
    campaign = replace(load(untouched.folder), path=untouched.folder / "elsewhere.toml")
    elsewhere = Chain.of(
        campaign, untouched.layout, "pulse-01", phase="measuring", until="ingest", redo_from=None, raw={}
    )
    with pytest.raises(ColonnadeError, match="does not see this file"):
        list(execute([elsewhere], None, cluster))


def test_a_map_made_on_the_cluster_is_that_of_one_process_bit_for_bit(cluster, untouched):
    wanted = Wanted(frequency_ratio=(2.0, 5.0), amplitude_ratio=(0.8, 2.0), points=(5, 6), cycles=4.0)
    contents = []
    for options in ({"scheduler": cluster}, {"workers": 1}):
        (made,) = make_maps(untouched.folder, wanted, **options)
        contents.append(files.read(made.path).attrs["content"])
        made.path.unlink()
    assert contents[0] == contents[1]


def test_an_ensemble_on_the_cluster_is_that_of_one_process_bit_for_bit(cluster):
    motion = Motion(2.2 * np.sin(np.arange(300) * 0.15), 0.005)
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    plan = Plan(block, motion, 0.97, Uncertainty(p=0.01, noise=0.05), count=130)
    there, here = (run_ensemble(plan, **options) for options in ({"scheduler": cluster}, {"workers": 1}))
    np.testing.assert_array_equal(there.bands, here.bands)
    np.testing.assert_array_equal(there.peak_ratio, here.peak_ratio)
