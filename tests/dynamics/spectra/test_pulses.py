"""Overturning spectra of pulses against closed forms and published numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.spectra.pulses import PULSES, overturning_spectrum

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ALPHA = PRISM.critical_angle


def block_of(radius, angle):
    width, height = 2 * radius * math.sin(angle), 2 * radius * math.cos(angle)
    return Block.prism(width=width, depth=width, height=height, mass=1.0, gravity=9.80665)


def test_half_sine_has_its_closed_form():
    # (ω/p) sin ψ − cos ψ = exp(−(p/ω)(π − ψ)), a/(gα) = 1/sin ψ
    spectrum = overturning_spectrum(PRISM, "half-sine", frequency_ratio=[1, 2, 3, 4])
    expected = [1.322397, 1.800724, 2.293872, 2.790798]
    np.testing.assert_allclose(spectrum.amplitude_ratio * math.tan(ALPHA) / ALPHA, expected, atol=6e-7)


@pytest.mark.parametrize("length", [0.5, 1.0, 2.0])
def test_rectangular_pulse_has_its_closed_form(length):
    spectrum = overturning_spectrum(PRISM, "rectangular", frequency_ratio=[math.pi / length])
    expected = 1 / (1 - math.exp(-length))
    assert spectrum.amplitude_ratio[0] * math.tan(ALPHA) / ALPHA == pytest.approx(expected, abs=2e-8)


@pytest.mark.parametrize(("length", "limit"), [(0.5, 2.54188), (1.0, 1.58219), (2.0, 1.15666)])
def test_nonlinear_rectangular_pulse_has_its_published_level(length, limit):  # Numerics-in-Motion
    block = block_of(1.0, 0.02)
    spectrum = overturning_spectrum(block, "rectangular", frequency_ratio=[math.pi / length], model="nonlinear")
    assert spectrum.amplitude_ratio[0] * math.tan(0.02) / 0.02 == pytest.approx(limit, abs=6e-6)


@pytest.mark.parametrize(
    ("radius", "limit"), [(0.25, 1.2618896), (0.5, 1.4584424), (1.0, 2.1637842), (2.0, 5.1549268), (4.0, math.nan)]
)
def test_nonlinear_sine_pulse_has_its_published_level(radius, limit):  # Numerics-in-Motion/blocks, ± 4.9e-6
    block = block_of(radius, 0.2)
    spectrum = overturning_spectrum(
        block, "sine", frequency_ratio=[4 * math.pi / block.p], model="nonlinear", largest=6.0
    )
    assert spectrum.amplitude_ratio[0] == pytest.approx(limit, abs=5e-6, nan_ok=True)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("pulse", PULSES)
def test_the_block_stands_just_below_the_spectrum_and_overturns_just_above(pulse, model):
    omega = 2.5 * PRISM.p
    level = overturning_spectrum(PRISM, pulse, frequency_ratio=[2.5], model=model, edge=1e-6).amplitude_ratio[0]
    phase = np.linspace(0, 2 * np.pi, 8001)
    shapes = {
        "half-sine": np.sin(phase / 2),
        "sine": np.sin(phase),
        "cosine": np.cos(phase),
        "rectangular": np.ones(8001),
        "ricker": (1 - (6 * phase / np.pi - 6) ** 2) * np.exp(-((6 * phase / np.pi - 6) ** 2) / 2),
    }
    # ω t over the pulse: half a period, a whole one, or ±6 √2 for Ricker's wavelet.
    reach = {"half-sine": np.pi, "rectangular": np.pi, "ricker": 12 * math.sqrt(2)}.get(pulse, 2 * np.pi)
    outcomes = []
    for factor in (0.999, 1.001):
        motion = Motion(factor * level * PRISM.uplift_acceleration * shapes[pulse], reach / omega / 8000)
        outcomes.append(rock(PRISM, motion, model=model).outcome)
    assert outcomes == ["rocking", "overturned"]


@pytest.mark.parametrize(
    ("pulse", "arguments", "message"),
    [
        ("sinus", {}, 'Unknown pulse "sinus"'),
        ("sine", {"model": "x"}, "Unknown plane model"),
        ("sine", {"edge": 0.0}, "edge"),
    ],
)
def test_impossible_arguments_are_clear_errors(pulse, arguments, message):
    with pytest.raises(ValueError, match=message):
        overturning_spectrum(PRISM, pulse, frequency_ratio=[1.0], **arguments)
