"""Both models on a harmonic motion against the same motion sampled, and what is left out of a run."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import Harmonic, harmonic_outcomes, harmonic_run
from colonnade.dynamics.rock import rock
from prism import PRISM


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_harmonic_run_is_that_of_the_sampled_motion(model):
    motion = Harmonic.cycles(4.0 * PRISM.p, 5.0)
    time = np.linspace(0.0, motion.edges[2], 20_001)
    base = 1.3 * PRISM.uplift_acceleration * np.sin(motion.omega * time)
    sampled = rock(PRISM, Motion(base, time[1]), restitution=0.9, model=model)
    run = harmonic_run(PRISM, motion, 1.3, 0.9, model=model, samples=200, interval=100 * time[1])
    np.testing.assert_allclose(run.angle, sampled.angle[:20_000:100], atol=1e-6 * PRISM.critical_angle)
    np.testing.assert_allclose(run.impact_times, sampled.impact_times[: run.impact_times.size], atol=1e-6)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_outcomes_of_many_amplitudes_are_those_of_single_runs(model):
    motion = Harmonic.cycles(3.0 * PRISM.p, 4.0, ramp=1.0, ramp_shape="cosine")
    amplitudes = np.linspace(0.5, 6.0, 12)
    codes = harmonic_outcomes(PRISM, motion, amplitudes, (0.9, 0.9), model)
    single = [harmonic_run(PRISM, motion, float(a), 0.9, model=model).outcome for a in amplitudes]
    assert [("no-rocking", "rocking", "overturned")[code] for code in codes] == single
