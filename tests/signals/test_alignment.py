import numpy as np
import pytest

from colonnade.signals.alignment import find_offset
from colonnade.signals.filters import lowpass, second_derivative

INTERVAL = 0.0025
TIME = np.arange(0, 10, INTERVAL)


def _sine(frequency):
    ramp = np.clip(np.minimum(TIME - 1, 9 - TIME), 0, 1)
    return lambda delay: (
        np.interp(TIME - delay, TIME, ramp)
        * np.sin(2 * np.pi * frequency * (TIME - delay))
        * 0.5
        / (2 * np.pi * frequency) ** 2
    )


def _earthquake(delay):
    rng = np.random.default_rng(3)
    total = np.zeros(TIME.size)
    for frequency in rng.uniform(0.5, 12, 40):
        phase, start = rng.uniform(0, 6), rng.uniform(1, 5)
        shifted = TIME - delay
        envelope = np.where(shifted > start, (shifted - start) * np.exp(-(shifted - start)), 0)
        total += envelope * np.sin(2 * np.pi * frequency * shifted + phase) / (2 * np.pi * frequency) ** 2
    return total


@pytest.mark.parametrize(
    "motion", [_earthquake, _sine(1.0), _sine(3.0), _sine(7.0)], ids=["earthquake", "1", "3", "7 Hz"]
)
@pytest.mark.parametrize("delay", [0.02, -0.137])
def test_a_displacement_and_an_acceleration_are_aligned_to_a_millisecond(motion, delay):
    rng = np.random.default_rng(0)
    displacement = motion(0.0) + rng.normal(0, 5e-5, TIME.size)
    exact = np.gradient(np.gradient(motion(delay), INTERVAL), INTERVAL)
    acceleration = exact + rng.normal(0, 2e-2, TIME.size)
    pair = second_derivative(displacement, INTERVAL, 10.0), lowpass(acceleration, INTERVAL, 10.0)
    offset = find_offset(*pair, INTERVAL, longest=1.0, bandwidth_hz=10.0)
    assert offset.is_determined
    assert abs(offset.seconds - delay) < 1e-3
    assert offset.standard_error < 1e-3


def test_the_stated_error_is_the_scatter_of_the_offset():
    found = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        noisy = [lowpass(_earthquake(0.02 * k) + rng.normal(0, 2e-3, TIME.size), INTERVAL, 10.0) for k in (0, 1)]
        found.append(find_offset(*noisy, INTERVAL, longest=0.5, bandwidth_hz=10.0))
    scatter = np.std([offset.seconds for offset in found])
    assert np.mean([offset.standard_error for offset in found]) == pytest.approx(scatter, rel=0.6)


def test_records_without_a_common_motion_are_not_aligned():
    rng = np.random.default_rng(0)
    noise = [lowpass(rng.normal(size=TIME.size), INTERVAL, 10.0) for _ in range(2)]
    assert not find_offset(*noise, INTERVAL, longest=1.0, bandwidth_hz=10.0).is_determined
    assert not find_offset(np.zeros(50), np.zeros(50), INTERVAL, longest=1.0, bandwidth_hz=10.0).is_determined
