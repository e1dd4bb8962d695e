"""Velocity and displacement of tables and of the ground against closed forms; corrections of known errors."""

import numpy as np
import pytest

from colonnade.assessment.ground import Ground, correction_of
from colonnade.assessment.measures import intensity_measures, table_measures
from colonnade.dynamics.motion import Motion

INTERVAL = 0.002
TIME = np.arange(0, 10, INTERVAL)
INSIDE = (TIME >= 2) & (TIME < 6)
PULSE = np.where(INSIDE, np.sin(2 * np.pi * (TIME - 2) / 4) * 2.0, 0.0)
"""One period of a sine, 4 s long, 2 m/s²: v = A T/(2π) (1 − cos), largest A T/π; u at the end A T²/(2π)."""
VELOCITY = 2.0 * 4 / np.pi


def measured(values):
    found, drift = table_measures(values, INTERVAL)
    return found["pgv"], found["pgd"], drift


def test_a_sine_pulse_has_its_peak_velocity_and_a_displacement_that_does_not_return_is_refused():
    velocity, displacement, _ = measured(PULSE)
    assert velocity == pytest.approx(VELOCITY, rel=1e-4)
    assert np.isnan(displacement)


def test_the_displacement_of_a_motion_that_returns():
    late = (TIME - 4) / 0.5
    returning = 0.03 / 0.5**2 * (4 * late**2 - 2) * np.exp(-(late**2))  # u = 0.03 exp(−late²)
    _, displacement, drift = measured(returning)
    assert displacement == pytest.approx(0.03, rel=1e-4)
    assert drift < 1e-2


def test_a_constant_error_of_the_acceleration_is_taken_off_while_it_is_small():
    assert measured(PULSE + 0.005)[0] == pytest.approx(VELOCITY, rel=2e-2)
    spoilt, _, drift = measured(PULSE + 0.1)
    assert np.isnan(spoilt)
    assert drift == pytest.approx(Ground(PULSE + 0.1, INTERVAL, at_rest=True).drift)  # of what is refused first
    assert drift > 0.25


@pytest.mark.parametrize("error", [0.0, 0.005, 0.04, 0.1])
def test_a_motion_has_one_pgv_whoever_asks(error):
    """The measures of a motion known to rest at its ends are those of a table; of the ground the rule is another."""
    values = PULSE + error
    asked = intensity_measures(Motion(values, INTERVAL), measures=["pgv", "pgd", "arias"], at_rest=True)
    assert asked.values == pytest.approx(table_measures(values, INTERVAL)[0], nan_ok=True)
    assert np.isnan(asked.values["pgv"]) == (error == 0.1)
    ground = intensity_measures(Motion(values, INTERVAL), measures=["pgv"])
    assert np.isnan(ground.values["pgv"]) == (error >= 0.04)


STEP = 0.01
HALF_MINUTE = np.arange(3001) * STEP
TRUE = 2.0 * np.sin(2 * np.pi * 1.5 * HALF_MINUTE) * np.sin(np.pi * HALF_MINUTE / HALF_MINUTE[-1]) ** 2
ERRORS = {
    "linear": np.full_like(HALF_MINUTE, 0.02),
    "quadratic": 0.02 + 0.003 * HALF_MINUTE,
    "highpass": 0.03 * np.sin(np.pi * HALF_MINUTE / HALF_MINUTE[-1]) ** 2,
}


@pytest.mark.parametrize("name", ERRORS)
def test_a_correction_takes_off_the_error_that_it_is_made_for(name):
    drifting = Ground(TRUE + ERRORS[name], STEP)
    found = Ground(correction_of(name)(TRUE + ERRORS[name], STEP), STEP)
    assert drifting.drift > 0.3
    assert found.drift < 0.05
    assert np.abs(found.velocity).max() == pytest.approx(np.abs(Ground(TRUE, STEP).velocity).max(), rel=0.05)


def test_the_highpass_passes_what_is_faster_than_its_corner():
    rapid = np.sin(2 * np.pi * 2.0 * HALF_MINUTE) * np.hanning(HALF_MINUTE.size)
    passed = correction_of("highpass(0.2 Hz)")(rapid, STEP)
    assert np.abs(passed - rapid).max() < 2e-3
    slow = np.sin(2 * np.pi * 0.05 * HALF_MINUTE) * np.hanning(HALF_MINUTE.size)
    assert np.abs(correction_of("highpass(0.5 Hz)")(slow, STEP)).max() < 2e-3
