"""A folder rings when something is written in it, and is polled if it is on another machine."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from colonnade.workflow.watching import folders
from colonnade.workflow.watching.folders import Bell, listening


def test_a_file_that_is_written_rings(tmp_path: Path) -> None:
    with listening(tmp_path) as bell:
        if not bell.has_events:
            pytest.skip("this system gives no events")
        (tmp_path / "a.csv").write_text("1\n")
        began = time.monotonic()
        bell.wait()
        assert time.monotonic() - began < folders.REST / 2


def test_a_folder_that_is_not_there_is_polled(tmp_path: Path) -> None:
    with listening(tmp_path / "none") as bell:
        assert not bell.has_events


def test_a_remote_folder_is_polled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folders, "_is_remote", lambda folder: True)
    with listening(tmp_path) as bell:
        assert not bell.has_events


def test_a_wait_ends_when_it_is_due() -> None:
    began = time.monotonic()
    Bell(has_events=False).wait(0.05)
    assert 0.04 < time.monotonic() - began < 1.0
