"""Kills at random instants of an ingest: every file is whole, and the next run gives the undisturbed values."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.whole

# A copy is ingested first, so that modules are loaded and workers are there: kills fall on the ingest itself.
INGEST = """
import sys
from colonnade.workflow import run
folder, warming, workers = sys.argv[1], sys.argv[2], int(sys.argv[3])
run(warming, until="ingest", workers=workers, start_from="ingest")
print("ready", flush=True)
sys.stdin.readline()
run(folder, until="ingest", workers=workers)
print("ended", flush=True)
"""


class Ingest:
    """An ingest in a process that waits for the start."""

    def __init__(self, folder: Path, warming: Path, workers: int) -> None:
        complaints = warming.with_name("complaints.txt")
        with complaints.open("w") as stderr:
            self.process = subprocess.Popen(
                [sys.executable, "-c", INGEST, str(folder), str(warming), str(workers)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=stderr,
                text=True,
                start_new_session=True,
            )
        assert self.process.stdout.readline() == "ready\n", complaints.read_text()

    def begin(self) -> None:
        self.process.stdin.write("\n")
        self.process.stdin.flush()

    def end(self) -> float:
        """Wait for its end; return when that was."""
        assert self.process.stdout.readline() == "ended\n"
        ended = time.perf_counter()
        self.clean()
        return ended

    def kill(self) -> None:
        """Kill it with all its workers, as a machine that loses its power."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.clean()

    def clean(self) -> None:
        self.process.stdout.close()
        self.process.stdin.close()
        self.process.wait()


def kill_and_compare(small, undisturbed, kills: int, workers: int, seed: int) -> dict[str, int]:
    """Kill so many ingests; return how many fell before, inside and after the writing of results."""
    expected = {name: content for name, content in undisturbed.contents().items() if name.endswith("recorded.nc")}
    chance = random.Random(seed)
    warming = Path(shutil.copytree(small.folder, small.folder.with_name("warming")))
    whole = Ingest(small.folder, warming, workers)
    began = time.perf_counter()
    whole.begin()
    duration = whole.end() - began
    fell = {"before": 0, "inside": 0, "after": 0}
    for _ in range(kills):
        shutil.rmtree(small.layout.processed)
        ingest = Ingest(small.folder, warming, workers)
        ingest.begin()
        time.sleep(chance.uniform(0.0, duration))
        ingest.kill()
        there = small.contents()
        assert there.items() <= expected.items()
        half = len(list(small.layout.processed.rglob(".*.partial")))
        fell["after" if there == expected else "inside" if there or half else "before"] += 1
        small.layout.processed.mkdir(exist_ok=True)
        assert not small.run(until="ingest").failed
        assert small.contents() == expected
        assert not list(small.layout.processed.rglob(".*.partial"))
    return fell


def test_an_ingest_that_is_killed_is_taken_up_again(untouched, undisturbed):
    assert sum(kill_and_compare(untouched, undisturbed, 5, workers=1, seed=1).values()) == 5
