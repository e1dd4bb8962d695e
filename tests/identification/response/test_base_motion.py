"""When a table counts as moving under a free vibration."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.response.base_motion import LEAST_MOTION, base_velocity, table_moves
from prism import PRISM

STEP = 0.002
TIME = np.arange(0.0, 20.0, STEP)
WEIGHT = PRISM.gravity * PRISM.critical_angle


@pytest.mark.parametrize("frequency", [0.5, 2.0, 5.0])
def test_a_sine_counts_by_the_velocity_that_it_gives(frequency):
    share = base_velocity(0.05 * WEIGHT * np.sin(2 * np.pi * frequency * TIME), STEP, PRISM)
    expected = 0.05 / np.sqrt(2) / np.hypot(1, 2 * np.pi * frequency / PRISM.p)
    assert share == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("frequency", [0.5, 2.0, 5.0, 8.0])
def test_a_twentieth_of_what_uplifts_moves_the_table(frequency):
    assert table_moves(0.05 * WEIGHT * np.sin(2 * np.pi * frequency * TIME), STEP, PRISM)


def test_noise_and_bias_of_an_accelerometer_are_no_motion():
    noise = np.random.default_rng(1).normal(0.0, 0.005 * 9.81, TIME.size)
    assert not table_moves(noise + 0.02, STEP, PRISM)
    assert base_velocity(noise, STEP, PRISM) > 0.1 * LEAST_MOTION


def test_missing_samples_are_no_motion():
    assert not table_moves(np.full(TIME.size, np.nan), STEP, PRISM)
    moving = 0.05 * WEIGHT * np.sin(2 * np.pi * TIME)
    moving[100:120] = np.nan
    assert table_moves(moving, STEP, PRISM)
