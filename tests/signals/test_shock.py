"""A single shock is told from motion."""

import numpy as np
import pytest

from colonnade.signals.shock import single_shock

RATE = 500.0
TIME = np.arange(0.0, 20.0, 1 / RATE)
G = 9.80665


def shaking(seed=0):
    rng = np.random.default_rng(seed)
    noise = np.convolve(rng.normal(size=TIME.size), np.hanning(25), mode="same")
    return 1.2 * G * noise / np.abs(noise).max()


def pulse(at, size, duration):
    inside = (at <= TIME) & (at + duration > TIME)
    return np.where(inside, size * np.sin(np.pi * (TIME - at) / duration), 0.0)


@pytest.mark.parametrize("sign", [1, -1])
def test_ten_milliseconds_of_six_g_in_a_record_of_one_are_found(sign):
    shock = single_shock(shaking() + pulse(12.3, sign * 6 * G, 0.010), 1 / RATE)
    assert shock is not None
    assert shock.time == pytest.approx(12.305, abs=0.004)
    assert shock.peak == pytest.approx(sign * 6 * G, rel=0.2)
    assert shock.elsewhere == pytest.approx(1.2 * G, rel=1e-6)
    assert shock.duration <= 0.012


@pytest.mark.parametrize(
    "values",
    [
        shaking(),
        pulse(5.0, 6 * G, 0.25) + 1e-3 * shaking(),
        shaking() + pulse(12.3, 6 * G, 0.010) + pulse(14.0, 5 * G, 0.010),
        shaking() + pulse(12.3, 2 * G, 0.010),
        np.zeros(TIME.size),
    ],
    ids=["an earthquake", "a pulse of the table", "impact after impact", "hardly larger", "nothing"],
)
def test_motion_and_repeated_impacts_are_no_single_shock(values):
    assert single_shock(values, 1 / RATE) is None


def test_a_shock_at_either_end_and_missing_samples_are_no_trouble():
    values = shaking()
    values[:40] = np.nan
    assert single_shock(values + pulse(TIME[-4], 8 * G, 0.010), 1 / RATE) is not None
