"""The order of a response: closed histories, the nonlinear engine's steady states, and Fourier as a second judge."""

from functools import cache

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.response.order import TOLERANCE, response_order
from prism import PRISM

ALPHA = PRISM.critical_angle
INTERVAL = 0.002


@cache
def shaken(frequency, amplitude, restitution=0.976, cycles=20):
    """Times, angle, and the span of steady forcing after a ramp of three cycles; then free rocking."""
    period = 1 / frequency
    time = np.arange(0.0, (cycles + 6) * period + 2.0, INTERVAL)
    envelope = np.clip(np.minimum(time, (cycles + 6) * period - time) / (3 * period), 0.0, 1.0)
    base = amplitude * PRISM.uplift_acceleration * np.sin(np.pi / 2 * envelope) ** 2
    history = rock(
        PRISM,
        Motion(base * np.sin(2 * np.pi * frequency * time), INTERVAL),
        restitution=restitution,
        model="nonlinear",
    )
    assert history.outcome == "rocking"
    return time, history.angle, 3 * period, (cycles + 3) * period


def order_of(history, frequency, noise=0.0, seed=0):
    time, angle, start, stop = history
    seen = angle + np.random.default_rng(seed).normal(0, noise, angle.size) if noise else angle
    threshold = max(1e-3 * ALPHA, 6 * noise)
    return response_order(time, seen, frequency, start=start, stop=stop, threshold=threshold, noise=noise)


def comb_share(history, frequency, order, cycles):
    """Share of the angle's power, over the last whole cycles of steady forcing, in lines at multiples of f / order."""
    time, angle, _, stop = history
    points = np.interp(stop - cycles / frequency * np.arange(cycles * 64, 0, -1) / (cycles * 64), time, angle)
    power = np.abs(np.fft.rfft(points - points.mean())) ** 2
    return power[:: cycles // order].sum() / power.sum()


STEADY = [
    (4.0, 1.4, 0.976, 1),
    (6.0, 2.5, 0.976, 1),
    (5.0, 1.2, 0.88, 1),
    (7.0, 5.0, 0.976, 3),
    (6.0, 4.0, 0.90, 3),
    (9.0, 5.0, 0.90, 3),
]


@pytest.mark.parametrize(("frequency", "amplitude", "restitution", "order"), STEADY)
def test_a_long_test_shows_the_steady_states_order_as_its_spectrum_does(frequency, amplitude, restitution, order):
    history = shaken(frequency, amplitude, restitution, cycles=200)
    found = order_of(history, frequency)
    assert found.order == order
    assert comb_share(history, frequency, order, 60) > 0.99
    if order > 1:
        assert comb_share(history, frequency, 1, 60) < 0.5
        assert found.impacts_per_cycle == pytest.approx(2 / 3, abs=0.2)


def test_a_transient_that_alternates_is_sub_harmonic_where_the_steady_state_is_harmonic():
    short = shaken(4.0, 1.4)
    assert order_of(short, 4.0).order == 2
    assert comb_share(short, 4.0, 2, 12) > 0.9
    assert comb_share(short, 4.0, 1, 12) < 0.75


@pytest.mark.parametrize(
    ("frequency", "amplitude", "cycles"), [(4.0, 1.8, 20), (6.0, 4.0, 200)], ids=["a transient", "no steady state"]
)
def test_what_does_not_repeat_is_irregular_and_its_spectrum_no_comb(frequency, amplitude, cycles):
    history = shaken(frequency, amplitude, cycles=cycles)
    found = order_of(history, frequency)
    assert found.order == "irregular"
    assert found.misfit.min() > TOLERANCE
    assert "transient" in found.reason
    assert max(comb_share(history, frequency, order, 12) for order in (1, 2, 3, 4)) < 0.8


def margin(found):
    """How far the verdict is from another, as a difference of misfit."""
    rivals = found.misfit if found.order == "irregular" else found.misfit[: found.order]
    return np.abs(rivals - TOLERANCE).min()


@pytest.mark.parametrize("seed", range(5))
def test_noise_does_not_change_the_order(seed):
    for frequency in (3.0, 4.0, 5.0, 6.0, 7.0):
        for amplitude in (1.05, 1.15):
            truth = order_of(shaken(frequency, amplitude), frequency)
            seen = order_of(shaken(frequency, amplitude), frequency, noise=1e-3 * ALPHA, seed=seed)
            np.testing.assert_allclose(seen.misfit, truth.misfit, atol=0.01)
            if margin(truth) > 0.01:
                assert seen.order == truth.order


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_a_closed_history_of_known_order_is_found_beside_a_decaying_transient(order):
    time = np.arange(0.0, 20.0, INTERVAL)
    steady = np.sin(2 * np.pi * time) + (1.2 * np.sin(2 * np.pi * time / order + 0.4) if order > 1 else 0.0)
    transient = 0.5 * np.exp(-time / 5) * np.sin(2 * np.pi * 0.37 * time)
    found = response_order(time, 0.02 * (steady + transient), 1.0, start=0.0, stop=20.0, threshold=1e-4)
    assert found.order == order
    assert margin(found) > 0.05


@pytest.mark.parametrize(("cycles", "order"), [(11, "irregular"), (13, 4)])
def test_an_order_needs_three_of_its_repeats(cycles, order):
    time = np.arange(0.0, cycles, INTERVAL)
    angle = 0.02 * (np.sin(2 * np.pi * time) + 2 * np.sin(2 * np.pi * time / 4))
    assert response_order(time, angle, 1.0, start=0.0, stop=cycles, threshold=1e-4).order == order


SINE = np.sin(2 * np.pi * np.arange(0.0, 20.0, INTERVAL))


@pytest.mark.parametrize(
    ("angle", "stop", "words"),
    [
        (0.02 * SINE, 5.0, "steady over 5 periods; at least 6"),
        (1e-5 * SINE, 20.0, "does not rock"),
        (np.where(np.arange(SINE.size) < 3000, 0.02 * SINE, 0.0), 20.0, "does not rock"),
        (np.full(SINE.size, np.nan), 20.0, "No angle was measured"),
    ],
    ids=["too short", "at rest", "came to rest before the end", "nothing measured"],
)
def test_what_cannot_be_told_has_no_order_but_a_reason(angle, stop, words):
    time = np.arange(0.0, 20.0, INTERVAL)
    found = response_order(time, angle, 1.0, start=0.0, stop=stop, threshold=1e-4)
    assert found.order is None
    assert words in found.reason


def test_missing_samples_are_passed_over():
    time, angle, start, stop = shaken(4.0, 1.4)
    holed = np.where(np.random.default_rng(0).random(angle.size) < 0.02, np.nan, angle)
    assert order_of((time, holed, start, stop), 4.0).order == order_of((time, angle, start, stop), 4.0).order
