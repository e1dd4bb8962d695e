import numpy as np
import pytest

from colonnade.signals.alignment import find_offset, link, with_drift
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.signals.quality import Flag
from colonnade.signals.record import even_record

INTERVAL = 0.0025
TIME = np.arange(0, 10, INTERVAL)


ACCELERATIONS = ("acceleration", "acceleration")


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


def _record(time, values):
    return even_record(time, values, np.full(time.size, Flag.GOOD, dtype=np.int8))


def _linked(delay, *, sign=1.0, longest=1.0, frequency=None):
    """A motion as two recorders have it, the second late and perhaps with the other sign."""
    motion, rng = _ramped(frequency) if frequency else _shaken, np.random.default_rng(1)
    records = [
        _record(time, factor * motion(time - late) + rng.normal(0, 0.01, time.size))
        for time, late, factor in ((np.arange(0, 12, 1 / 500), 0.0, 1.0), (np.arange(0, 12, 1 / 400), delay, sign))
    ]
    return link(*records, quantities=ACCELERATIONS, longest=longest, sign=1.0)


def _ramped(frequency):
    return lambda time: 2 * np.sin(2 * np.pi * frequency * time) * np.clip(np.minimum(time - 1, 9 - time), 0, 1)


SHAKEN = np.gradient(np.gradient(_earthquake(0.0), INTERVAL), INTERVAL)


def _shaken(time):
    return 0.3 + np.interp(time, TIME, SHAKEN)


@pytest.mark.parametrize("delay", [1.3, -1.2])
def test_a_delay_beyond_what_is_looked_for_is_said(delay):
    found = _linked(delay)
    assert found.beyond == pytest.approx(delay, abs=5e-3)
    assert f"agree better at {1e3 * found.beyond:.4g} ms, beyond the range searched" in found.doubt
    assert "processing.longest_offset" in found.doubt
    assert _linked(delay, longest=2.0).doubt == ""


@pytest.mark.parametrize("frequency", [None, 1.0, 3.0, 7.0], ids=["earthquake", "1", "3", "7 Hz"])
def test_a_wrong_sign_is_told_from_half_a_period(frequency):
    found = _linked(0.02, sign=-1.0, frequency=frequency)
    assert found.opposed
    assert "only with the sign of one reversed" in found.doubt
    assert abs(found.seconds - 0.02) < 1e-3
    assert not _linked(0.02, frequency=frequency).opposed


LATE = 0.02


def _motion(time):
    """Twenty seconds of shaking between rests."""
    rng = np.random.default_rng(4)
    total = np.zeros_like(time)
    for frequency in rng.uniform(0.5, 9.0, 30):
        total += np.sin(2 * np.pi * frequency * time + rng.uniform(0, 6))
    return 0.5 * total * np.clip(np.minimum(time - 2, 22 - time) / 2, 0, 1)


def _linked_rate(ppm, *, seed, noise=0.02):
    """Two recorders, the second late and of a clock that runs fast by `ppm`."""
    rng = np.random.default_rng(seed)
    first, own = np.arange(0, 25, 1 / 500), np.arange(0, 24.9, 1 / 400)
    records = [
        _record(time, _motion(true) + rng.normal(0, noise, time.size))
        for time, true in ((first, first), (own, own / (1 + 1e-6 * ppm) + LATE))
    ]
    return link(*records, quantities=ACCELERATIONS, longest=1.0, sign=1.0)


@pytest.mark.parametrize("ppm", [50.0, -300.0, 1500.0])
def test_a_clock_that_runs_fast_or_slow_is_found_and_stays_aligned_to_a_millisecond(ppm):
    found = _linked_rate(ppm, seed=0)
    assert found.drift is not None
    assert abs(1e6 * found.drift.rate - ppm) < max(4e6 * found.drift.standard_error, 0.01 * abs(ppm))
    time = np.linspace(2, 22, 50)
    true = (time - LATE) * (1 + 1e-6 * ppm) - time
    assert np.abs(found.at(time) - true).max() < 1e-3
    assert f"ppm {'fast' if ppm > 0 else 'slow'}" in str(found.drift)


def test_equal_clocks_have_no_rate_and_the_error_of_one_is_its_scatter():
    rates, errors = [], []
    for seed in range(25):
        assert _linked_rate(0.0, seed=seed, noise=0.2).drift is None
        rng = np.random.default_rng(seed)
        time = np.arange(0, 25, 1 / 400)
        first = lowpass(_motion(time) + rng.normal(0, 0.2, time.size), 1 / 400, 10.0)
        second = lowpass(_motion(time / (1 + 3e-4)) + rng.normal(0, 0.2, time.size), 1 / 400, 10.0)
        offset = find_offset(first, second, 1 / 400, longest=1.0, bandwidth_hz=10.0)
        drift = with_drift(offset, time, first, second, bandwidth_hz=10.0).drift
        rates.append(drift.rate)
        errors.append(drift.standard_error)
    assert np.std(rates) == pytest.approx(np.mean(errors), rel=0.6)
    assert np.mean(rates) == pytest.approx(3e-4, rel=0.05)
