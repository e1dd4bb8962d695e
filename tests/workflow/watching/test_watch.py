"""A watch handles what arrives, gives a line on each test, and leaves what a run would."""

import os
import shutil
import signal
import time
from contextlib import nullcontext, suppress
from dataclasses import dataclass

import pytest

from colonnade.errors import StoreError
from colonnade.store.records.advice import Advice
from colonnade.workflow.lock import is_refusal, only_run
from colonnade.workflow.watching import watch as module
from colonnade.workflow.watching.measure import Line
from colonnade.workflow.watching.watch import Behind, Ended, watch
from prism import entry
from processes import is_running, wait_until

pytestmark = pytest.mark.whole


def test_arriving_files_become_lines_and_the_rest_follows(small, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "GRACE", 1.0)
    share = tmp_path / "share"
    share.mkdir()
    for test in ("pulse-02", "free-02"):
        shutil.move(small.raw(test), share)
        shutil.rmtree(small.layout.test(test))
        small.edit(f'id = "{test}"', f'id = "{test}"\nplanned = true')
    broken = share / "pulse-03.csv"
    broken.write_bytes(b"\x00\x01 nothing that can be read")
    with (small.folder / "campaign.toml").open("a", encoding="utf-8") as campaign_file:
        campaign_file.write(entry("pulse-03", "pulse", "planned = true"))
    shown = []
    said = []
    code = watch(small.folder, share=share, once=True, workers=1, show=shown.append, say=said.append)
    found = {line.test: line for line in shown if isinstance(line, Line)}
    assert set(found) == {"pulse-02", "free-02", "pulse-03"}
    assert found["pulse-03"].record.status == "failed"
    assert code == 1
    assert found["pulse-02"].record.outcome == "overturned"
    assert found["pulse-02"].record.predicted["nonlinear"].outcome == "overturned"
    assert found["free-02"].restitution.tests == ("free-01", "free-02")
    assert "e 0.930" in found["free-02"].text()
    assert [each.kind for each in shown if isinstance(each, Advice)] == ["free-vibration"]
    assert small.summary()["tests"]["pulse-02"]["status"] == "done"
    assert any(sentence.startswith("pulse-03") for sentence in said)
    assert (small.folder / "report" / "tests" / "free-02.html").exists()
    assert "free-02" in small.layout.watch_log.read_text(encoding="utf-8")
    assert '"watched": false' in small.layout.state.read_text(encoding="utf-8")
    before = small.contents()
    assert watch(small.folder, once=True, workers=1, show=shown.append, say=said.append) == 1
    assert small.contents() == before


def watched(small, **options):
    """Watch once; the exit code and what is said."""
    said = []
    return watch(small.folder, once=True, show=lambda line: None, say=said.append, **options), said


@dataclass
class Crashing:
    """Runs behind that end at once, as told; the last end is that of all further ones."""

    ends: list[Ended]
    starts: int = 0

    def start(self, *given):
        self.starts += 1
        return self

    def ended(self):
        return self.ends.pop(0) if len(self.ends) > 1 else self.ends[0]

    def give_way(self):
        pass


@pytest.fixture
def crashing(monkeypatch):
    """What stands in for the run behind every watch of a test."""
    said = "OSError: y\nTraceback (most recent call last):\n  x\nOSError: y"
    behind = Crashing([Ended((), said)])
    monkeypatch.setattr(module, "Behind", behind.start)
    return behind


def test_a_crash_of_the_run_behind_is_said_once_and_waits_for_the_next_file(small, crashing):
    code, said = watched(small)
    assert (code, crashing.starts) == (1, 1)
    assert [sentence.splitlines()[0] for sentence in said] == [
        "The run behind the watch failed: OSError: y",
    ]
    assert str(small.layout.watch_log) in said[0]
    assert "Traceback" in small.layout.watch_log.read_text(encoding="utf-8")


