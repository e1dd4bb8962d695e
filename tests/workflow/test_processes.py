"""Several processes give what one gives; Ctrl-C and a kill leave no half file and nobody writing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from colonnade.workflow import processes

RUN = """
import sys
import colonnade
def told(stage, done, total):
    print("going", flush=True)
try:
    colonnade.run(sys.argv[1], workers=2, until="compare", progress=told)
except KeyboardInterrupt:
    sys.exit(130)
"""


def test_two_processes_give_what_one_gives(untouched, undisturbed):
    assert not untouched.run(workers=2).failed
    assert untouched.contents() == undisturbed.contents()
    assert untouched.summary() == undisturbed.summary()


@pytest.fixture
def killer(monkeypatch):
    """Has the worker that takes a test killed in it, as where memory ran out, so often at most."""
    real = processes._in_worker

    def arm(test, folder, times):
        def in_worker(number, chain, parent):
            marks = [folder / f"{turn}.killed" for turn in range(times)]
            left = [mark for mark in marks if not mark.exists()]
            if chain.test == test and left:
                left[0].touch()
                os.kill(os.getpid(), signal.SIGKILL)
            return real(number, chain, parent)

        monkeypatch.setattr(processes, "_in_worker", in_worker)

    return arm


def test_a_worker_that_is_stopped_once_costs_nothing(untouched, undisturbed, killer, tmp_path):
    killer("pulse-01", tmp_path, times=1)
    assert not untouched.run(workers=2).failed
    assert untouched.contents() == undisturbed.contents()


def test_a_test_that_stops_its_worker_each_time_fails_alone_and_is_tried_again(
    untouched, undisturbed, killer, tmp_path, monkeypatch
):
    killer("pulse-01", tmp_path, times=9)
    failed = [stage for stage in untouched.run(workers=2).stages if stage.action == "failed"]
    assert [(stage.subject, stage.stage) for stage in failed] == [("pulse-01", "ingest")]
    assert "stopped the process that worked on this test" in untouched.summary()["tests"]["pulse-01"]["reason"]
    assert {name: test["status"] for name, test in untouched.summary()["tests"].items() if name != "pulse-01"} == (
        dict.fromkeys(("free-01", "free-02", "pulse-02"), "done")
    )
    monkeypatch.undo()
    assert not untouched.run(workers=2).failed
    assert untouched.contents() == undisturbed.contents()


def test_an_interrupt_in_this_process_frees_the_lock_and_leaves_whole_files(untouched, undisturbed):
    def interrupt(stage, done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        untouched.run(progress=interrupt)
    assert untouched.contents().items() <= undisturbed.contents().items()
    assert not untouched.run().failed
    assert untouched.contents() == undisturbed.contents()


@pytest.fixture
def going(untouched):
    """A run with two workers, in a session of its own as from a terminal, of which a first test has ended."""
    process = subprocess.Popen(
        [sys.executable, "-c", RUN, str(untouched.folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert process.stdout.readline() == "going\n"
    yield process
    for stream in (process.stdout, process.stderr):
        stream.close()
    process.wait()


def members(session: int) -> set[int]:
    """Processes of a session, by /proc."""
    found = set()
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.add(int(entry.name))
    return found


def left_after(session: int, seconds: float) -> set[int]:
    """Processes of a session that are still there after so long."""
    until = time.monotonic() + seconds
    while (there := members(session)) and time.monotonic() < until:
        time.sleep(0.05)
    return there


in_proc = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are found in Linux's /proc")


@in_proc
def test_ctrl_c_ends_the_workers_quietly_and_the_next_run_goes_on(going, untouched, undisturbed):
    os.killpg(going.pid, signal.SIGINT)
    assert going.wait(20) == 130
    assert "Traceback" not in going.stderr.read()
    assert left_after(going.pid, 5.0) == set()
    assert untouched.contents().items() <= undisturbed.contents().items()
    assert not untouched.run().failed
    assert untouched.contents() == undisturbed.contents()


@in_proc
def test_no_worker_outlives_a_run_that_is_killed(going):
    going.kill()
    going.wait()
    left = left_after(going.pid, 3.0)
    for process in left:
        os.kill(process, signal.SIGKILL)
    assert left == set()
