"""Kills at random instants of an ingest: every file is whole, and the next run gives the undisturbed values."""

import os
import random
import shutil
import signal
import subprocess
import time

import pytest

pytestmark = pytest.mark.whole

# A copy is ingested first, so that modules are loaded and workers are there: kills fall on the ingest itself.
INGEST = """
import sys
from colonnade.workflow import run
folder, warming = sys.argv[1:]
run(warming, until="ingest", workers=1, start_from="ingest")
print("ready", flush=True)
sys.stdin.readline()
run(folder, until="ingest", workers=1)
print("ended", flush=True)
"""


def test_an_ingest_that_is_killed_is_taken_up_again(start, untouched, undisturbed):
    expected = {name: content for name, content in undisturbed.contents().items() if name.endswith("recorded.nc")}
    warming = shutil.copytree(untouched.folder, untouched.folder.with_name("warming"))
    processed = untouched.layout.processed

    def ingest(pause=None):
        """Ingest in a process, which is killed after a pause if one is given; return how long that took."""
        process = start(INGEST, untouched.folder, warming, said="ready", stdin=subprocess.PIPE)
        began = time.perf_counter()
        process.stdin.write("\n")
        process.stdin.flush()
        if pause is None:
            assert process.stdout.readline() == "ended\n"
        else:
            time.sleep(pause)
            os.killpg(process.pid, signal.SIGKILL)
        duration = time.perf_counter() - began
        process.wait()
        return duration

    chance, duration = random.Random(1), ingest()
    for _ in range(5):
        shutil.rmtree(processed)
        ingest(chance.uniform(0.0, duration))
        assert untouched.contents().items() <= expected.items()
        processed.mkdir(exist_ok=True)
        assert not untouched.run(until="ingest").failed
        assert untouched.contents() == expected
        assert not list(processed.rglob(".*.partial"))
