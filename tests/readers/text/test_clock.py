"""Clocks of text files that are called otherwise, or not at all."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from colonnade.readers.recording import Recording
from colonnade.readers.registry import read


def recorded(folder: Path, text: str) -> Recording:
    path = folder / "record.txt"
    path.write_text(text)
    return read(path)


def rows(times: np.ndarray, form: str = "{:.4f}") -> str:
    return "".join(f"{form.format(time)}\t{np.sin(7 * time):.5f}\t{np.cos(5 * time):.5f}\n" for time in times)


def test_the_time_of_a_graph_that_labview_exported_is_the_clock(tmp_path: Path) -> None:
    head = "Time [ms] - Plot 0\tAmplitude [mm] - Plot 0\tAmplitude [g] - Plot 1\n"
    recording = recorded(tmp_path, head + rows(5.0 * np.arange(50)))
    clock, first, second = recording.channels
    assert clock.is_clock
    np.testing.assert_allclose(first.time, 0.005 * np.arange(50))
    assert (first.name, first.unit, second.name, second.unit) == ("Amplitude - Plot 0", "mm", "Amplitude - Plot 1", "g")
    assert recording.channel("Amplitude [g] - Plot 1") is second


@pytest.mark.parametrize("head", ["", "\ttop\tbottom\n"], ids=["no names at all", "no name above it"])
@pytest.mark.parametrize(
    ("rate", "form"), [(200.0, "{:.4f}"), (600.0, "{:.3f}")], ids=["exact times", "times rounded to milliseconds"]
)
def test_a_first_column_without_a_name_that_rises_in_equal_steps_is_the_clock(
    tmp_path: Path, head: str, rate: float, form: str
) -> None:
    times = 3.0 + np.arange(100) / rate
    recording = recorded(tmp_path, head + rows(times, form))
    assert recording.channels[0].is_clock
    np.testing.assert_allclose(recording.channels[1].time, times, atol=6e-4)
    assert any("no name and rises in equal steps" in note for note in recording.notes)


@pytest.mark.parametrize(
    "times",
    [
        pytest.param(np.arange(60.0), id="numbers of samples"),
        pytest.param(5.0 * np.arange(60), id="perhaps milliseconds"),
        pytest.param(0.01 * np.arange(60) ** 1.5, id="unequal steps"),
        pytest.param(-0.01 * np.arange(60), id="falling"),
    ],
)
def test_what_may_be_something_else_is_not_taken_for_a_clock(tmp_path: Path, times: np.ndarray) -> None:
    assert not any(channel.is_clock for channel in recorded(tmp_path, rows(times)).channels)


def test_a_first_column_with_a_name_is_what_its_name_says(tmp_path: Path) -> None:
    assert not any(
        channel.is_clock for channel in recorded(tmp_path, "ramp\ttop\tx\n" + rows(np.arange(60) / 200)).channels
    )
