"""The response spectrum against closed forms and against scipy's own solution of the oscillator."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.dynamics.spectra import response_spectrum

FINER = 64
"""Instants an interval of the motion at which scipy looks."""


def by_lsim(acceleration, interval, period, damping, finer):
    """Largest |u| by scipy's state-space solution on a finer grid of the same lines."""
    omega = 2 * np.pi / period
    system = ([[0, 1], [-(omega**2), -2 * damping * omega]], [[0], [-1]], [[1, 0]], [[0]])
    # From zero within the interval before the first sample.
    lines = np.concatenate(([0.0], acceleration))
    time = np.arange((lines.size - 1) * finer + 1) * interval / finer
    motion = np.interp(time, interval * np.arange(lines.size), lines)
    return float(np.abs(scipy.signal.lsim(system, motion, time)[1]).max())


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    period=st.floats(0.02, 3.0),
    damping=st.sampled_from([0.0, 0.02, 0.05, 0.3]),
    interval=st.sampled_from([0.002, 0.01, 0.02]),
)
def test_it_agrees_with_scipys_lsim(seed, period, damping, interval):
    # Recorded motions are smooth over a few samples; of white noise 2 % of a peak may lie between two instants.
    acceleration = np.convolve(np.random.default_rng(seed).standard_normal(150), np.hanning(9), "same")
    found = float(response_spectrum(acceleration, interval, [period], damping=damping)[0]) * (period / (2 * np.pi)) ** 2
    due = by_lsim(acceleration, interval, period, damping, FINER)
    missed_by_lsim = 1 - np.cos(np.pi * interval / FINER / period)
    assert due * (1 - 1e-3) <= found <= due * (1 + missed_by_lsim + 1e-6)


def test_the_recursion_is_exact_at_the_samples():
    """A long oscillator is looked at at the samples alone: no finer grid, no error but rounding."""
    acceleration = np.sin(np.arange(300) / 7.0)
    omega = 2 * np.pi / 1.7
    found = response_spectrum(acceleration, 0.01, [1.7]) / omega**2
    system = ([[0, 1], [-(omega**2), -0.1 * omega]], [[0], [-1]], [[1, 0]], [[0]])
    lines = np.concatenate(([0.0], acceleration))
    due = np.abs(scipy.signal.lsim(system, lines, 0.01 * np.arange(lines.size))[1]).max()
    assert found == pytest.approx(due, rel=1e-9)


def test_a_step_doubles_the_static_response_of_an_undamped_oscillator():
    spectrum = response_spectrum(np.full(4000, 3.0), 0.001, [0.1, 0.5, 1.0], damping=0.0)
    assert spectrum == pytest.approx(6.0, rel=1e-3)


def test_a_stiff_oscillator_follows_the_ground_and_a_soft_one_stays_behind():
    time = np.arange(0, 8, 0.005)
    acceleration = np.sin(2 * np.pi * time) * np.exp(-(((time - 4) / 1.2) ** 2))
    spectrum = response_spectrum(acceleration, 0.005, [0.01, 200.0])
    assert spectrum[0] == pytest.approx(np.abs(acceleration).max(), rel=2e-3)
    displacement = scipy.integrate.cumulative_trapezoid(
        scipy.integrate.cumulative_trapezoid(acceleration, dx=0.005, initial=0), dx=0.005, initial=0
    )
    assert spectrum[1] / (2 * np.pi / 200) ** 2 == pytest.approx(np.abs(displacement).max(), rel=2e-2)


def test_a_sine_at_resonance_reaches_one_over_twice_the_damping():
    time = np.arange(0, 60, 0.005)
    spectrum = response_spectrum(np.sin(2 * np.pi * time), 0.005, [1.0], damping=0.05)
    assert spectrum == pytest.approx(10.0, rel=5e-3)
