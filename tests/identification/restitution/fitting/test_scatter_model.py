"""Products of a linear model with noise of each spectrum, against those frequency by frequency."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.noise import passed_power
from colonnade.identification.restitution.fitting.scatter_likelihood import reduced, solve
from colonnade.identification.restitution.fitting.scatter_model import PASSED, LinearModel, SpectralModel

COUNT, IMPACTS, INTERVAL = 400, 8, 0.01
TIME = np.arange(COUNT) / COUNT
STEPS = (TIME[:, None] > (1 + np.arange(IMPACTS)) / (IMPACTS + 1)).astype(float)
FIXED = np.column_stack((STEPS.sum(axis=1), np.ones(COUNT)))


def model(*, interval=INTERVAL, cutoff=None):
    random = np.random.default_rng(4)
    values = 1e-3 * (FIXED[:, 0] + STEPS @ random.normal(size=IMPACTS)) + 3e-4 + random.normal(0.0, 1e-4, COUNT)
    return LinearModel(values, FIXED, STEPS, COUNT, 1e-16, interval, cutoff)


def by_frequencies(linear, first, second, knee):
    """Sum of products of transforms, shape (f,), weighted by the noise's power at each frequency."""
    size = 2 * COUNT
    frequency = np.fft.rfftfreq(size, INTERVAL)
    power = np.ones(frequency.size)
    if linear.cutoff_hz is not None:
        power = passed_power(frequency, linear.cutoff_hz, INTERVAL)
    kept, twice = power > PASSED, np.full(frequency.size, 2.0)
    twice[[0, -1]] = 1.0
    weight = kept * twice / size / (1 + knee / np.maximum(frequency, 0.5 / (COUNT * INTERVAL)))
    one, other = (np.fft.rfft(each, size, axis=0) / (np.sqrt(power) if of else 1.0) for each, of in (first, second))
    return float((weight * (one.conj() * other).real)[kept].sum())


@pytest.mark.parametrize("cutoff", [None, 20.0], ids=["unfiltered", "through a low-pass"])
def test_products_are_those_over_all_frequencies(cutoff):
    """Bands of 2 % of the frequency in which the noise is even leave less than a thousandth."""
    linear = model(cutoff=cutoff)
    transformed = SpectralModel(linear)
    values, mean = (linear.values, cutoff is not None), (FIXED[:, 0], False)
    for products in transformed.all_products():
        expected = by_frequencies(linear, values, mean, products.knee)
        assert products.outer[0, 1] * products.lengths[0] == pytest.approx(expected, rel=1e-3)
        assert products.inner[2, 5] == pytest.approx(
            by_frequencies(linear, (STEPS[:, 2], False), (STEPS[:, 5], False), products.knee), rel=1e-3
        )
        own, others = transformed.products_with(STEPS[:, [2]], products.knee)
        assert own[0, 0] == pytest.approx(products.inner[2, 2], rel=1e-9)
        np.testing.assert_allclose(others[0, 3:], products.inner[2], rtol=1e-9)


def test_the_volume_is_that_of_the_noises_covariance():
    """ln det of a stationary covariance: the sum of ln of the power at its frequencies."""
    for products in SpectralModel(model()).all_products():
        frequency = np.maximum(np.abs(np.fft.fftfreq(2 * COUNT, INTERVAL)), 0.5 / (COUNT * INTERVAL))
        expected = 0.5 * np.log(1 + products.knee / frequency).sum()
        assert products.volume == pytest.approx(expected, rel=1e-3)


def test_white_noise_in_frequencies_is_that_in_time():
    linear = model(interval=None)
    plain, _ = solve(reduced(SpectralModel(linear).all_products()))
    spectral, _ = solve(reduced([SpectralModel(replace(linear, interval=0.01)).white()]))
    np.testing.assert_allclose(spectral.centre, plain.centre, rtol=2e-5)
    np.testing.assert_allclose(spectral.error, plain.error, rtol=0.02)
