"""Several processes give what one gives; Ctrl-C and a kill leave no half file and nobody writing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

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
