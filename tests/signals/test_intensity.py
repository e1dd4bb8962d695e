"""Peak velocity, peak displacement and Arias intensity against closed forms; what drifts is refused."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.signals.intensity import arias_intensity, table_displacement, table_velocity

INTERVAL = 0.002
TIME = np.arange(0, 10, INTERVAL)
INSIDE = (TIME >= 2) & (TIME < 6)
PULSE = np.where(INSIDE, np.sin(2 * np.pi * (TIME - 2) / 4) * 2.0, 0.0)
"""One period of a sine, 4 s long, 2 m/s²: v = A T/(2π) (1 − cos), largest A T/π; u at the end A T²/(2π)."""


def test_the_peak_velocity_of_a_sine_pulse():
    assert table_velocity(PULSE, INTERVAL).peak == pytest.approx(2.0 * 4 / np.pi, rel=1e-4)


def test_the_displacement_of_a_motion_that_returns():
    late = (TIME - 4) / 0.5
    returning = 0.03 / 0.5**2 * (4 * late**2 - 2) * np.exp(-(late**2))  # u = 0.03 exp(−late²)
    found = table_displacement(returning, INTERVAL)
    assert found.peak == pytest.approx(0.03, rel=1e-4)
    assert found.drift < 1e-2


def test_a_constant_error_of_the_acceleration_is_taken_off_while_it_is_small():
    assert table_velocity(PULSE + 0.005, INTERVAL).peak == pytest.approx(2.0 * 4 / np.pi, rel=2e-2)
    spoilt = table_velocity(PULSE + 0.1, INTERVAL)
    assert np.isnan(spoilt.peak)
    assert spoilt.drift > 0.25


def test_a_displacement_that_does_not_return_is_refused():
    assert np.isnan(table_displacement(PULSE, INTERVAL).peak)


def test_a_velocity_that_drifts_gives_no_displacement():
    assert np.isnan(table_displacement(PULSE + 0.1, INTERVAL).peak)


def test_the_arias_intensity_of_a_steady_sine():
    sine = 3.0 * np.sin(2 * np.pi * 2 * TIME)
    assert arias_intensity(sine, INTERVAL, 9.81) == pytest.approx(np.pi / (2 * 9.81) * 9.0 / 2 * 10, rel=1e-3)


def test_a_table_at_rest_has_no_intensity():
    rest = np.zeros(100)
    assert (arias_intensity(rest, 0.01, 9.81), table_velocity(rest, 0.01).peak) == (0.0, 0.0)
