"""The largest velocity pulse: the wavelet's own properties, planted pulses, and noise without one."""

import numpy as np
import pytest

from colonnade.assessment.wavelet import SCALING, _daubechies, largest_pulse

STEP = 0.01
TIME = np.arange(4001) * STEP


def test_the_filter_and_the_wavelet_are_orthonormal_with_four_vanishing_moments():
    filters = np.array(SCALING)
    assert filters.sum() == pytest.approx(np.sqrt(2), abs=1e-12)
    for shift in range(4):
        assert filters[2 * shift :] @ filters[: 8 - 2 * shift] == pytest.approx(float(shift == 0), abs=1e-11)
    time, values = _daubechies()
    step = time[1]
    assert time[-1] == 7.0
    for power in range(4):
        assert (values * time**power).sum() * step == pytest.approx(0.0, abs=1e-10)
    assert (values**2).sum() * step == pytest.approx(1.0, abs=1e-8)
    whole = round(1 / step)
    assert (values[whole:] * values[:-whole]).sum() * step == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("period", [0.6, 1.5, 4.0])
def test_a_planted_wavelet_is_found_whole(period):
    time, values = _daubechies()
    scale = period / 1.4
    planted = 0.7 * np.interp((TIME - 8.0) / scale, time, values, left=0.0, right=0.0)
    found = largest_pulse(planted, STEP)
    assert found.period == pytest.approx(period, rel=0.01)
    assert found.indicator > 0.999999
    assert np.abs(found.velocity - planted).max() < 0.02


@pytest.mark.parametrize("period", [0.8, 3.0])
def test_the_period_of_a_smooth_pulse_is_near_its_own(period):
    phase = 2 * np.pi * (TIME - 15.0) / period
    pulse = np.where(np.abs(phase) < 2 * np.pi, 0.25 * (1 + np.cos(phase / 2)) * np.cos(phase), 0.0)
    found = largest_pulse(pulse, STEP)
    assert found.period == pytest.approx(period, rel=0.2)
    assert found.indicator > 0.85  # pulse-like (Baker 2007)


def test_noise_is_not_pulse_like():
    shaken = np.random.default_rng(5).normal(size=TIME.size) * np.hanning(TIME.size)
    assert largest_pulse(shaken, STEP).indicator < 0.15


@pytest.mark.parametrize("velocity", [np.zeros(500), np.ones(5)], ids=["at rest", "too short"])
def test_no_motion_has_no_pulse(velocity):
    found = largest_pulse(velocity, STEP)
    assert np.isnan(found.period)
    assert np.isnan(found.indicator)
