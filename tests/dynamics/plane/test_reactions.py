"""Reactions beside Newton's law from finite differences, energy beside the work of the base."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.reactions import reactions
from colonnade.dynamics.rock import rock
from prism import PRISM

LOPSIDED = Block.measured(mass=80.0, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.15), inertia=(41.2, 40.0))
INTERVAL = 0.02
PARTS = 40


def _motion(block, parts, vertical=False):
    """A record of 2 s, each interval of which is divided in `parts`."""
    rng = np.random.default_rng(4)
    time = np.arange(100) * INTERVAL
    base = sum(rng.normal() * np.sin(2 * np.pi * rng.uniform(0.8, 5) * time + rng.uniform(0, 6)) for _ in range(5))
    base *= 1.6 * block.uplift_acceleration / np.abs(base).max()
    fine = np.linspace(0, time[-1], 99 * parts + 1)
    heave = np.interp(fine, time, 3.0 * np.sin(8 * time)) if vertical else None
    return Motion(np.interp(fine, time, base), INTERVAL / parts, vertical=heave)


def _centre(history):
    """Where the centre of mass is, relative to the table, while one pole holds."""
    block = history.block
    side = np.where(history.angle < 0, -1.0, 1.0)
    values = (block.negative, block.positive)
    critical = np.where(side < 0, *(each.critical_angle for each in values))
    distance = np.where(side < 0, *(each.pole_distance for each in values))
    lean = critical - np.abs(history.angle)
    return -side * distance * np.sin(lean), distance * np.cos(lean)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("block", [PRISM, LOPSIDED], ids=["symmetric", "unequal sides"])
@pytest.mark.parametrize("vertical", [False, True], ids=["along x", "and along z"])
def test_reactions_are_newtons_law(model, block, vertical):
    motion = _motion(block, PARTS, vertical)
    history = rock(block, motion, restitution=0.9, model=model)
    forces = reactions(history, motion)
    x, z = _centre(history)
    inner = np.zeros(history.time.size, dtype=bool)
    # Five-point differences, within one interval of the record and one arc.
    arc = np.searchsorted(history.impact_times, history.time)
    angle = history.angle
    for sample in range(2, angle.size - 2):
        near = slice(sample - 2, sample + 3)
        within = (sample - 2) // PARTS == (sample + 2) // PARTS or (sample + 2) % PARTS == 0
        inner[sample] = within and np.ptp(arc[near]) == 0 and (np.sign(angle[near]) == np.sign(angle[sample])).all()
    inner &= angle != 0
    assert inner.sum() > 800
    assert len(np.unique(np.sign(angle[inner]))) == 2
    weights = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / (12 * motion.dt**2)
    across, up = (np.convolve(values, weights, mode="same") for values in (x, z))
    heave = 0.0 if motion.vertical is None else motion.vertical
    scale = block.mass * block.gravity
    for force, expected in (
        (forces.horizontal, block.mass * (motion.acceleration + across)),
        (forces.vertical, block.mass * (block.gravity + heave + up)),
    ):
        np.testing.assert_allclose(force[inner], expected[inner], rtol=0, atol=1e-6 * scale)
    np.testing.assert_allclose(forces.required_friction, np.abs(forces.horizontal) / forces.vertical)


def test_a_block_at_rest_carries_its_weight_and_the_tables_push():
    motion = Motion(np.full(5, 0.5), 0.01, vertical=np.full(5, -1.0))
    forces = reactions(rock(PRISM, motion), motion)
    np.testing.assert_allclose(forces.horizontal, 26.10 * 0.5)
    np.testing.assert_allclose(forces.vertical, 26.10 * 8.81)


def test_a_slow_block_on_a_still_base_needs_the_friction_of_its_lean():
    # Just released from rest at θ: no velocity, θ̈ = −p² sin ψ; for a rectangle R p²/g = 3/4.
    theta = 0.3 * PRISM.critical_angle
    motion = Motion(np.zeros(2), 1e-6)
    forces = reactions(rock(PRISM, motion, theta0=theta, model="nonlinear"), motion)
    lean = PRISM.critical_angle - theta
    weight = PRISM.mass * PRISM.gravity
    assert forces.horizontal[0] == pytest.approx(-0.75 * weight * math.sin(lean) * math.cos(lean), rel=1e-12)
    assert forces.vertical[0] == pytest.approx(weight * (1 - 0.75 * math.sin(lean) ** 2), rel=1e-12)


def test_an_impact_needs_the_friction_of_its_impulses():
    history = rock(PRISM, restitution=0.8, theta0=0.5 * PRISM.critical_angle, duration=2.0)
    motion = Motion(np.zeros(history.time.size), history.time[1])
    ratio = (1 - 0.8) / (1 + 0.8) / math.tan(PRISM.critical_angle)
    forces = reactions(history, motion)
    assert forces.impact_times.size > 2
    np.testing.assert_allclose(forces.impact_friction, ratio, rtol=1e-12)


def test_a_block_that_turns_fast_over_its_pole_would_leave_the_base():
    # θ̇² R > g where it stands on its edge.
    fast = 1.05 * math.sqrt(PRISM.gravity / PRISM.pole_distance)
    motion = Motion(np.zeros(2), 1e-6)
    history = rock(PRISM, motion, theta0=0.999 * PRISM.critical_angle, omega0=fast, model="nonlinear")
    forces = reactions(history, motion)
    assert (forces.vertical <= 0.0).all()
    assert np.isinf(forces.required_friction).all()


def test_a_block_that_lies_has_no_rocking_reactions():
    history = rock(PRISM, theta0=1.2 * PRISM.critical_angle, duration=5.0)
    forces = reactions(history, Motion(np.zeros(history.time.size), history.time[1]))
    assert np.isnan(forces.horizontal[-1])
    assert np.isfinite(forces.horizontal[0])


def test_what_does_not_belong_to_the_history_is_refused():
    with pytest.raises(ValueError, match="has 3 samples"):
        reactions(rock(PRISM, Motion(np.zeros(2), 0.01)), Motion(np.zeros(3), 0.01))


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_the_energy_gained_between_impacts_is_the_work_of_the_base(model):
    # Weights of the nine-point closed Newton-Cotes rule: each interval of the record is divided in eight.
    weights = np.array([989, 5888, -928, 10496, -4540, 10496, -928, 5888, 989]) * 4 / 14175
    motion = _motion(PRISM, 8)
    history = rock(PRISM, motion, restitution=0.9, model=model)
    alpha = PRISM.critical_angle
    barrier = alpha**2 if model == "linear" else 1 - math.cos(alpha)
    arm = 2.0 if model == "linear" else np.cos(alpha - np.abs(history.angle))
    power = -motion.acceleration / PRISM.gravity * history.angular_velocity * arm / barrier
    arc = np.searchsorted(history.impact_times, history.time)
    checked = 0
    for start in range(0, power.size - 8, 8):
        piece = slice(start, start + 9)
        if np.ptp(arc[piece]) or (history.angle[piece] == 0).any():
            continue
        work = motion.dt * weights @ power[piece]
        assert history.energy[start + 8] - history.energy[start] == pytest.approx(work, abs=1e-10)
        checked += 1
    assert checked > 50
    assert history.energy.max() > 0.1


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("restitution", [0.3, 0.976, 1.0])
def test_each_impact_takes_one_less_e_squared_of_the_energy(model, restitution):
    history = rock(PRISM, model=model, restitution=restitution, theta0=0.5 * PRISM.critical_angle, duration=4.0)
    arc = np.searchsorted(history.impact_times, history.time)
    levels = [history.energy[arc == number] for number in range(min(history.impact_times.size, 8))]
    for level in levels:
        assert np.ptp(level) < 1e-10
    means = np.array([level.mean() for level in levels])
    np.testing.assert_allclose(means[1:] / means[:-1], restitution**2, rtol=1e-9)
    kept = (history.rebound_velocities / history.impact_velocities) ** 2
    np.testing.assert_allclose(kept, restitution**2, rtol=1e-15)
