"""BHRC records: tenths of g, and the step from the header's rate."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read


def test_tenths_of_g_come_out_in_g_on_a_clock_of_the_headers_rate(written: Callable[..., Path]) -> None:
    recording = read(written("bhrc", ("L1", "g", np.linspace(0, 0.4, 41)), samples=41))
    (channel,) = recording.channels
    assert (channel.name, channel.unit) == ("L1", "g")
    np.testing.assert_allclose(channel.values, np.linspace(0, 0.4, 41), atol=1e-6)
    np.testing.assert_allclose(channel.time, np.arange(41) / 200, atol=1e-9)
    assert any("41 points at 200 Hz, the header's rate" in note for note in recording.notes)
    assert recording.warnings == ()


def test_the_rate_holds_where_the_duration_counts_another_number_of_steps(written: Callable[..., Path]) -> None:
    path = written("bhrc", ("L1", "g", np.arange(40.0)))
    text = path.read_text()
    for duration in ("0.200", "0.205"):  # of 40 steps, of 41
        path.write_text(text.replace("0.195", duration), encoding="ascii")
        recording = read(path)
        np.testing.assert_allclose(recording.channels[0].time, np.arange(40) / 200, atol=1e-12)
        assert recording.warnings == ()
    path.write_text(text.replace("0.195", "0.400"), encoding="ascii")
    (told,) = read(path).warnings
    assert "40 points at the header's 200 Hz last 0.2 s, and the header says 0.4 s" in told


def test_without_a_rate_the_duration_gives_the_step(written: Callable[..., Path]) -> None:
    path = written("bhrc", ("L1", "g", np.arange(40.0)))
    path.write_text(path.read_text().replace(".200000E+03", ".000000E+00"), encoding="ascii")
    np.testing.assert_allclose(read(path).channels[0].time, np.arange(40) / 200, atol=1e-12)


def test_a_component_that_was_cut_off_says_how_many_points_are_there(written: Callable[..., Path]) -> None:
    path = written("bhrc", ("L1", "g", np.arange(40.0)))
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-2]) + "\n", encoding="ascii")
    recording = read(path)
    assert recording.channels[0].values.size == 30
    assert recording.warnings == ('"L1": the header gives 40 points, but the file has 30: it ends too early',)


def test_a_unit_that_is_not_known_is_refused(written: Callable[..., Path]) -> None:
    path = written("bhrc")
    path.write_text(path.read_text().replace("G/10", "CM"), encoding="ascii")
    with pytest.raises(ReadError, match='unit "CM"; two points or more and a unit among g/10'):
        read(path)
