import numpy as np
import pytest

from colonnade.signals.clocks.alignment import link
from colonnade.signals.clocks.rate import find_rate
from colonnade.signals.filters import lowpass
from colonnade.signals.quality import Flag
from colonnade.signals.record import even_record

LATE = 0.02


def _motion(time):
    """Twenty seconds of shaking between rests."""
    rng = np.random.default_rng(4)
    total = np.zeros_like(time)
    for frequency in rng.uniform(0.5, 9.0, 30):
        total += np.sin(2 * np.pi * frequency * time + rng.uniform(0, 6))
    return 0.5 * total * np.clip(np.minimum(time - 2, 22 - time) / 2, 0, 1)


def _record(time, values):
    return even_record(time, values, np.full(time.size, Flag.GOOD, dtype=np.int8))


def _linked(ppm, *, seed, noise=0.02):
    """Two recorders, the second late and of a clock that runs fast by `ppm`."""
    rng = np.random.default_rng(seed)
    first, own = np.arange(0, 25, 1 / 500), np.arange(0, 24.9, 1 / 400)
    records = [
        _record(time, _motion(true) + rng.normal(0, noise, time.size))
        for time, true in ((first, first), (own, own / (1 + 1e-6 * ppm) + LATE))
    ]
    return link(*records, quantities=("acceleration", "acceleration"), longest=1.0, sign=1.0)


@pytest.mark.parametrize("ppm", [50.0, -300.0, 1500.0])
def test_a_clock_that_runs_fast_or_slow_is_found_and_stays_aligned_to_a_millisecond(ppm):
    found = _linked(ppm, seed=0)
    assert found.drift is not None
    assert abs(1e6 * found.drift.rate - ppm) < max(4e6 * found.drift.standard_error, 0.01 * abs(ppm))
    time = np.linspace(2, 22, 50)
    true = (time - LATE) * (1 + 1e-6 * ppm) - time
    assert np.abs(found.at(time) - true).max() < 1e-3
    assert f"ppm {'fast' if ppm > 0 else 'slow'}" in str(found.drift)


def test_equal_clocks_have_no_rate_and_its_error_is_the_scatter():
    rates, errors = [], []
    for seed in range(25):
        assert _linked(0.0, seed=seed, noise=0.2).drift is None
        rng = np.random.default_rng(seed)
        time = np.arange(0, 25, 1 / 400)
        noisy = [lowpass(_motion(time) + rng.normal(0, 0.2, time.size), 1 / 400, 10.0) for _ in range(2)]
        rate = find_rate(time, *noisy, delay=0.0, bandwidth_hz=10.0)
        rates.append(rate.rate)
        errors.append(rate.standard_error)
    assert np.std(rates) == pytest.approx(np.mean(errors), rel=0.6)


def test_records_without_a_common_motion_have_no_rate():
    rng = np.random.default_rng(0)
    time = np.arange(0, 25, 1 / 400)
    noise = [lowpass(rng.normal(size=time.size), 1 / 400, 10.0) for _ in range(2)]
    assert find_rate(time, *noise, delay=0.0, bandwidth_hz=10.0) is None
    assert find_rate(time, np.zeros(time.size), noise[0], delay=0.0, bandwidth_hz=10.0) is None
