"""Hum of the mains: found with its amplitude where it is there all the time, and only there."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.signals.hum import find_hum

INTERVAL = 1 / 400
TIME = np.arange(0, 8, INTERVAL)
NOISE = np.random.default_rng(0).normal(0, 0.02, TIME.size)
MOVES = np.clip(np.minimum(TIME - 2, 6 - TIME), 0, 1)


@pytest.mark.parametrize("frequency", [50.0, 60.0, 49.9])
@pytest.mark.parametrize("amplitude", [0.1, 2.0])
def test_a_hum_is_found_with_its_amplitude(frequency, amplitude):
    motion = 3.0 * MOVES * np.sin(2 * np.pi * 4.3 * TIME)
    found = find_hum(motion + NOISE + amplitude * np.sin(2 * np.pi * frequency * TIME + 0.7), INTERVAL)
    assert found == (pytest.approx(frequency, abs=0.2), pytest.approx(amplitude, rel=0.15))


@pytest.mark.parametrize(
    "values",
    [NOISE, np.zeros_like(TIME), MOVES * np.sin(2 * np.pi * 50.0 * TIME) + NOISE, np.sin(2 * np.pi * 52.5 * TIME)],
    ids=["noise", "dead", "a table that moves at 50 Hz and rests", "another frequency"],
)
def test_what_pauses_or_has_another_frequency_is_none(values):
    assert find_hum(values, INTERVAL) is None


def test_a_slow_or_short_record_shows_none():
    assert find_hum(np.sin(2 * np.pi * 50.0 * TIME)[:100], INTERVAL) is None
    assert find_hum(np.ones(400), 0.01) is None
