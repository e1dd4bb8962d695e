"""Kills at random instants of a run on two workers, and two runs at once: nothing is damaged, nothing is lost."""

import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import time
from collections import Counter
from functools import partial

import psutil
import pytest

from processes import started, wait_until

pytestmark = [
    pytest.mark.drill,
    pytest.mark.skipif(os.name == "nt", reason="sessions of processes are POSIX's"),
]

KILLS = int(os.environ.get("DRILL_KILLS", "500"))
SEED = 5
ROUNDS = 5
"""Two runs at once, so often."""
PATIENCE = 60.0
"""Seconds within which a run that lost a worker has to end."""
ROUND = 50
"""Kills after which the duration of a run is measured anew: this machine may have other work meanwhile."""
KILLED = ("run and workers", "one worker", "run alone")
SHARES = (3, 1, 1)
ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")


def started_anew(small, complaints):
    """Start a run from nothing; it and its two workers, as soon as they are there."""
    for folder in (small.layout.processed, small.folder / "report"):
        shutil.rmtree(folder, ignore_errors=True)
    with complaints.open("w", encoding="utf-8") as stderr:
        options = {"stdout": subprocess.DEVNULL, "stderr": stderr, "env": os.environ | ONE_THREAD}
        run = started("run", small.folder, "--workers", 2, start_new_session=True, **options)
    while len(workers := [each for each in psutil.Process(run.pid).children() if is_worker(each)]) < 2:
        assert run.poll() is None, complaints.read_text(encoding="utf-8")
        time.sleep(0.01)
    return run, workers


def is_worker(process):
    with contextlib.suppress(psutil.Error):
        return any("popen_loky" in word for word in process.cmdline())
    return False


def is_there(process):
    """Whether a process still runs; one that only waits to be buried does not."""
    with contextlib.suppress(psutil.NoSuchProcess):
        return process.status() != psutil.STATUS_ZOMBIE
    return False


def wait_for_the_end_of(processes):
    there = partial(filter, is_there, processes)
    wait_until(lambda: not any(there()), PATIENCE, lambda: f"still there: {[*there()]}")


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


def undisturbed_duration(small, complaints):
    """Seconds that a run takes that is let alone, once its workers are there."""
    run, _ = started_anew(small, complaints)
    began = time.perf_counter()
    assert run.wait() == 0
    return time.perf_counter() - began


def test_after_each_kill_every_file_is_whole_and_the_next_run_ends_it(undisturbed, copied, tmp_path, capsys):
    expected, expected_pages, summary = undisturbed.contents(), pages(undisturbed), undisturbed.summary()
    chance, small, complaints = random.Random(SEED), copied(tmp_path / "small"), tmp_path / "complaints.txt"
    durations = []
    fell = {name: Counter() for name in KILLED}
    for number in range(KILLS):
        if number % ROUND == 0:
            durations.append(min(undisturbed_duration(small, complaints) for _ in range(3)))
        (tmp_path / "reached").write_text(f"{number} of {KILLS}\n")
        killed = chance.choices(KILLED, SHARES)[0]
        run, workers = started_anew(small, complaints)
        time.sleep(chance.uniform(0.0, durations[-1]))
        where = (
            "after" if small.layout.report.exists() else "inside" if any(small.layout.tests.glob("*/*")) else "before"
        )
        fell[killed][where] += 1
        with contextlib.suppress(ProcessLookupError, psutil.NoSuchProcess):  # it may have ended by now
            if killed == "run and workers":
                os.killpg(run.pid, signal.SIGKILL)
            else:
                (run if killed == "run alone" else chance.choice(workers)).kill()
        status = run.wait(PATIENCE)
        if killed == "one worker":  # its test is done again, in this run
            assert status == 0, complaints.read_text(encoding="utf-8")
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
    with capsys.disabled():
        print(f"\n{KILLS} kills over {min(durations):.2f} to {max(durations):.2f} s of a run on two workers")
        for name, counts in fell.items():
            told = ", ".join(f"{counts[part]} {part}" for part in ("before", "inside", "after"))
            print(f"  {name}: {told} the writing of results")
    assert sum(counts["inside"] for counts in fell.values()) > 0.2 * KILLS


def test_of_two_runs_at_once_one_works_and_the_other_is_refused(undisturbed, copied, tmp_path, capsys):
    expected, summary, chance = undisturbed.contents(), undisturbed.summary(), random.Random(3)
    refused = 0
    for number in range(ROUNDS):
        small = copied(tmp_path / str(number))
        runs = [started("run", small.folder, "--workers", 2)]
        time.sleep(chance.uniform(0.0, 1.0))
        runs.append(started("run", small.folder, "--workers", 2))
        ended = [(run, *run.communicate(timeout=300)) for run in runs]
        assert sorted({0, *(run.returncode for run, _, _ in ended)}) in ([0], [0, 1])
        assert any(run.returncode == 0 for run, _, _ in ended)
        for run, _, complaints in ended:
            assert "Traceback" not in complaints
            if run.returncode:
                refused += 1
                assert "this campaign is already being run, by" in complaints
                other = next(each for each in runs if each is not run)
                assert f"process {other.pid} on" in complaints or "by another process" in complaints
        assert small.contents() == expected
        assert small.summary() == summary
        assert not list(small.folder.rglob("*.partial"))
        shutil.rmtree(small.folder)
    with capsys.disabled():
        print(f"\n{ROUNDS} times two runs at once: {refused} were refused")
    assert refused > ROUNDS // 2
