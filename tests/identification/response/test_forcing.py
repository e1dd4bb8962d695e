"""What the table did: a ramped sine's frequency and amplitude are those it was made with."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.response.forcing import fit_forcing


def ramped(frequency, amplitude, *, cycles=12, ramp=3.0, interval=0.002, rest=1.5):
    period = 1 / frequency
    length = (cycles + 2 * ramp) * period
    time = np.arange(0.0, length + 2 * rest, interval)
    since = time - rest
    envelope = np.clip(np.minimum(since, length - since) / (ramp * period), 0.0, 1.0)
    return time, amplitude * envelope * np.sin(2 * np.pi * frequency * since), rest + ramp * period


@pytest.mark.parametrize("frequency", [1.0, 1.93, 3.0, 5.04, 7.0])
@pytest.mark.parametrize("noise", [0.0, 0.02], ids=["clean", "noisy"])
def test_frequency_amplitude_and_steady_part_are_found(frequency, noise):
    time, motion, start = ramped(frequency, 2.0)
    found = fit_forcing(time, motion + np.random.default_rng(0).normal(0, noise, time.size))
    assert found.frequency == pytest.approx(frequency, rel=1e-3)
    assert found.amplitude == pytest.approx(2.0, rel=3e-3)
    assert found.start == pytest.approx(start, abs=1 / frequency)
    assert 10.5 < found.cycles < 13.5
    assert found.amplitude_spread < 0.1


def test_an_offset_and_harmonics_do_not_enter_the_amplitude():
    time, motion, _ = ramped(3.0, 2.0)
    found = fit_forcing(time, motion + 0.5 + 0.1 * motion**2)
    assert found.amplitude == pytest.approx(2.0, rel=3e-3)
    assert found.distortion == pytest.approx(0.1, rel=0.05)  # 0.1 · 2² / 2 at twice the frequency, over 2


def test_samples_that_are_missing_at_the_ends_do_no_harm():
    time, motion, _ = ramped(3.0, 2.0)
    motion[:50] = np.nan
    assert fit_forcing(time, motion).amplitude == pytest.approx(2.0, rel=3e-3)


@pytest.mark.parametrize(
    "motion",
    [
        np.zeros(4000),
        np.random.default_rng(1).normal(0, 1, 4000),
        np.sin(np.linspace(0, 60, 4000)) * np.exp(-np.linspace(0, 10, 4000)),
        np.sin(np.linspace(0, 8, 4000)),
    ],
    ids=["rest", "noise", "decay", "one cycle"],
)
def test_what_is_no_steady_sine_gives_nothing(motion):
    assert fit_forcing(np.arange(4000) * 0.002, motion) is None
