"""What a signal looks like, against signals whose shape is known."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.campaign.draft.signal import shape_of, steady_sine

TIME = np.arange(0.0, 12.0, 0.005)
NOISE = np.random.default_rng(3).normal(size=TIME.size)


@pytest.mark.parametrize("frequency", [0.7, 1.0, 3.3, 7.0])
@pytest.mark.parametrize("noise", [0.0, 0.2], ids=["clean", "noisy"])
def test_a_steady_sine_is_seen_with_its_frequency_also_between_rests(frequency, noise):
    signal = np.where((TIME > 2) & (TIME < 10), np.sin(2 * np.pi * frequency * TIME), 0.0) + noise * NOISE
    assert steady_sine(signal, 0.005) == pytest.approx(frequency, rel=0.02)


@pytest.mark.parametrize(
    "signal",
    [
        pytest.param(NOISE, id="noise"),
        pytest.param(np.sin(2 * np.pi * 3 * TIME) * (np.abs(TIME - 6) < 0.2), id="pulse"),
        pytest.param(np.sin(2 * np.pi * (0.5 + TIME) * TIME), id="sweep"),
        pytest.param(TIME, id="ramp"),
    ],
)
def test_what_is_no_steady_sine_is_not_taken_for_one(signal):
    assert steady_sine(signal, 0.005) is None


def test_a_free_vibration_dies_away_and_a_sine_does_not():
    decay = np.where(TIME < 8, np.exp(-0.6 * TIME) * np.cos(9 * TIME), 0.0)
    assert shape_of(decay, TIME).dies_away
    assert not shape_of(np.sin(9 * TIME), TIME).dies_away


@pytest.mark.parametrize(
    "values", [np.full(50, 3.0), np.full(50, np.nan), np.empty(0)], ids=["constant", "missing", "empty"]
)
def test_what_never_changes_is_dead(values):
    assert shape_of(values, None).is_dead


def test_a_running_number_counts_and_a_clock_does_not():
    assert shape_of(np.arange(50.0), None).counts
    assert not shape_of(np.arange(50.0) / 50, None).counts


def test_values_too_large_to_square_are_no_accident():
    assert shape_of(np.array([1e300, -1e300] * 40), np.arange(80.0)).sine is None
