"""The nonlinear model against energy, published overturning limits and an independent integration."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p


def _block(radius, angle, gravity=9.80665):
    """A rectangle of given pole distance (m) and critical angle (rad)."""
    width, height = 2 * radius * math.sin(angle), 2 * radius * math.cos(angle)
    return Block.prism(width=width, depth=width, height=height, mass=1.0, gravity=gravity)


def test_each_impact_takes_exactly_its_share_of_the_energy():
    history = rock(PRISM, model="nonlinear", restitution=0.976, theta0=0.5 * ALPHA, duration=12.0)
    energy = (history.impact_velocities / P) ** 2 / 2
    assert energy[0] == pytest.approx(math.cos(0.5 * ALPHA) - math.cos(ALPHA), rel=1e-13)
    np.testing.assert_allclose(energy[1:60] / energy[:59], 0.976**2, rtol=1e-12)


@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_energy_is_kept_between_impacts(restitution):
    history = rock(PRISM, model="nonlinear", restitution=restitution, theta0=0.9 * ALPHA, duration=6.0)
    energy = (history.angular_velocity / P) ** 2 / 2 + np.cos(ALPHA - np.abs(history.angle))
    arc = np.searchsorted(history.impact_times, history.time)
    for number in range(4):
        values = energy[arc == number]
        assert np.ptp(values) < 1e-13


@pytest.mark.parametrize(
    ("radius", "limit"), [(0.25, 1.2618896), (0.5, 1.4584424), (1.0, 2.1637842), (2.0, 5.1549268)]
)  # Numerics-in-Motion/blocks, ± 4.9e-6
def test_one_sine_pulse_overturns_from_its_published_amplitude(radius, limit):
    block = _block(radius, 0.2)

    def overturns(amplitude):
        time = np.linspace(0, 0.5, 20_001)
        pulse = -amplitude * block.uplift_acceleration * np.sin(4 * np.pi * time)
        return rock(block, Motion(pulse, 0.5 / 20_000), model="nonlinear").outcome == "overturned"

    assert not overturns(limit - 5e-6)
    assert overturns(limit + 5e-6)


@pytest.mark.parametrize(
    ("radius", "energy"),
    [(0.25, 2.6769386150), (0.5, 1.7110938843), (1.0, 0.9245234031), (2.0, 0.4769203393), (4.0, 0.2418237131)],
)  # Numerics-in-Motion/blocks, A = 2, 1e-8
def test_one_sine_pulse_leaves_its_published_energy(radius, energy):
    block = _block(radius, 0.2)
    time = np.linspace(0, 0.5, 200_001)
    motion = Motion(-2 * block.uplift_acceleration * np.sin(4 * np.pi * time), 0.5 / 200_000)
    history = rock(block, motion, model="nonlinear")
    kinetic = (history.angular_velocity[-1] / block.p) ** 2 / 2
    height = math.cos(0.2 - abs(history.angle[-1])) - math.cos(0.2)
    assert (kinetic + height) / (1 - math.cos(0.2)) == pytest.approx(energy, abs=1e-8)


@pytest.mark.parametrize(("length", "limit"), [(0.5, 2.54188), (1.0, 1.58219), (2.0, 1.15666)])
def test_rectangular_pulse_overturns_from_its_published_level(length, limit):
    block = _block(1.0, 0.02)

    def overturns(level):
        motion = Motion(np.full(50, -level * 0.02 * block.gravity), length / block.p / 49)
        pulse = rock(block, motion, model="nonlinear")
        state = {"theta0": pulse.angle[-1], "omega0": pulse.angular_velocity[-1]}
        return rock(block, model="nonlinear", duration=1.0, **state).outcome == "overturned"

    assert not overturns(limit - 6e-6)
    assert overturns(limit + 6e-6)


@pytest.mark.parametrize("seed", range(4))
def test_a_smooth_motion_agrees_with_an_adaptive_integration_up_to_the_first_impact(seed):
    rng = np.random.default_rng(seed)
    level, frequency = rng.uniform(1.5, 3.0), rng.uniform(1.0, 4.0)
    time = np.linspace(0, 1.0, 100_001)
    motion = Motion(level * PRISM.uplift_acceleration * np.cos(2 * np.pi * frequency * time), 1e-5)
    history = rock(PRISM, motion, model="nonlinear")
    until = int(np.searchsorted(time, history.impact_times[0])) if history.impact_times.size else time.size
    until = min(until, int(np.argmax(np.abs(history.angle) > 1)) or time.size)

    def equation(t, y):
        base = level * math.tan(ALPHA) * math.cos(2 * np.pi * frequency * t)
        return [y[1], -(P**2) * (math.sin(-ALPHA - y[0]) + base * math.cos(-ALPHA - y[0]))]

    expected = solve_ivp(equation, (0, 1), [0, 0], method="DOP853", rtol=1e-12, atol=1e-15, t_eval=time[:until]).y[0]
    assert until > 1000
    # The record is the sine's chords: they differ from it by (2π f dt)²/8, 8e-9 at 4 Hz.
    np.testing.assert_allclose(history.angle[:until], expected, rtol=1e-7, atol=1e-8 * ALPHA)


def test_a_slender_block_at_small_angles_rocks_as_the_linear_one():
    block = _block(1.0, 0.001)
    histories = [
        rock(block, model=model, theta0=0.0005, restitution=0.9, duration=3.0) for model in ("linear", "nonlinear")
    ]
    np.testing.assert_allclose(histories[0].angle, histories[1].angle, atol=2e-7 * 0.001 * 10)


def test_rocking_starts_strictly_above_g_tan_alpha():
    at = Motion(np.full(50, 9.81 * math.tan(ALPHA)), 0.01)
    above = Motion(at.acceleration * (1 + 1e-9), 0.01)
    assert np.abs(rock(PRISM, at, model="nonlinear").angle).max() == 0
    assert rock(PRISM, above, model="nonlinear").angle[-1] < 0


@pytest.mark.parametrize("restitution", [0.0, 0.6, 0.95])
def test_accumulating_impacts_end_at_rest(restitution):
    history = rock(PRISM, model="nonlinear", restitution=restitution, theta0=0.5 * ALPHA, duration=30.0)
    assert history.angle[-1] == 0.0
    assert history.outcome == "rocking"


def test_a_block_past_return_lies_down():
    history = rock(PRISM, model="nonlinear", theta0=-1.01 * ALPHA, duration=6.0)
    assert history.outcome == "overturned"
    assert history.angle[-1] == pytest.approx(-math.pi / 2)
    assert history.overturning_time == 0.0


def test_one_long_step_is_walked_in_as_many_series_as_it_needs():
    motion = Motion([0.0, 0.0], 20.0)
    history = rock(PRISM, motion, model="nonlinear", theta0=0.5 * ALPHA, restitution=0.9)
    finer = rock(PRISM, model="nonlinear", theta0=0.5 * ALPHA, restitution=0.9, duration=20.0)
    np.testing.assert_allclose(history.impact_times, finer.impact_times, rtol=1e-9)
