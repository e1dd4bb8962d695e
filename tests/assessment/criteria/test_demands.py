"""The level of the undamped velocity spectrum."""

import numpy as np
import pytest

from colonnade.assessment.criteria.demands import PERIODS, spectral_velocity


def test_after_a_short_impulse_every_undamped_oscillator_has_its_velocity():
    acceleration = np.zeros(4000)
    acceleration[1] = 500.0
    assert spectral_velocity(acceleration, 0.001) == pytest.approx(0.5, rel=1e-3)
    assert PERIODS[-1] < 0.001 * acceleration.size


def test_it_is_proportional_to_the_motion():
    motion = np.random.default_rng(1).normal(0, 1, 1000)
    assert spectral_velocity(3 * motion, 0.01) == pytest.approx(3 * spectral_velocity(motion, 0.01))
