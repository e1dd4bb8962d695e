"""Rest is told from motion, and a single shock from impacts and shaking."""

import numpy as np
import pytest

from colonnade.signals.rest import drift, find_rest, single_shock

TIME = np.arange(0, 5, 0.002)
NOISE = np.random.default_rng(0).normal(0, 1e-5, TIME.size)
DECAY = NOISE + np.where(TIME < 4, 0.01 * np.sin(9 * TIME), 0.0)


def test_the_quiet_end_of_a_decay_is_rest():
    window = find_rest(TIME, {"top": (DECAY, 1e-5)}, end=True, duration=0.5)
    assert window.quiet
    assert window.stop == TIME[-1]


def test_a_moving_start_is_not_rest():
    window = find_rest(TIME, {"top": (DECAY, 1e-5), "bottom": (NOISE, 1e-5)}, end=False, duration=0.5)
    assert not window.quiet
    assert window.start == TIME[0]


def test_what_a_transducer_drifts_between_two_rests_is_told():
    values = NOISE + 2e-4 * TIME / TIME[-1] + np.where((TIME > 2) & (TIME < 3), 0.01, 0.0)
    assert abs(drift(TIME, values, duration=0.5, noise=1e-5) - 1.8e-4) < 5e-6
    assert drift(TIME, DECAY, duration=0.5, noise=1e-5) == 0.0


RATE = 500.0
CLOCK = np.arange(0.0, 20.0, 1 / RATE)
G = 9.80665


def shaking(seed=0):
    rng = np.random.default_rng(seed)
    noise = np.convolve(rng.normal(size=CLOCK.size), np.hanning(25), mode="same")
    return 1.2 * G * noise / np.abs(noise).max()


def pulse(at, size, duration):
    inside = (at <= CLOCK) & (at + duration > CLOCK)
    return np.where(inside, size * np.sin(np.pi * (CLOCK - at) / duration), 0.0)


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
        np.zeros(CLOCK.size),
    ],
    ids=["an earthquake", "a pulse of the table", "impact after impact", "hardly larger", "nothing"],
)
def test_motion_and_repeated_impacts_are_no_single_shock(values):
    assert single_shock(values, 1 / RATE) is None


def test_a_shock_at_either_end_and_missing_samples_are_no_trouble():
    values = shaking()
    values[:40] = np.nan
    assert single_shock(values + pulse(CLOCK[-4], 8 * G, 0.010), 1 / RATE) is not None


def test_a_channel_without_values_is_not_at_rest():
    assert not find_rest(TIME, {"top": (np.full(TIME.size, np.nan), 1.0)}, end=True, duration=0.5).quiet
