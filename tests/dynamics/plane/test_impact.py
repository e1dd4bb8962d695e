"""Uplift, landing and impact of a block on its two sides."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.plane.impact import (
    comes_to_rest,
    holding_moment,
    rebound,
    restitution_of,
    survives_free_rocking,
)
from colonnade.dynamics.plane.landing import verdict
from colonnade.dynamics.plane.sides import Sides, sides_of
from colonnade.dynamics.plane.uplift import harmonic_uplift, level_uplift, sampled_uplift
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.dynamics.rock import rock
from every import every
from prism import PRISM


@pytest.mark.parametrize(("velocity", "here", "e"), [(0.5, 0, 0.9), (-1.5, 0, 0.85), (9.0, 0, 0.8), (-1.0, 1, 0.7)])
def test_restitution_is_linear_between_its_speeds_and_constant_beyond(velocity, here, e):
    table, speeds = np.array([0.9, 0.8, 0.7, 0.6]), np.array([1.0, 2.0])
    assert restitution_of(table, speeds, here, velocity) == pytest.approx(e)


def test_a_pair_is_of_the_side_whatever_the_speed():
    assert [restitution_of(np.array([0.9, 0.8]), np.zeros(1), here, 3.0) for here in (0, 1)] == [0.9, 0.8]


def test_a_block_that_the_base_lifts_does_not_rest():
    assert holding_moment(0.2, 1.0, -0.1, True) == pytest.approx(0.1)
    assert comes_to_rest(1e-9, 0.2, 0.1, 1e-6)
    assert not comes_to_rest(1e-7, 0.2, 0.1, 1e-6)
    assert not comes_to_rest(0.0, 0.2, holding_moment(0.2, 1.0, -0.3, False), 1e-6)


def test_an_impact_leaves_e_times_its_velocity_or_the_block_at_rest():
    sides = Sides((0.2, 0.3), (5.0, 5.0), np.array([0.9, 0.8]), np.zeros(1), 1e-6)
    assert rebound(-1.0, 1, 1.0, 0.0, sides, True) == (-0.8, False)
    assert rebound(1.0, 0, 1.0, 0.0, sides, False) == (0.9, False)
    assert rebound(-1e-4, 1, 1.0, 0.0, sides, True) == (0.0, True)
    assert rebound(-1e-4, 1, 1.0, 0.25, sides, True) == (-0.8e-4, False)  # the base lifts it to θ < 0 at once


@every("model", ["linear", "nonlinear"])
@every(("height", "rate"), [(0.9, 0.0), (0.9, 0.3), (1.1, -0.05), (1.1, -1.0), (0.0, 1.5)])
def test_what_is_told_of_free_rocking_is_what_a_run_gives(model, height, rate):
    alpha = PRISM.critical_angle
    sides = sides_of(PRISM, (0.9, 0.9), 1e-6)
    stands = survives_free_rocking(height * alpha, rate * alpha, 1, sides, model == "linear")
    run = rock(PRISM, restitution=0.9, theta0=height * alpha, omega0=rate * alpha * PRISM.p, duration=3.0, model=model)
    assert stands == (run.outcome != "overturned")


@pytest.mark.parametrize(
    ("start", "end", "told"),
    [
        ((1.0, 0.1, -0.2, 0.0), (0.9, -0.3, -0.2, 0.0), 1),
        ((0.1, -0.5, -0.1, 0.0), (-0.4, -0.6, -0.1, 0.0), -1),
        ((0.01, -0.5, 5.0, 0.0), (0.02, 0.5, 5.0, 0.0), 0),
    ],
    ids=["high above", "falls through", "close to the base"],
)
def test_a_verdict_on_a_piece(start, end, told):
    assert verdict(1.0, start, end, 0.1, 0.1) == told


LOPSIDED = Block.measured(mass=80.0, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.15), inertia=(41.2, 40.0))


def test_each_side_has_its_own_angle_frequency_and_restitution():
    sides = sides_of(LOPSIDED, (0.9, 0.8), 1e-6)
    np.testing.assert_allclose(sides.critical, [0.21, 0.15])
    np.testing.assert_allclose(sides.p, np.sqrt([80 * 9.81 * 0.61 / 41.2, 80 * 9.81 * 0.60 / 40.0]))
    assert sides.restitution.ravel().tolist() == [0.9, 0.8]
    assert sides.rest_angle == 1e-6


def test_a_law_comes_with_its_speeds():
    sides = sides_of(LOPSIDED, RestitutionLaw.table([0.0, 2.0], [1.0, 0.8]), 0.0)
    assert sides.speeds.tolist() == pytest.approx([0.0, 2.0])
    assert set(sides.restitution.ravel()) == {1.0, 0.8}


TIME = np.linspace(0.0, 4.0, 400_001)


@every("levels", [(0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (0.1, 0.25)])
@every("phase", [0.0, 2.0, 4.0])
def test_uplift_is_where_a_scan_first_passes_a_threshold(levels, phase):
    begin, end = levels
    slope = (end - begin) / 4.0
    base = (begin + slope * TIME) * np.sin(7.0 * TIME + phase)
    first = int(np.argmax((base > 0.2) | (-base > 0.22)))
    instant, side = harmonic_uplift(0.0, 4.0, 0.0, 7.0, phase, (begin, slope), 0.2, 0.22)
    assert instant == pytest.approx(TIME[first], abs=2e-5)
    assert side == -np.sign(base[first])


def test_a_weak_motion_leaves_the_block_at_rest():
    assert harmonic_uplift(0.0, 4.0, 0.0, 7.0, 0.0, (0.0, 0.025), 0.2, 0.2) == (math.inf, 0.0)


@pytest.mark.parametrize(
    ("base", "expected"),
    [((0.1, 0.3), (0.5, 0)), ((-0.1, -0.4), (0.5, 1)), ((0.25, 0.0), (0.0, 0)), ((0.2, -0.25), (math.inf, 0))],
    ids=["rises past one threshold", "falls past the other", "begins beyond", "stays within"],
)
def test_sampled_uplift_is_where_the_moment_or_the_base_acceleration_passes_its_threshold(base, expected):
    thresholds = np.array([0.2, 0.25])
    first, last = ((level - thresholds[0], -level - thresholds[1]) for level in base)
    level = level_uplift(0.0, 1.0, base[0], base[1] - base[0], thresholds)
    assert level == pytest.approx(expected)
    assert sampled_uplift(0.0, 1.0, first, last) == pytest.approx(expected)
