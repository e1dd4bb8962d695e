"""A watch while files arrive as recorders write them: each gets its line soon, nothing is lost, memory stays."""

import json
import os
import random
import signal
import statistics
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import psutil
import pytest

import deliveries
from colonnade.store.layout import Layout
from colonnade.workflow import run
from processes import is_running, wait_until

pytestmark = pytest.mark.drill

FILES = int(os.environ.get("DRILL_FILES", "60"))
MANY = int(os.environ.get("DRILL_MANY", "1000"))
KILLS = int(os.environ.get("DRILL_WATCH_KILLS", "50"))
SEED = 11
BROKEN = b"\x00\xff not a recording, whatever its name says"
PATIENCE = 180.0


class Watch:
    """A watch in a process of its own, and the lines that it gives."""

    def __init__(self, folder, *, polled=False):
        self.lines: list[tuple[float, dict[str, Any]]] = []
        self.process = psutil.Popen(
            [sys.executable, str(Path(__file__).with_name("watcher.py")), str(folder), str(int(polled))],
            stdout=subprocess.PIPE,
            stderr=(folder / "complaints.txt").open("w"),
            text=True,
        )
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        assert self.process.stdout is not None
        for line in self.process.stdout:
            told = json.loads(line)
            if "test" in told:  # not an advice
                self.lines.append((time.time(), told))

    @property
    def last(self):
        """The last line of each test."""
        return {line["test"]: line for _, line in self.lines}

    def first_after(self, closed):
        """When the first line came on each file that was closed, if it came."""
        found: dict[str, float] = {}
        for at, line in self.lines:
            if at >= closed.get(line["test"], float("inf")):
                found.setdefault(line["test"], at)
        return found

    def wait_for(self, tests):
        wait_until(lambda: tests <= self.last.keys(), PATIENCE, lambda: f"no line on {tests - self.last.keys()}")


@contextmanager
def watching(folder, *, polled=False):
    watch = Watch(folder, polled=polled)
    try:
        yield watch
    finally:
        watch.process.send_signal(signal.SIGINT)
        try:
            watch.process.wait(30)
        except subprocess.TimeoutExpired:
            watch.process.kill()
            raise


def begun(folder):
    """A campaign with two tests that have been run; its folder."""
    (folder / "raw").mkdir(parents=True)
    (folder / "campaign.toml").write_text(deliveries.CAMPAIGN, encoding="utf-8")
    for kind in ("free", "pulse"):
        data = deliveries.content(deliveries.record(kind, 0, 1000.0, 30.0), "csv", folder)
        (folder / "raw" / f"{kind}-900.csv").write_bytes(data)
    assert not run(folder, workers=2).failed
    return folder


def deliver(folder, count, chance):
    """Put files into the raw folder in various ways; when each was closed for the last time, and which are broken."""
    closed = {}
    broken = set()
    threads = []
    for number in range(count):
        kind, suffix = chance.choice(["free", "pulse"]), deliveries.SUFFIXES[number % 4]
        path, name = folder / "raw" / f"{kind}-{number:03d}.{suffix}", f"{kind}-{number:03d}"
        data = deliveries.content(deliveries.record(kind, number % 6, 1000.0, 30.0), suffix, folder)
        way = chance.choice(deliveries.WAYS)
        if number % 12 == 7:
            data, way = BROKEN, deliveries.whole
            broken.add(name)

        def one(path=path, data=data, way=way, name=name, seed=number):
            way(path, data, random.Random(seed))
            closed[name] = time.time()

        threads.append(threading.Thread(target=one))
        threads[-1].start()
        if number % 10 != 3:  # else two at once
            time.sleep(chance.expovariate(1 / 4.0))
    for thread in threads:
        thread.join()
    return closed, broken


