"""BHRC records: tenths of g, and the step from the duration."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read


def test_tenths_of_g_come_out_in_g_on_a_clock_over_the_duration(written: Callable[..., Path]) -> None:
    recording = read(written("bhrc", ("L1", "g", np.linspace(0, 0.4, 41)), samples=41))
    (channel,) = recording.channels
    assert (channel.name, channel.unit) == ("L1", "g")
    np.testing.assert_allclose(channel.values, np.linspace(0, 0.4, 41), atol=1e-6)
    np.testing.assert_allclose(channel.time, np.arange(41) / 200, atol=1e-9)
    assert any("200.000 Hz" in note and "own rate is 200 Hz" in note for note in recording.notes)


def test_a_component_that_was_cut_off_says_how_many_points_are_there(written: Callable[..., Path]) -> None:
    path = written("bhrc", ("L1", "g", np.arange(40.0)))
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-2]) + "\n", encoding="ascii")
    recording = read(path)
    assert recording.channels[0].values.size == 30
    assert recording.warnings == ('"L1": the header announces 40 points and 30 are there: the file ends too early',)


def test_a_unit_that_is_not_known_is_refused(written: Callable[..., Path]) -> None:
    path = written("bhrc")
    path.write_text(path.read_text().replace("G/10", "CM"), encoding="ascii")
    with pytest.raises(ReadError, match='unit "CM"; two points or more and a unit among g/10'):
        read(path)