def test_a_run_behind_that_is_refused_is_tried_again_and_a_share_that_is_gone_is_said_once(
    small, crashing, monkeypatch
):
    monkeypatch.setattr(module, "AGAIN", 0.1)
    crashing.ends = [Ended((), "small: this campaign is already being run"), Ended()]
    code, said = watched(small, share=small.folder / "gone")
    assert (code, crashing.starts, len(said)) == (0, 2, 1)
    assert "this folder cannot be seen" in said[0]


def test_a_watch_for_once_ends_if_results_cannot_be_written(small, crashing, monkeypatch):
    def full(*_):
        raise StoreError("a.nc: the disk is full.")

    monkeypatch.setattr(module, "measure", full)
    small.change_a_sample("pulse-02")
    code, said = watched(small)
    assert (code, said[0]) == (1, "a.nc: the disk is full.")


@pytest.mark.parametrize(
    "change", [lambda small: small.raw("pulse-02").unlink(), lambda small: small.edit("A small", "B")]
)
def test_a_deleted_file_or_another_word_in_the_campaign_starts_the_run_behind(small, crashing, monkeypatch, change):
    crashing.ends = [Ended()]
    starts = []

    def wait(longest):
        starts.append(crashing.starts)
        if len(starts) == 3:
            change(small)
        if crashing.starts == 2:
            raise KeyboardInterrupt
        assert len(starts) < 100
        time.sleep(0.05)

    monkeypatch.setattr(module, "listening", lambda folder: nullcontext(wait))
    with pytest.raises(KeyboardInterrupt):
        watch(small.folder, show=lambda line: None, say=lambda sentence: None)
    assert starts[:3] == [1, 1, 1]


def test_advice_after_a_free_vibration_knows_those_just_before_it(small, crashing, monkeypatch):
    small.layout.summary_json.unlink()  # the run behind has not come so far yet
    for test in ("free-01", "free-02"):
        shutil.rmtree(small.layout.test(test))
    shown = []
    watch(small.folder, once=True, show=shown.append, say=lambda sentence: None)
    lines = [each.text() for each in shown]
    assert "identified from 2 free vibrations" in lines[2]
    assert "from 2" in lines[3]


def test_it_gives_way_and_then_says_what_failed_and_when_it_was_refused(small):
    small.raw("pulse-02").write_text("nothing\n")
    given = (small.folder / "campaign.toml", None, 1)
    behind = Behind(*given)
    assert behind.ended() is None
    behind.give_way()
    found = wait_until(Behind(*given).ended)
    assert found.problem == ""
    assert [failure.partition(":")[0] for failure in found.failures] == ["pulse-02"]
    with only_run(small.layout):
        assert is_refusal(wait_until(Behind(*given).ended).problem)


def test_workers_of_the_run_behind_write_nothing_between_the_lines(small, tmp_path, monkeypatch, capfd):
    # Joblib's workers print a traceback where the run that started them is killed just then.
    there = tmp_path / "there"
    text = "import sys\nif 'popen_loky' in str(sys.orig_argv):\n    print('a worker', flush=True)\n"
    text += f"    open({str(there)!r}, 'w').close()\n"
    (tmp_path / "sitecustomize.py").write_text(text, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    small.change_a_sample("pulse-01")
    small.change_a_sample("pulse-02")
    behind = Behind(small.folder / "campaign.toml", None, 2)
    wait_until(there.exists)
    behind.give_way()
    assert "a worker" not in capfd.readouterr().out


def test_a_run_that_is_killed_says_so(small):
    behind = Behind(small.folder / "campaign.toml", None, 1)
    behind._process.kill()
    found = wait_until(behind.ended)
    assert found.problem == "It ended with exit code -9."


WATCH = """
import sys, time
from pathlib import Path
from colonnade.workflow.watching.watch import Behind

behind = Behind(Path(sys.argv[1]), None, 1)
print("watching", flush=True)
time.sleep(600)
"""


@pytest.mark.skipif(os.name != "posix", reason="a process is killed as only POSIX does")
def test_it_ends_when_the_watch_is_killed(start, small):
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
        wait_until(lambda: not is_running(small.layout))
    finally:
        if run:
            with suppress(ProcessLookupError):
                os.killpg(run, signal.SIGKILL)
