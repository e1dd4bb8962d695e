"""Corrections of the baseline against motions whose error is known."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.assessment.intensity.baselines import BASELINES, baseline_of, corrected
from colonnade.assessment.intensity.ground import Ground

STEP = 0.01
TIME = np.arange(3001) * STEP
TRUE = 2.0 * np.sin(2 * np.pi * 1.5 * TIME) * np.sin(np.pi * TIME / TIME[-1]) ** 2
ERRORS = {
    "linear": np.full_like(TIME, 0.02),
    "quadratic": 0.02 + 0.003 * TIME,
    "highpass": 0.03 * np.sin(np.pi * TIME / TIME[-1]) ** 2,
}


@pytest.mark.parametrize("name", ERRORS)
def test_a_correction_takes_off_the_error_that_it_is_made_for(name):
    drifting = Ground(TRUE + ERRORS[name], STEP)
    found = corrected(drifting, name)
    assert drifting.drift > 0.3
    assert found.drift < 0.05
    assert np.abs(found.velocity).max() == pytest.approx(np.abs(Ground(TRUE, STEP).velocity).max(), rel=0.05)


@pytest.mark.parametrize("name", ["linear", "quadratic"])
def test_a_fit_leaves_nothing_of_what_it_fits(name):
    assert np.abs(corrected(Ground(ERRORS[name], STEP), name).acceleration).max() < 1e-9


def test_no_correction_changes_nothing():
    assert corrected(Ground(TRUE, STEP), "none").acceleration is TRUE


def test_the_highpass_passes_what_is_faster_than_its_corner():
    rapid = np.sin(2 * np.pi * 2.0 * TIME) * np.hanning(TIME.size)
    passed = corrected(Ground(rapid, STEP), "highpass(0.2 Hz)").acceleration
    assert np.abs(passed - rapid).max() < 2e-3
    slow = np.sin(2 * np.pi * 0.05 * TIME) * np.hanning(TIME.size)
    assert np.abs(corrected(Ground(slow, STEP), "highpass(0.5 Hz)").acceleration).max() < 2e-3


def test_each_correction_says_what_it_does():
    assert "0.05 Hz" in baseline_of("highpass(0.05 Hz)").definition
    assert all(each.definition and (each.source or name == "none") for name, each in BASELINES.items())
