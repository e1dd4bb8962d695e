"""Uplift of a block on its two sides, and what an impact leaves."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.plane.sides import Part, Sides, rebound, restitution_of, sides_of, survives_free_rocking, uplift
from colonnade.dynamics.rock import RestitutionLaw, rock
from every import every
from prism import PRISM

LOPSIDED = Block.measured(mass=80.0, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.15), inertia=(41.2, 40.0))


@pytest.mark.parametrize(("velocity", "here", "e"), [(0.5, 0, 0.9), (-1.5, 0, 0.85), (9.0, 0, 0.8), (-1.0, 1, 0.7)])
def test_restitution_is_linear_between_its_speeds_and_constant_beyond(velocity, here, e):
    table, speeds = np.array([0.9, 0.8, 0.7, 0.6]), np.array([1.0, 2.0])
    assert restitution_of(table, speeds, here, velocity) == pytest.approx(e)


def test_a_pair_is_of_the_side_whatever_the_speed():
    assert [restitution_of(np.array([0.9, 0.8]), np.zeros(1), here, 3.0) for here in (0, 1)] == [0.9, 0.8]


def test_an_impact_leaves_e_times_its_velocity_or_the_block_at_rest():
    sides = Sides((0.2, 0.3), (5.0, 4.0), np.array([0.9, 0.8]), np.zeros(1), 1e-6)
    # dh/dx is the velocity over the p of its side.
    assert rebound(-1.0, 1, 1.0, 0.0, sides, True) == (pytest.approx(0.8 * 4 / 5), False)
    assert rebound(-1.0, 0, 1.0, 0.0, sides, False) == (pytest.approx(0.9 * 5 / 4), False)
    assert rebound(-1e-5, 1, 1.0, 0.0, sides, True) == (0.0, True)
    assert rebound(-1e-5, 1, 1.0, 0.25, sides, True) == (pytest.approx(0.64e-5), False)  # the base lifts it at once
    assert rebound(-1e-5, 1, 0.2, 0.05, sides, False) == (pytest.approx(0.64e-5), False)  # so light that it does


@every("model", ["linear", "nonlinear"])
@every(("height", "rate"), [(0.9, 0.0), (0.9, 0.3), (1.1, -0.05), (1.1, -1.0), (0.0, 1.5)])
def test_what_is_told_of_free_rocking_is_what_a_run_gives(model, height, rate):
    alpha = PRISM.critical_angle
    sides = sides_of(PRISM, (0.9, 0.9), 1e-6)
    stands = survives_free_rocking(height * alpha, rate * alpha, 1, sides, model == "linear")
    run = rock(PRISM, restitution=0.9, theta0=height * alpha, omega0=rate * alpha * PRISM.p, duration=3.0, model=model)
    assert stands == (run.outcome != "overturned")


def test_each_side_has_its_own_angle_frequency_and_restitution():
    sides = sides_of(LOPSIDED, (0.9, 0.8), 1e-6)
    np.testing.assert_allclose(sides.critical, [0.21, 0.15])
    np.testing.assert_allclose(sides.p, np.sqrt([80 * 9.81 * 0.61 / 41.2, 80 * 9.81 * 0.60 / 40.0]))
    assert sides.restitution.tolist() == [0.9, 0.8]
    law = sides_of(LOPSIDED, RestitutionLaw([0.0, 2.0], [1.0, 0.8]), 0.0)
    assert law.speeds.tolist() == pytest.approx([0.0, 2.0])
    assert law.restitution.tolist() == [1.0, 0.8] * 2


TIME = np.linspace(0.0, 4.0, 400_001)


@every("levels", [(0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (0.1, 0.25)])
@every("phase", [0.0, 2.0, 4.0])
def test_uplift_is_where_a_scan_first_passes_a_threshold(levels, phase):
    begin, end = levels
    slope = (end - begin) / 4.0
    base = (begin + slope * TIME) * np.sin(7.0 * TIME + phase)
    first = int(np.argmax((base > 0.2) | (-base > 0.22)))
    instant, side = uplift(0.0, Part(4.0, begin, slope, 1.0, 0.0, 7.0, phase), (0.2, 0.22))
    assert instant == pytest.approx(TIME[first], abs=2e-5)
    assert side == (0 if base[first] > 0.0 else 1)


def test_a_weak_motion_leaves_the_block_at_rest():
    assert uplift(0.0, Part(4.0, 0.0, 0.025, 1.0, 0.0, 7.0, 0.0), (0.2, 0.2)) == (math.inf, 0)


@pytest.mark.parametrize("weight", [(1.0, 0.0), (0.8, 0.4)], ids=["level", "lifted"])
@pytest.mark.parametrize(
    "base",
    [(0.1, 0.3), (-0.1, -0.4), (0.25, 0.0), (0.15, -0.19)],
    ids=["rises past one threshold", "falls past the other", "begins beyond", "stays within"],
)
def test_between_samples_uplift_is_where_the_base_acceleration_passes_its_threshold(base, weight):
    share = TIME / 4.0
    pull, held = base[0] + (base[1] - base[0]) * share, weight[0] + weight[1] * share
    beyond = (pull > 0.2 * held) | (-pull > 0.25 * held)
    expected = share[np.argmax(beyond)] if beyond.any() else math.inf
    part = Part(1.0, base[0], base[1] - base[0], *weight, 0.0, math.pi / 2)
    instant, side = uplift(0.0, part, (0.2, 0.25))
    assert instant == pytest.approx(expected, abs=1e-5)
    assert side == (1 if beyond.any() and base[1] < 0.0 else 0)
