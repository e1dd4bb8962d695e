"""Restitution over speed and side, the rest rule, and who stands again when left alone."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.plane.impact import (
    comes_to_rest,
    holding_moment,
    rebound,
    restitution_of,
    survives_free_rocking,
)
from colonnade.dynamics.plane.sides import Sides, sides_of
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
