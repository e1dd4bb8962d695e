"""How well two records agree; spectra of white noise and of a sine, whose values are known; the hum of the mains."""

import numpy as np
import pytest

from colonnade.signals.metrics import CLASSES, density, find_hum, nrmse


def test_nrmse_is_the_root_mean_square_over_the_scale():
    assert nrmse([0.0, 0.0], [0.3, -0.3], 0.1) == pytest.approx(3.0)


def test_samples_missing_in_either_do_not_count():
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


INTERVAL = 1 / 400
TIME = np.arange(0, 8, INTERVAL)
HISS = np.random.default_rng(0).normal(0, 0.02, TIME.size)
MOVES = np.clip(np.minimum(TIME - 2, 6 - TIME), 0, 1)


@pytest.mark.parametrize("frequency", [50.0, 60.0, 49.9])
@pytest.mark.parametrize("amplitude", [0.1, 2.0])
def test_a_hum_is_found_with_its_amplitude(frequency, amplitude):
    motion = 3.0 * MOVES * np.sin(2 * np.pi * 4.3 * TIME)
    found = find_hum(motion + HISS + amplitude * np.sin(2 * np.pi * frequency * TIME + 0.7), INTERVAL)
    assert found == (pytest.approx(frequency, abs=0.2), pytest.approx(amplitude, rel=0.15))


@pytest.mark.parametrize(
    "values",
    [
        HISS,
        np.zeros_like(TIME),
        MOVES * np.sin(2 * np.pi * 50.0 * TIME) + HISS,
        np.sin(2 * np.pi * 52.5 * TIME),
    ],
    ids=["noise", "dead", "a table that moves at 50 Hz and rests", "another frequency"],
)
def test_what_pauses_or_has_another_frequency_is_none(values):
    assert find_hum(values, INTERVAL) is None


def test_a_slow_or_short_record_shows_none():
    assert find_hum(np.sin(2 * np.pi * 50.0 * TIME)[:100], INTERVAL) is None
    assert find_hum(np.ones(400), 0.01) is None


def test_a_few_samples_have_no_spectrum():
    assert density(NOISE[:50], 1 / RATE, ALL[:50]) is None
