"""The run behind a watch: it does what a run does, gives way, and is tried again if it was refused."""

import os
import signal
import time
from contextlib import suppress

import pytest

from colonnade.workflow.lock import is_refusal, only_run
from colonnade.workflow.watching.behind import Behind


def wait_until(condition):
    until = time.monotonic() + 600
    while not (found := condition()):
        assert time.monotonic() < until
        time.sleep(0.05)
    return found


@pytest.mark.whole
def test_it_gives_way_and_then_says_what_failed_and_when_it_was_refused(small):
    small.raw("pulse-02").write_text("nothing\n")
    behind = Behind(small.folder / "campaign.toml", None, 1)
    behind.start()
    assert behind.is_running
    behind.give_way()
    assert not behind.is_running
    assert behind.ended() is None
    behind.start()
    found = wait_until(behind.ended)
    assert found.problem == ""
    assert [failure.partition(":")[0] for failure in found.failures] == ["pulse-02"]
    with only_run(small.layout):
        behind.start()
        assert is_refusal(wait_until(behind.ended).problem)


def test_a_run_that_is_killed_says_so(small):
    behind = Behind(small.folder / "campaign.toml", None, 1)
    behind.start()
    behind._running[0].kill()
    found = wait_until(behind.ended)
    assert found.problem == "It ended with exit code -9."


WATCH = """
import sys, time
from pathlib import Path
from colonnade.workflow.watching.behind import Behind

Behind(Path(sys.argv[1]), None, 1).start()
print("watching", flush=True)
time.sleep(600)
"""


@pytest.mark.whole
@pytest.mark.skipif(os.name != "posix", reason="a process is killed as only POSIX does")
def test_it_ends_in_order_when_the_watch_is_killed(start, small):
    small.edit("members = 20", "members = 10000")  # a run of minutes
    holder = small.layout.lock_holder
    watch, run = start(WATCH, small.folder / "campaign.toml", said="watching"), 0
    try:
        wait_until(holder.exists)
        run = int(holder.read_text(encoding="utf-8").split()[2])
        time.sleep(1.0)
        assert holder.exists()
        watch.kill()
        watch.wait()
        wait_until(lambda: not holder.exists())  # a run that was killed itself would leave it
    finally:
        if run:
            with suppress(ProcessLookupError):
                os.killpg(run, signal.SIGKILL)
