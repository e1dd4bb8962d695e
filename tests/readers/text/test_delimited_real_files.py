"""Files of other laboratories, with the figures that are known of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from colonnade.readers.registry import read
from every import every


def test_a_shake_table_recording_with_names_and_units_rows(shared_data: Path) -> None:
    recording = read(shared_data / "shaketable" / "thadhaines_01.csv")
    assert len(recording.channels) == 33
    assert recording.warnings == ()
    table = recording.channel("Table accel XXXX")
    assert table.unit == "g's"
    assert recording.channel("LED Light").unit is None
    assert table.time is not None
    assert table.time[[0, -1]].tolist() == [0.0, 8.999]  # 1000 Hz, 9 s
    assert np.allclose(np.diff(table.time), 1e-3, atol=1e-9)
    assert np.ptp(table.values) / 2 == pytest.approx(0.35, abs=0.03)  # table ±0.35 g, with noise
    drive = recording.channel("Output To Table")
    assert drive.unit == "Volts"
    assert np.abs(drive.values).max() == pytest.approx(1.0, abs=0.05)  # 2 Hz sine ±1 V
    light = recording.channel("LED Light").values < 2
    assert table.time[light][[0, -1]] == pytest.approx([3.731, 6.189], abs=0.002)
    assert recording.channel("Block accel 26430").values.std() == pytest.approx(0.006, abs=0.001)


@every(("name", "rows"), [("earthquake-test1.csv", 4092), ("sinewave-test1.csv", 1400)])
def test_recordings_without_header_and_clock(shared_data: Path, name: str, rows: int) -> None:
    recording = read(shared_data / "shaketable" / name)
    assert [channel.name for channel in recording.channels] == ["column 1", "column 2", "column 3"]
    assert all(channel.values.size == rows and np.isfinite(channel.values).all() for channel in recording.channels)
    assert all(channel.time is None and channel.unit is None for channel in recording.channels)
    assert recording.warnings == ()


def test_the_first_samples_of_a_file_without_header_are_kept(shared_data: Path) -> None:
    recording = read(shared_data / "shaketable" / "sinewave-test1.csv")
    assert recording.channel(2).values[:3].tolist() == [0.009, 0.0262, 0.0434]
