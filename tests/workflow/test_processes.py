"""Several processes give what one gives; Ctrl-C and a kill leave no half file and nobody writing."""

import json
import os
import signal
import subprocess
import time
from contextlib import suppress

import psutil
import pytest

from colonnade import interruption
from colonnade.workflow import walk
from processes import wait_until

RUN = """
import sys
import colonnade
try:
    colonnade.run(sys.argv[1], workers=2, until="compare", progress=lambda *step: print("going", flush=True))
except KeyboardInterrupt:
    sys.exit(130)
"""
IMPORT = """
import sys, time
from colonnade.workflow.executors import Where, spread
print("going", flush=True)
try:
    list(spread(time.sleep, [600] * 9, Where(workers=2)))
    sys.exit("too late")
except KeyboardInterrupt:
    sys.exit(130)
"""
# Of two workers one at least is never given anything: a single number is there.
WAIT = """
import time
from colonnade.workflow.executors import Where, spread
list(spread(abs, [-1, -2], Where(workers=3)))
print("going", flush=True)
time.sleep(600)
"""
PATIENCE = 60.0
"""Seconds within which workers have to be gone; joblib's own would wait for work for 300."""


@pytest.mark.whole
def test_two_processes_give_what_one_gives(untouched, undisturbed):
    assert not untouched.run(workers=2).failed
    assert untouched.contents() == undisturbed.contents()
    assert untouched.summary() == undisturbed.summary()


@pytest.fixture
def killer(monkeypatch):
    """Has the worker that takes a test killed in it, as where memory ran out, so often at most."""
    real = walk.bring_up_to_date

    def arm(test, folder, times):
        def in_worker(chain):
            marks = [folder / f"{turn}.killed" for turn in range(times)]
            left = [mark for mark in marks if not mark.exists()]
            if chain.products[0].result.subject == test and left:
                left[0].touch()
                os.kill(os.getpid(), signal.SIGKILL)
            return real(chain)

        monkeypatch.setattr(walk, "bring_up_to_date", in_worker)

    return arm


@pytest.mark.whole
def test_a_test_that_stops_its_worker_each_time_fails_alone_and_is_tried_again(
    untouched, resumes, killer, tmp_path, monkeypatch
):
    killer("pulse-01", tmp_path, times=9)
    result = untouched.run(workers=2)
    failed = [stage for stage in result.stages if stage.action == "failed"]
    assert [(stage.subject, stage.stage) for stage in failed] == [("pulse-01", "ingest")]
    assert "stopped the process that worked on this test" in untouched.summary()["tests"]["pulse-01"]["reason"]
    assert [test["status"] for test in untouched.summary()["tests"].values()] == ["done", "done", "failed", "done"]
    monkeypatch.undo()
    resumes()


@pytest.mark.whole
def test_an_interrupt_in_this_process_frees_the_lock_and_leaves_whole_files(untouched, resumes):
    def interrupt(stage, done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        untouched.run(progress=interrupt)
    looked_at = json.loads(untouched.layout.catalogue.read_text(encoding="utf-8"))
    assert any("pulse-01.csv" in name for name in looked_at)
    resumes()


@pytest.mark.whole
def test_an_interrupt_whose_exception_was_dropped_ends_the_run_before_its_next_stage(untouched, monkeypatch):
    monkeypatch.setattr(interruption, "_noted", [])

    def drop(stage, done, total):
        with suppress(KeyboardInterrupt):
            interruption.note(signal.SIGTERM, None)

    with pytest.raises(KeyboardInterrupt):
        untouched.run(progress=drop, until="ingest")
    assert [path.parent.name for path in untouched.folder.rglob("*.nc")] == ["free-01"]
    assert not untouched.layout.lock_holder.exists()


@pytest.fixture
def going(start, untouched):
    """A run with two workers of which a first test has ended."""
    return start(RUN, untouched.folder, said="going", stderr=subprocess.PIPE)


def members(session):
    """Processes of a session with their commands."""
    found = {}
    for each in psutil.process_iter(["status", "cmdline"]):
        with suppress(OSError):
            if os.getsid(each.pid) == session and each.info["status"] != psutil.STATUS_ZOMBIE:
                found[each.pid] = " ".join(each.info["cmdline"] or ())
    return found


def expect_end_of(session):
    """Expect that all processes of a session end soon."""
    wait_until(lambda: not members(session), PATIENCE, lambda: f"still there: {members(session)}")


@pytest.mark.whole
@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_the_workers_quietly_and_the_next_run_goes_on(going, resumes):
    os.killpg(going.pid, signal.SIGINT)
    assert going.wait(PATIENCE) == 130
    assert "Traceback" not in going.stderr.read()
    expect_end_of(going.pid)
    resumes()


@pytest.mark.whole
@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("delay", [0.0, 0.1, 0.4], ids=lambda delay: f"after {delay} s")
def test_ctrl_c_does_not_tear_workers_from_their_imports(start, delay):
    starting = start(IMPORT, said="going", stderr=subprocess.PIPE)
    wait_until(lambda: any("popen_loky" in command for command in members(starting.pid).values()))
    time.sleep(delay)
    os.killpg(starting.pid, signal.SIGINT)
    code, told = starting.wait(PATIENCE), starting.stderr.read()
    assert (code, told) == (130, "")
    expect_end_of(starting.pid)


@pytest.mark.whole
def test_no_worker_outlives_a_run_that_is_killed(going):
    going.kill()
    going.wait()
    expect_end_of(going.pid)


@pytest.mark.whole
def test_a_worker_that_was_never_given_work_does_not_outlive_its_parent(start):
    waiting = start(WAIT, said="going")
    assert len(members(waiting.pid)) > 2
    waiting.kill()
    waiting.wait()
    expect_end_of(waiting.pid)
