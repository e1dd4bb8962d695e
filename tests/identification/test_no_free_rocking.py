"""What is no free rocking of this block yields no restitution, but a reason."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import butter, chirp, sosfiltfilt

from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.laboratory.truth import simulate
from every import every
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
RATE, DURATION = 500.0, 14.0
TIME = np.arange(0.0, DURATION, 1 / RATE)
NOISE = 1e-3 * ALPHA


def refused(angle, time=TIME, block=PRISM):
    result = identify_restitution(time, angle, block)
    assert result.value is None, f"e = {result.value} by {result.recommended or result.method}"
    assert result.low is None
    assert result.high is None
    assert result.reason


def white(seed, size=TIME.size, deviation=NOISE):
    return np.random.default_rng(seed).normal(0.0, deviation, size)


def coloured(seed, exponent, size=TIME.size):
    """Noise whose power falls with this exponent of the frequency, of unit standard deviation."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).normal(size=size))
    spectrum[1:] /= np.fft.rfftfreq(size)[1:] ** (exponent / 2)
    spectrum[0] = 0.0
    noise = np.fft.irfft(spectrum, size)
    return noise / noise.std()


def band(seed, low, high, size=TIME.size):
    """White noise between two frequencies, Hz, of unit standard deviation."""
    sections = butter(4, (low, high), btype="bandpass", fs=RATE, output="sos")
    noise = sosfiltfilt(sections, np.random.default_rng(seed).normal(size=size))
    return noise / noise.std()


def decay(restitution=0.95, released=0.6, block=PRISM, duration=DURATION):
    history = rock(block, restitution=restitution, theta0=released * block.critical_angle, duration=duration)
    return np.interp(TIME, history.time, history.angle)


SEEDS = range(3)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("size", [0.003, 0.1, 0.4], ids=lambda size: f"{size:g} α")
@pytest.mark.parametrize(
    "noise",
    [
        pytest.param(lambda seed: np.random.default_rng(seed).normal(size=TIME.size), id="white noise"),
        pytest.param(lambda seed: coloured(seed, 1.0), id="pink noise"),
        pytest.param(lambda seed: coloured(seed, 2.0), id="red noise"),
        pytest.param(lambda seed: band(seed, 0.5, 5.0), id="noise about the rocking frequencies"),
        pytest.param(lambda seed: band(seed, 1.5, 2.5), id="noise in a narrow band"),
    ],
)
def test_noise(noise, size, seed):
    refused(size * ALPHA * noise(seed))


@pytest.mark.parametrize("seed", SEEDS)
def test_noise_that_dies_away(seed):
    refused(0.5 * ALPHA * band(seed, 0.5, 5.0) * np.exp(-TIME / 3) / 3 + white(seed))


@pytest.mark.parametrize(
    "angle",
    [
        pytest.param(np.zeros_like(TIME), id="zero"),
        pytest.param(np.full_like(TIME, 0.3 * ALPHA), id="a constant"),
        pytest.param(np.full_like(TIME, np.nan), id="missing samples alone"),
        pytest.param(np.where(np.arange(TIME.size) == 100, 0.1, np.nan), id="one sample"),
        pytest.param(np.where(TIME < 3, 0.5 * ALPHA, 0.0), id="a step"),
        pytest.param(np.where((TIME > 3) & (TIME < 4), 0.5 * ALPHA, 0.0), id="a pulse"),
        pytest.param(0.5 * ALPHA * np.sign(np.sin(2 * np.pi * 1.5 * TIME)), id="a square wave"),
        pytest.param(0.8 * ALPHA * TIME / DURATION, id="a drifting ramp"),
        pytest.param(0.8 * ALPHA * (TIME / DURATION - 0.5), id="a ramp through zero"),
        pytest.param(ALPHA * np.exp(-TIME / 2), id="creeping to rest"),
        pytest.param(np.where(TIME < 0.3, decay(released=0.5), np.nan), id="a release, cut off in its fall"),
        pytest.param(np.where(TIME < 0.9, decay(0.05, 0.7), 0.0), id="one fall"),
        pytest.param(decay(0.97)[::-1], id="growing motion"),
        pytest.param(np.full_like(TIME, np.inf), id="infinite"),
        pytest.param(1.2 * ALPHA * np.cosh(TIME / 5), id="overturning"),
    ],
)
@pytest.mark.parametrize("noise", [0.0, NOISE], ids=["clean", "noisy"])
def test_what_has_no_row_of_falling_peaks(angle, noise):
    refused(angle + white(3, deviation=noise))


