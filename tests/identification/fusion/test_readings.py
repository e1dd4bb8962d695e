"""Noise of a reading were it white: the low-pass has taken off all above its cut-off."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.fusion.readings import Readings
from colonnade.signals.filters import lowpass


@pytest.mark.parametrize(("cutoff", "factor"), [(250.0, 1.0), (np.inf, 1.0), (62.5, 2.0), (10.0, 5.0)])
def test_white_noise_is_larger_by_the_root_of_the_band_that_is_left(cutoff, factor):
    readings = Readings(np.zeros((1, 4)), np.array([0.3]), np.array([cutoff]))
    assert readings.white(1 / 500)[0] == pytest.approx(0.3 * factor)


def test_it_is_the_noise_before_a_real_low_pass():
    noise = np.random.default_rng(4).standard_normal(100_000)
    left = lowpass(noise, 1 / 500, 25.0)
    readings = Readings(left[None], np.array([left.std()]), np.array([25.0]))
    assert readings.white(1 / 500)[0] == pytest.approx(1.0, rel=0.1)
