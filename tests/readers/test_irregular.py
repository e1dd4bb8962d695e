"""What a path leads to if not to a file."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from colonnade.readers.irregular import irregular


def test_folders_pipes_and_devices_are_named(tmp_path: Path) -> None:
    assert irregular(tmp_path) == "a folder"
    if not hasattr(os, "mkfifo"):
        pytest.skip("this system has no named pipes")
    os.mkfifo(tmp_path / "pipe")
    assert irregular(tmp_path / "pipe") == "a named pipe"
    assert irregular(Path(os.devnull)) == "a device"


def test_a_file_and_what_is_missing_are_not(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("1\n")
    assert irregular(tmp_path / "a.csv") == ""
    assert irregular(tmp_path / "b.csv") == ""
