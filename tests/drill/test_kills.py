"""Kills at random instants of a run on two workers: every file is whole, and the next run gives what it would have."""

import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

pytestmark = [
    pytest.mark.drill,
    pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are looked at in Linux's /proc"),
]

KILLS = int(os.environ.get("DRILL_KILLS", "500"))
SEED = 5
PATIENCE = 60.0
"""Seconds within which a run that lost a worker has to end."""

ROUND = 50
"""Kills after which the duration of a run is measured anew: this machine may have other work meanwhile."""

KILLED = ("run and workers", "one worker", "run alone")
SHARES = (3, 1, 1)


class Victims:
    """Runs in processes of their own, prepared one after the other; see victim.py."""

    def __init__(self, warming, complaints):
        self.complaints, self.reason = complaints, ""
        with complaints.open("w", encoding="utf-8") as stderr:
            self.server = subprocess.Popen(
                [sys.executable, str(Path(__file__).with_name("victim.py")), str(warming)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=stderr,
                text=True,
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"},
            )

    def prepare(self, folder, workers=2):
        """Have a run get ready, while other things are done."""
        self.say(f"{folder}\t{workers}\n")

    def begin(self):
        """Start it when it is ready; its process, then those of its workers."""
        processes = [int(number) for number in self.hear("ready").split()]
        self.reason = ""
        self.say("\n")
        return processes

    def say(self, line):
        self.server.stdin.write(line)
        self.server.stdin.flush()

    def hear(self, word):
        """Wait for a line that starts so; return the rest of it."""
        for line in self.server.stdout:
            first, _, rest = line.strip().partition(" ")
            if first == word:
                return rest
            assert (word, first) == ("gone", "ended"), line
            self.reason = rest
        raise AssertionError(self.complaints.read_text(encoding="utf-8"))

    def close(self):
        self.server.stdin.close()
        self.server.wait(PATIENCE)
        self.server.stdout.close()


@pytest.fixture
def victims(copied, tmp_path):
    served = Victims(copied(tmp_path / "warming").folder, tmp_path / "complaints.txt")
    yield served
    served.close()


def is_there(process):
    """Whether a process still runs; one that only waits to be buried does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for_the_end_of(processes):
    until = time.monotonic() + PATIENCE
    while any(map(is_there, processes)):
        assert time.monotonic() < until, f"still there: {[each for each in processes if is_there(each)]}"
        time.sleep(0.02)


def pages(small):
    """The report's files, but for the line that tells what a page was made from."""
    return {
        path.relative_to(small.folder).as_posix(): re.sub(
            r"<!-- made from .* -->", "", path.read_text(encoding="utf-8")
        )
        for path in sorted((small.folder / "report").rglob("*.html"))
    }


def expect_whole(small, expected, expected_pages):
    """Expect of what a kill left that every file is as it would have become."""
    assert small.contents().items() <= expected.items()
    assert pages(small).items() <= expected_pages.items()
    for text in (small.layout.summary_json, small.layout.catalogue):
        assert not text.exists() or text.read_text(encoding="utf-8").endswith("}\n")


def clear(small):
    for folder in (small.layout.processed, small.folder / "report"):
        shutil.rmtree(folder, ignore_errors=True)


def undisturbed_duration(small, victims):
    """Seconds that a run takes that is let alone."""
    clear(small)
    victims.prepare(small.folder)
    victims.begin()
    began = time.perf_counter()
    assert victims.hear("gone") == "0"
    assert victims.reason == ""
    return time.perf_counter() - began


def test_after_each_kill_every_file_is_whole_and_the_next_run_ends_it(undisturbed, copied, victims, tmp_path, capsys):
    expected, expected_pages, summary = undisturbed.contents(), pages(undisturbed), undisturbed.summary()
    chance = random.Random(SEED)
    small = copied(tmp_path / "small")
    durations = []
    fell = {name: Counter() for name in KILLED}
    for number in range(KILLS):
        if number % ROUND == 0:
            durations.append(min(undisturbed_duration(small, victims) for _ in range(3)))
            victims.prepare(small.folder)
        (tmp_path / "reached").write_text(f"{number} of {KILLS}\n")
        clear(small)
        killed = chance.choices(KILLED, SHARES)[0]
        run, *workers = victims.begin()
        assert len(workers) == 2
        time.sleep(chance.uniform(0.0, durations[-1]))
        where = (
            "after" if small.layout.report.exists() else "inside" if any(small.layout.tests.glob("*/*")) else "before"
        )
        fell[killed][where] += 1
        with contextlib.suppress(ProcessLookupError):  # it may have ended by now
            if killed == "run and workers":
                os.killpg(run, signal.SIGKILL)
            else:
                os.kill(run if killed == "run alone" else chance.choice(workers), signal.SIGKILL)
        status = int(victims.hear("gone"))
        if killed == "one worker":  # its test is done again, in this run
            assert (status, victims.reason) == (0, ""), victims.complaints.read_text(encoding="utf-8")
            assert small.contents() == expected, number
        if killed != "run alone":  # there the next run starts while orphans may be about to end
            wait_for_the_end_of(workers)
        expect_whole(small, expected, expected_pages)
        assert not small.run(until="report").failed, number
        wait_for_the_end_of(workers)
        assert small.contents() == expected, number
        assert small.summary() == summary, number
        assert pages(small) == expected_pages, number
        assert not list(small.folder.rglob("*.partial")), number
        if number + 1 < KILLS and (number + 1) % ROUND:
            victims.prepare(small.folder)
    with capsys.disabled():
        print(f"\n{KILLS} kills over {min(durations):.2f} to {max(durations):.2f} s of a run on two workers")
        for name, counts in fell.items():
            told = ", ".join(f"{counts[part]} {part}" for part in ("before", "inside", "after"))
            print(f"  {name}: {told} the writing of results")
    assert sum(counts["inside"] for counts in fell.values()) > 0.2 * KILLS
