"""The measured peak that predictions are compared with."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from colonnade.dynamics.rock import rock
from colonnade.stages.parts.peak import find_peak
from prism import PRISM

HELD = 1.0
"""s, before the release."""


@pytest.fixture
def released():
    """A free vibration from 0.5 α, held for a second, and a prediction from its first impact on."""
    free = rock(PRISM, restitution=0.93, theta0=0.5 * PRISM.critical_angle, duration=4.0, model="nonlinear")
    time = np.arange(0.0, 5.0, 0.005)
    angle = np.interp(time - HELD, free.time, free.angle)
    known = np.where(time > HELD + free.impact_times[0], angle, np.nan)
    rocking, predicted = (
        xr.Dataset({"rocking_angle": ("elapsed", values)}, coords={"elapsed": ("elapsed", time)})
        for values in (angle, known)
    )
    return rocking.assign_attrs(outcome="rocking"), predicted


def test_the_release_is_found_before_the_time_that_is_predicted(released):
    rocking, predicted = released
    peak = find_peak(rocking, {"nonlinear": predicted}, PRISM, free_vibration=True)
    assert peak.release == pytest.approx(0.5, abs=1e-3)
    after = np.abs(rocking["rocking_angle"].to_numpy()[np.isfinite(predicted["rocking_angle"])]) / PRISM.critical_angle
    assert peak.ratio == after.max() < 0.5


def test_of_other_tests_the_peak_is_that_of_the_whole_record():
    rocking = xr.Dataset({"rocking_angle": ("elapsed", np.zeros(3)), "peak_ratio": 0.3, "peak_time": 2.0})
    assert find_peak(rocking, {}, PRISM, free_vibration=False)[:2] == (0.3, 2.0)


def test_without_a_measured_angle_nothing_is_known():
    assert np.isnan(find_peak(xr.Dataset(), {}, PRISM, free_vibration=True)).all()
