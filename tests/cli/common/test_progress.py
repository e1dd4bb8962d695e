"""Progress where there is no terminal: a line every few seconds, and none for work that is quick."""

from __future__ import annotations

import time

import pytest

from colonnade.cli.common import progress
from colonnade.workflow import StageRun


@pytest.fixture
def lines(monkeypatch, capsys):
    """Wait until some lines of progress were written; return them."""
    monkeypatch.setattr(progress, "EVERY", 0.05)

    def wait_for(count):
        written, end = "", time.monotonic() + 20.0
        while written.count("\n") < count and time.monotonic() < end:
            time.sleep(0.01)
            written += capsys.readouterr().err
        return written.splitlines()

    return wait_for


def test_a_line_comes_every_few_seconds_also_while_nothing_ends(lines):
    with progress.work_progress("Reading raw files") as advance:
        assert lines(2)[:2] == ["Reading raw files, after 0 s"] * 2
        advance(2, 3)
        assert "Reading raw files: 2 of 3, after 0 s" in lines(3)
        advance(3, 3)
        assert "3 of 3 done, finishing, after 0 s" in lines(3)


def test_a_run_names_the_test_and_the_stage(lines):
    with progress.run_progress() as show:
        show(StageRun("free-01", "rocking", "done"), 4, 20)
        assert any(line.startswith("free-01 rocking: 4 of 20, after ") for line in lines(3))


def test_quick_work_writes_nothing_and_nothing_is_written_after_the_end(monkeypatch, capsys):
    with progress.work_progress("Reading raw files") as advance:
        advance(1, 3)
    monkeypatch.setattr(progress, "EVERY", 0.01)
    with progress.work_progress("Reading raw files"):
        pass
    capsys.readouterr()
    time.sleep(0.1)
    assert capsys.readouterr() == ("", "")
