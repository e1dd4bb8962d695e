"""ASAM MDF: groups with their own clocks."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read, read_here

asammdf = pytest.importorskip("asammdf")


def test_every_group_keeps_its_own_clock_and_text_is_left_out(tmp_path: Path) -> None:
    time = np.arange(50) / 200
    slow = 0.1 + np.arange(10) / 50
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal((100 * time).astype("i2"), time, name="top", unit="mm")])
        file.append(
            [
                asammdf.Signal(np.cos(slow), slow, name="table", unit="g"),
                asammdf.Signal(np.array([b"on"] * 10), slow, name="state", encoding="utf-8"),
            ]
        )
        path = Path(file.save(tmp_path / "record.mf4"))
    recording = read(path)
    top, table = recording.channels
    assert (top.name, top.unit, table.name, table.unit) == ("top", "mm", "table", "g")
    np.testing.assert_allclose(top.time, time)
    np.testing.assert_allclose(table.time, slow)
    assert any('no numbers in "state"' in note for note in recording.notes)
    assert recording.start is not None


def test_a_file_that_was_not_closed_says_so(written: Callable[..., Path]) -> None:
    path = written("mdf")
    path.write_bytes(b"UnFinMF " + path.read_bytes()[8:])
    try:
        told = " ".join(read(path).warnings)
    except ReadError as error:
        told = str(error)
    assert "did not close" in told or "cannot be read" in told


def test_a_damaged_file_is_told_with_what_to_do(
    written: Callable[..., Path], monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    path = written("mdf")
    path.write_bytes(path.read_bytes()[:150])
    complaints: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", complaints.append)
    with pytest.raises(ReadError, match=r"record.mf4: asammdf cannot read it .* copy it from the recorder again"):
        read_here(path, "mdf", {}, None)
    gc.collect()
    assert complaints == []  # of what asammdf leaves half built
    assert capfd.readouterr().err == ""
