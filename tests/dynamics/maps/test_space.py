"""Sines for the contact model: sampled, with their ramps."""

import numpy as np
import pytest

from colonnade.dynamics.maps.space import SAMPLES_A_CYCLE, sampled
from colonnade.dynamics.plane.harmonic.motion import Harmonic


@pytest.mark.parametrize("ramp_shape", ["linear", "cosine"])
def test_the_samples_are_those_of_the_sine(ramp_shape):
    harmonic = Harmonic.cycles(10.0, 3.0, phase=0.4, ramp=1.0, ramp_shape=ramp_shape)
    wave, dt = sampled(harmonic)
    period = 2 * np.pi / 10.0
    assert dt == pytest.approx(period / SAMPLES_A_CYCLE)
    time = dt * np.arange(wave.size - 1)
    full = (time >= period) & (time <= 4 * period)
    np.testing.assert_allclose(wave[:-1][full], np.sin(10.0 * time[full] + 0.4), atol=1e-9)
    half = round(0.5 * period / dt)
    assert wave[half] == pytest.approx(0.5 * np.sin(10.0 * 0.5 * period + 0.4))
    assert wave[0] == wave[-1] == 0.0
    assert time[-1] == pytest.approx(5 * period)


def test_a_sine_without_a_ramp_begins_at_once():
    wave, _ = sampled(Harmonic.cycles(10.0, 2.0, phase=np.pi / 2))
    assert wave[0] == 1.0