@pytest.mark.parametrize("size", [0, 1, 7])
def test_records_of_hardly_a_sample(size):
    refused(np.zeros(size), np.arange(size) / RATE)


@pytest.mark.parametrize("noise", [0.0, NOISE], ids=["clean", "noisy"])
@pytest.mark.parametrize("hertz", [0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0])
@pytest.mark.parametrize("size", [0.05, 0.3, 0.8], ids=lambda size: f"{size:g} α")
def test_a_sine_test(hertz, size, noise):
    refused(size * ALPHA * np.sin(2 * np.pi * hertz * TIME) + white(5, deviation=noise))


@pytest.mark.parametrize("noise", [0.0, NOISE], ids=["clean", "noisy"])
@pytest.mark.parametrize(("first", "last"), [(0.5, 5.0), (5.0, 0.5), (1.0, 3.0), (1.0, 20.0)])
def test_a_chirp(first, last, noise):
    refused(0.4 * ALPHA * chirp(TIME, first, DURATION, last) + white(6, deviation=noise))


def test_a_chirp_whose_amplitude_falls_but_not_as_rocking_would():
    refused(0.6 * ALPHA * np.exp(-TIME / 8) * chirp(TIME, 1.0, DURATION, 6.0, method="logarithmic") + white(7))


@settings(deadline=None, max_examples=30, derandomize=True)
@given(
    damping=st.floats(0.001, 0.15),
    frequency=st.floats(0.4, 6.0),
    size=st.floats(0.1, 0.9),
    phase=st.floats(0.0, 2 * np.pi),
    noise=st.sampled_from([0.0, 0.1, 1.0]),
)
def test_a_viscously_damped_linear_oscillation_however_damped_and_near_p(damping, frequency, size, phase, noise):
    angle = size * ALPHA * np.exp(-damping * frequency * P * TIME) * np.cos(frequency * P * TIME + phase)
    refused(angle + white(8, deviation=noise * NOISE))


@every("noise", [0.0, 0.1 * NOISE, NOISE])
@every("damping", [0.002, 0.005, 0.01, 0.02, 0.05])
@every("matched", [0.1, 0.2, 0.3, 0.4])
def test_a_damped_oscillation_with_the_period_that_rocking_has_at_some_amplitude(matched, damping, noise):
    frequency = 2 * np.pi * P / (4 * np.arccosh(1 / (1 - matched)))
    angle = 0.5 * ALPHA * np.exp(-damping * frequency * TIME) * np.cos(frequency * TIME)
    refused(angle + white(9, deviation=noise))


@pytest.mark.parametrize("noise", [0.0, NOISE], ids=["clean", "noisy"])
@pytest.mark.parametrize("factor", [0.6, 1 / 1.4, 1.4])
@pytest.mark.parametrize("restitution", [0.85, 0.95, 0.98])
def test_free_rocking_of_another_block(factor, restitution, noise):
    other = PRISM.override(inertia=PRISM.inertia / factor**2)
    assert other.p == pytest.approx(factor * P)
    refused(decay(restitution, block=other) + white(10, deviation=noise))


@pytest.mark.parametrize("factor", [0.6, 1.6])
def test_free_rocking_of_a_block_with_another_critical_angle(factor):
    other = PRISM.override(critical_angle=factor * ALPHA)
    refused(decay(0.95, released=0.5 if factor < 1 else 0.9, block=other) + white(11))


def test_the_same_record_as_it_should_be_does_yield_a_number():
    angle = simulate(PRISM, TIME, restitution=0.95, theta0=0.6 * ALPHA).angle
    result = identify_restitution(TIME, angle + white(12), PRISM)
    assert result.value == pytest.approx(0.95, abs=1e-3)
    assert result.low <= 0.95 <= result.high
