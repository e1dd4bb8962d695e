"""Level and cut-off of noise from its spectrum, and what follows for sums with it."""

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.noise import fit_noise, weighted_products
from colonnade.signals.filters import lowpass

INTERVAL = 0.002


def noise(seed, cutoff, count=3000):
    white = np.random.default_rng(seed).normal(0, 1.0, count + 1000)
    return (white if cutoff is None else lowpass(white, INTERVAL, cutoff))[500:-500]


@pytest.mark.parametrize("cutoff", [None, 30.0, 60.0, 150.0], ids=lambda value: f"{value}")
def test_the_cutoff_and_the_level_before_it_are_found(cutoff):
    found = [fit_noise(noise(seed, cutoff), INTERVAL) for seed in range(12)]
    assert np.median([each.level for each in found]) == pytest.approx(1.0, rel=0.1)
    if cutoff is None:
        assert all(each.cutoff_hz is None for each in found)
    else:
        assert np.median([each.cutoff_hz for each in found]) == pytest.approx(cutoff, rel=0.05)


def test_lines_of_a_wrong_model_do_not_count_as_noise():
    seen = noise(1, None) + 3 * np.sin(2 * np.pi * 7.0 * INTERVAL * np.arange(3000))
    assert fit_noise(seen, INTERVAL).level == pytest.approx(1.0, rel=0.1)


def test_missing_samples_do_not_change_the_level():
    seen = noise(2, None)
    seen[1000:1400] = np.nan
    assert fit_noise(seen, INTERVAL).level == pytest.approx(1.0, rel=0.1)


@pytest.mark.parametrize("cutoff", [None, 60.0])
def test_sums_scatter_as_the_products_say(cutoff):
    square = np.sign(np.sin(2 * np.pi * 3.0 * INTERVAL * np.arange(3000) + 0.3))
    sums = [square @ noise(seed, cutoff) for seed in range(300)]
    expected = np.median([weighted_products(square[:, None], fit_noise(noise(s, cutoff), INTERVAL)) for s in range(8)])
    assert np.var(sums) == pytest.approx(float(expected), rel=0.25)


def test_nothing_counted_is_no_noise():
    assert fit_noise(np.full(100, np.nan), INTERVAL).level == 0.0