@pytest.mark.parametrize("polled", [False, True], ids=["events", "polled"])
def test_files_that_arrive_in_all_ways_get_their_lines(polled, tmp_path, capsys):
    folder, chance = begun(tmp_path / "campaign"), random.Random(SEED)
    with watching(folder, polled=polled) as watch:
        time.sleep(10)
        before = watch.process.cpu_times()
        time.sleep(20)
        after = watch.process.cpu_times()
        idle = (after.user + after.system - before.user - before.system) / 20
        closed, broken = deliver(folder, FILES, chance)

        def missing():
            return closed.keys() - watch.first_after(closed).keys()

        wait_until(lambda: not missing(), 2 * PATIENCE, lambda: f"no line on {missing()}", pause=0.2)
        first_after = watch.first_after(closed)
        assert {name for name in closed if watch.last[name]["status"] == "failed"} == broken
        seconds = sorted(first_after[name] - closed[name] for name in closed if name not in broken)
        # What is not done yet is done by the run behind; then nothing is left for another one.
        state = folder / "report" / "state.js"
        wait_until(lambda: is_all_done(folder, closed, broken), 20 * PATIENCE, pause=2.0)
        memory = watch.process.memory_info().rss / 1e6
    assert '"watched": false' in state.read_text(encoding="utf-8")
    failures = [line["test"] for _, line in watch.lines if line["status"] == "failed" and line["test"] not in broken]
    ended = run(folder, workers=2)
    assert all(stage.action != "done" for stage in ended.stages)
    with capsys.disabled():
        print(
            f"\n{FILES} files ({'polled' if polled else 'events'}), from close to line: median "
            f"{statistics.median(seconds):.1f} s, worst {seconds[-1]:.1f} s; {len(broken)} broken, {len(failures)} "
            f"called failed too early; idle {100 * idle:.2f} % of a core; {memory:.0f} MB"
        )
    assert not failures
    assert idle < 0.01


def is_all_done(folder, closed, broken):
    try:
        summary = json.loads((folder / "processed" / "summary.json").read_text(encoding="utf-8"))
    except OSError:
        return False
    states = {name: each["status"] for name, each in summary["tests"].items()}
    return all(states.get(name) == ("failed" if name in broken else "done") for name in closed)


def test_memory_is_steady_over_many_files(tmp_path, capsys):
    folder = begun(tmp_path / "campaign")
    data = deliveries.content(deliveries.record("pulse", 2, 200.0, 4.0), "csv", folder)
    with watching(folder) as watch:
        memory = []
        for number in range(MANY):
            (folder / "raw" / f"pulse-{number:04d}.csv").write_bytes(data + b"\n" * (number % 7))
            if number % (MANY // 10) == MANY // 10 - 1:
                watch.wait_for({f"pulse-{each:04d}" for each in range(number + 1)})
                memory.append(watch.process.memory_info().rss / 1e6)
    with capsys.disabled():
        print(f"\nmemory over {MANY} files, MB: {', '.join(f'{each:.0f}' for each in memory)}")
    assert memory[-1] < memory[1] + 60


def test_nothing_is_lost_when_the_watch_is_killed(tmp_path, capsys):
    folder, chance = begun(tmp_path / "campaign"), random.Random(SEED)
    data = {
        kind: deliveries.content(deliveries.record(kind, 1, 200.0, 6.0), "csv", folder) for kind in ("free", "pulse")
    }
    names = []
    for number in range(KILLS):
        watch = Watch(folder)
        kind = chance.choice(["free", "pulse"])
        names.append(f"{kind}-{number:03d}")
        time.sleep(chance.uniform(0.0, 6.0))
        (folder / "raw" / f"{names[-1]}.csv").write_bytes(data[kind])
        time.sleep(chance.uniform(0.0, 6.0))
        watch.process.kill()
        watch.process.wait()
    with watching(folder) as watch:
        wait_until(lambda: is_all_done(folder, names, set()), 20 * PATIENCE, pause=2.0)
    wait_until(lambda: not is_running(Layout(folder)), PATIENCE)  # what ran behind the last killed one ends soon
    assert all(stage.action != "done" for stage in run(folder, workers=2).stages)
    assert not list(folder.rglob("*.partial"))
    with capsys.disabled():
        print(f"\n{KILLS} kills of a watch: all of {len(names)} tests are done")
