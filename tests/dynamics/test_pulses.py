"""The pulses themselves: their size, their derivatives, and what sampling leaves of them."""

import math

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.dynamics.plane.run import outcomes_of
from colonnade.dynamics.pulses import PULSES, mavroeidis_papageorgiou, ricker, sampled_pulse
from prism import PRISM


@settings(max_examples=30)
@given(cycles=st.floats(1.0, 6.0), phase=st.floats(0.0, 6.28))
def test_mavroeidis_and_papageorgious_acceleration_is_the_derivative_of_its_velocity(cycles, phase):
    angle = np.linspace(-math.pi * cycles, math.pi * cycles, 8001)
    velocity = 0.5 * (1 + np.cos(angle / cycles)) * np.cos(angle + phase)
    slope = np.gradient(velocity, angle, edge_order=2)
    np.testing.assert_allclose(mavroeidis_papageorgiou(cycles, phase, angle), slope, atol=1e-4)


@settings(max_examples=30)
@given(
    cycles=st.floats(1.0, 6.0), phase=st.floats(0.0, 6.28), kind=st.sampled_from(["ricker", "mavroeidis-papageorgiou"])
)
def test_a_sampled_pulse_is_of_unit_size(cycles, phase, kind):
    values, _step = sampled_pulse(kind, cycles, phase)
    assert np.abs(values).max() == pytest.approx(1.0, abs=1e-4)


def test_the_samples_have_the_integrals_of_the_pulse():
    values, step = sampled_pulse("ricker", 0.0, 0.0)
    angle = step * (np.arange(values.size) - values.size // 2)
    # Integral of the motion that is linear between samples, times exp(−x/3), against that of the curve.
    fine = np.linspace(angle[0], angle[-1], 40 * (angle.size - 1) + 1)
    weight = np.exp(-fine / 3)
    polygon = scipy.integrate.simpson(np.interp(fine, angle, values) * weight, x=fine)
    curve = scipy.integrate.simpson(ricker(fine) * weight, x=fine)
    plain = scipy.integrate.simpson(np.interp(fine, angle, ricker(angle)) * weight, x=fine)
    assert abs(polygon - curve) < 1e-8
    assert abs(plain - curve) > 1e-6


@pytest.mark.parametrize("name", PULSES)
def test_every_pulse_says_what_it_is(name):
    assert PULSES[name].definition
    assert PULSES[name].source
    assert (PULSES[name].cycles is None) == (name in ("ricker", "mavroeidis-papageorgiou"))


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("name", PULSES)
def test_outcomes_under_a_pulse_do_not_depend_on_those_before(name, model):
    amplitudes = np.array([8.0, 1.3, 0.5, 2.0, 1.1])
    asked = {
        "block": PRISM,
        "forcing": PULSES[name].forcing(PRISM, 2.0 * PRISM.p, 2.0, 0.0),
        "restitution": (0.95, 0.95),
        "model": model,
    }
    alone = [outcomes_of(np.array([each]), **asked)[0] for each in amplitudes]
    assert outcomes_of(amplitudes, **asked).tolist() == alone
    assert alone[0] > alone[2] == 0
