"""A table that moves during a free vibration: its recorded acceleration drives the identification."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.response.base_motion import table_moves
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion, DrivenDecay
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, Decay
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.laboratory.integration import Integration
from prism import PRISM

ALPHA = PRISM.critical_angle
STEP = 0.002
TIME = np.arange(0.0, 7.0, STEP)
E = 0.93
VALUES = {"restitution": np.log(E), "peak": 0.5 * ALPHA, "time": 0.3, "zero_offset": 1e-3 * ALPHA}
DECAY = Decay(VALUES | {"critical_angle": 0.0, "p": 0.0}, 1, 12, PRISM, linearised=False)


def shaken(amplitude, frequency, phase=0.0, restitution=E):
    """Base acceleration, m/s², and the angle by the laboratory's own adaptive integration of it."""

    def acceleration(instant):
        return amplitude * PRISM.gravity * ALPHA * np.sin(2 * np.pi * frequency * instant + phase)

    run = Integration(PRISM, TIME, restitution, np.pi / 2, 0.6 * ALPHA)
    run.move_to(0.5)
    run.release(0.6 * ALPHA, 0.0)
    run.go(0.5, float(TIME[-1]), acceleration)
    return acceleration(TIME), run.angles


def test_on_a_table_at_rest_it_is_free_rocking():
    driven = DrivenDecay.of(DECAY, BaseMotion(np.zeros(50), 0.0, 0.1))
    time = np.linspace(0.1, 0.999 * DECAY.arcs()[2][-1], 2000)
    np.testing.assert_allclose(driven.followed(time)[0], DECAY.followed(time)[0], rtol=0, atol=1e-7 * ALPHA)
    for ours, theirs in zip(driven.jacobian(time, ALWAYS), DECAY.jacobian(time, ALWAYS), strict=True):
        # One sample may lie within the difference about a corner.
        assert np.quantile(np.abs(ours - theirs), 0.999) < 1e-4 * np.abs(theirs).max()


def test_a_moving_table_is_followed_as_another_integrator_does():
    _, angle = shaken(0.05, 1.3)
    # Linear between samples: with steps this fine it is a sine.
    fine = 0.05 * ALPHA * np.sin(2 * np.pi * 1.3 * np.arange(0.0, 7.0, STEP / 10))
    start = Decay(DECAY.values | {"peak": 0.6 * ALPHA, "time": 0.5, "zero_offset": 0.0}, 1, 12, PRISM, False)
    driven = DrivenDecay.of(start, BaseMotion(fine, 0.0, STEP / 10))
    last = driven.arcs()[2][-1]
    inside = (TIME >= 0.5) & (last > TIME)
    np.testing.assert_allclose(driven.followed(TIME[inside])[0], angle[inside], rtol=0, atol=1e-5 * ALPHA)


@pytest.mark.parametrize(("frequency", "phase"), [(1.3, 1.0), (3.0, 2.0)])
def test_its_recorded_acceleration_drives_the_identification(frequency, phase):
    acceleration, angle = shaken(0.05, frequency, phase)
    random = np.random.default_rng(4)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    recorded = acceleration + random.normal(0.0, 0.005, TIME.size)
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=recorded)
    assert result.low <= E <= result.high
    assert result.high - result.low < 2e-3
    assert result.recommended == "history-scatter"
    blind = identify_restitution(TIME, angle, PRISM)
    assert blind.value is None
    assert "the table moves" in blind.reason
    assert "moving table" in {each.name for each in blind.departures}


def test_a_table_at_rest_with_a_noisy_accelerometer_changes_nothing():
    _, angle = shaken(0.0, 1.0)
    random = np.random.default_rng(5)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    recorded = random.normal(0.0, 0.02, TIME.size)
    assert identify_restitution(TIME, angle, PRISM, base_acceleration=recorded).value == pytest.approx(
        identify_restitution(TIME, angle, PRISM).value, abs=1e-12
    )


def test_a_moving_table_with_samples_missing_is_refused_with_the_reason():
    acceleration, angle = shaken(0.05, 1.3)
    acceleration[100:120] = np.nan
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=acceleration)
    assert result.value is None
    assert "missing 20 of 3500 samples" in result.reason


@pytest.mark.parametrize("e", [0.90, 0.95])
@pytest.mark.parametrize("noise", [0.06, 0.2])
def test_noise_of_an_accelerometer_moves_no_table(e, noise):
    _, angle = shaken(0.0, 1.0, restitution=e)
    random = np.random.default_rng(6)
    angle = angle + random.normal(0.0, 1e-4 * ALPHA, TIME.size)
    recorded = random.normal(0.0, noise, TIME.size) + noise * np.sin(2 * np.pi * 50.0 * TIME)
    recorded += 0.2 * noise * np.cumsum(random.normal(0.0, STEP**0.5, TIME.size))
    assert table_moves(recorded, STEP, PRISM)
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=recorded)
    assert result.low <= e <= result.high
    assert not result.departures


@pytest.mark.parametrize("amplitude", [0.03, 0.05, 0.1])
def test_a_table_that_moves_is_not_taken_for_noise(amplitude):
    acceleration, angle = shaken(amplitude, 1.3, 1.0)
    random = np.random.default_rng(7)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    noisy = acceleration + random.normal(0.0, 0.05, TIME.size)
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=noisy)
    assert result.recommended in ("", "history-scatter")
    assert result.value is None or result.low <= E <= result.high
    for wrong in (-acceleration, random.normal(0.0, 0.2, TIME.size)):
        assert identify_restitution(TIME, angle, PRISM, base_acceleration=wrong).value is None
