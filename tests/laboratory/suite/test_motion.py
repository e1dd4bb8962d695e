"""One synthetic ground motion: intensity, durations, frequencies, and rest in the end."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from colonnade.assessment.intensity.measured import intensity_measures
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.suite.motion import broad_band, pulse
from colonnade.laboratory.suite.parameters import Shaking

SHAKING = Shaking(arias=0.8, duration=9.0, middle=5.0, frequency=4.0, slope=-0.2, damping=0.2)
STEP = 0.02
SEEDS = range(12)


@pytest.fixture(scope="module")
def made():
    return [broad_band(SHAKING, STEP, np.random.default_rng(seed)) for seed in SEEDS]


def test_it_has_its_arias_intensity_and_in_the_mean_its_duration(made):
    found = [intensity_measures(Motion(each, STEP), measures=["arias", "d5_95"]).values for each in made]
    assert [each["arias"] for each in found] == pytest.approx([0.8] * len(made), rel=1e-9)
    assert np.mean([each["d5_95"] for each in found]) == pytest.approx(9.0, rel=0.1)


def test_half_its_energy_comes_when_it_should(made):
    middles = []
    for each in made:
        energy = np.cumsum(each**2)
        middles.append(STEP * np.searchsorted(energy, 0.45 * energy[-1]))
    assert np.mean(middles) == pytest.approx(5.0, rel=0.1)


def test_its_frequency_falls_with_time(made):
    def rate(part):
        return np.mean([np.sum(each[part][1:] * each[part][:-1] < 0) / 2 / (STEP * each[part].size) for each in made])

    early, late = rate(slice(round(1.5 / STEP), round(4.5 / STEP))), rate(slice(round(8 / STEP), round(12 / STEP)))
    # The filter is at 4.4 Hz in the middle of the first part, and at 3 Hz in that of the second.
    assert early == pytest.approx(4.4, rel=0.2)
    assert late == pytest.approx(3.0, rel=0.2)


def test_it_comes_to_rest(made):
    assert max(intensity_measures(Motion(each, STEP), measures=["pgv"]).drift for each in made) < 0.01


def test_a_pulse_has_its_velocity():
    time = np.arange(0, 12, 0.002)
    velocity = scipy.integrate.cumulative_trapezoid(pulse(0.7, 2.5, 2.0, 0.0, 6.0, time), time, initial=0.0)
    assert velocity.max() == pytest.approx(0.7, rel=1e-4)
    assert time[velocity.argmax()] == pytest.approx(6.0, abs=0.01)
    assert abs(velocity[-1]) < 1e-4
