"""How well two records agree; spectra of white noise and of a sine, whose values are known."""

import numpy as np
import pytest

from colonnade.signals.metrics import CLASSES, density, nrmse


def test_nrmse_is_the_root_mean_square_over_the_scale_of_the_samples_that_both_have():
    assert nrmse([0.0, 0.0], [0.3, -0.3], 0.1) == pytest.approx(3.0)

    assert nrmse([0.0, np.nan, 0.0], [0.3, 9.0, np.nan], 0.1) == pytest.approx(3.0)
    assert np.isnan(nrmse([np.nan], [1.0], 0.1))


RATE = 500.0
NOISE = 0.3 * np.random.default_rng(3).standard_normal(20_000)
ALL = np.ones(NOISE.size, dtype=bool)


def test_white_noise_has_its_standard_deviation_over_the_root_of_half_the_rate():
    found = density(NOISE, 1 / RATE, ALL)
    assert np.median(found.amplitude) == pytest.approx(0.3 / np.sqrt(RATE / 2), rel=0.05)
    assert found.frequency.size <= CLASSES
    assert found.frequency[-1] <= RATE / 2


def test_a_sine_stands_out_at_its_frequency():
    found = density(np.sin(2 * np.pi * 20 * np.arange(NOISE.size) / RATE) + NOISE, 1 / RATE, ALL)
    assert found.frequency[np.argmax(found.amplitude)] == pytest.approx(20, rel=0.03)


def test_bad_samples_are_bridged():
    spoilt, good = NOISE.copy(), ALL.copy()
    spoilt[5000], good[5000] = 1e6, False
    spoilt[7000] = np.nan
    assert np.median(density(spoilt, 1 / RATE, good).amplitude) == pytest.approx(0.3 / np.sqrt(RATE / 2), rel=0.05)


def test_a_few_samples_have_no_spectrum():
    assert density(NOISE[:50], 1 / RATE, ALL[:50]) is None
