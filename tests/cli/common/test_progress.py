"""Progress where there is no terminal: a line now and then, and none for work that is quick."""

from __future__ import annotations

import pytest

from colonnade.cli.common import progress
from colonnade.workflow import StageRun


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test sets."""

    class Clock:
        now = 100.0

    monkeypatch.setattr(progress.time, "monotonic", lambda: Clock.now)
    return Clock


def test_a_line_comes_only_after_some_time_and_not_at_the_end(clock, capsys):
    with progress.work_progress("Reading raw files") as advance:
        advance(1, 3)
        clock.now += progress.EVERY
        advance(2, 3)
        advance(2, 3)
        clock.now += progress.EVERY
        advance(3, 3)
    assert capsys.readouterr() == ("", f"Reading raw files: 2 of 3 after {progress.EVERY:.0f} s\n")


def test_a_run_names_the_test_and_the_stage(clock, capsys):
    stage = StageRun("free-01", "rocking", "done")
    with progress.run_progress() as show:
        clock.now += progress.EVERY
        show(stage, 4, 20)
    assert capsys.readouterr().err == f"free-01 rocking: 4 of 20 after {progress.EVERY:.0f} s\n"
