"""Calibration of the contact damping: the law found gives the restitution asked for, in a run of its own."""

import numpy as np
import pytest

from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.calibration import TOLERANCE, calibrate, free_restitution
from colonnade.dynamics.contact.simulate import simulate
from prism import PRISM

BODY = rigid_body(PRISM)
LAW = ContactLaw(penetration=1e-6).bearing(BODY, PRISM.gravity)
STEP = 3e-5


@pytest.fixture(scope="module")
def calibrated():
    return calibrate(BODY, LAW, 0.976, step=STEP, impacts=4, fractions=(0.1, 0.4))


def test_the_law_gives_the_restitution_in_a_run_of_its_own(calibrated):
    assert calibrated.reason == ""
    assert 0.1 < calibrated.history.law.damping_fraction < 0.4
    assert calibrated.history.energies.relative_residual < 0.01
    history = simulate(BODY, law=calibrated.history.law, theta0=0.5 * PRISM.critical_angle, duration=2.5, step=STEP)
    assert free_restitution(history, impacts=4) == pytest.approx(0.976, abs=TOLERANCE)
    # Energies of the peaks, Housner's relation, tell the same as velocities at impacts.
    peaks = [
        np.abs(history.angle[(history.time > start) & (history.time < end)]).max()
        for start, end in zip(history.impact_times[:-1], history.impact_times[1:], strict=True)
    ]
    energies = np.cos(PRISM.critical_angle - np.array(peaks)) - np.cos(PRISM.critical_angle)
    assert (energies[3] / energies[0]) ** (1 / 6) == pytest.approx(0.976, abs=1e-3)


def test_a_restitution_out_of_reach_is_told_with_what_can_be_had():
    found = calibrate(BODY, LAW, 0.90, step=STEP, impacts=2, fractions=(0.4,))
    assert found.restitution > 0.90
    assert "0.9000 was asked for" in found.reason


def test_a_step_that_no_fraction_allows_is_refused():
    with pytest.raises(ValueError, match=r"step is 0\.001 s; at most .* s was expected"):
        calibrate(BODY, LAW, 0.976, step=1e-3, fractions=(0.1,))


@pytest.mark.parametrize("restitution", [1.0, 0.0])
def test_a_restitution_out_of_range_is_refused(restitution):
    with pytest.raises(ValueError, match=r"a number between 0 and 1 was expected"):
        calibrate(BODY, LAW, restitution, step=STEP)
