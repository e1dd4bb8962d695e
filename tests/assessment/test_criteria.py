"""Criteria of practice against their derivations, what they ask for, and how they agree with what happened."""

from math import sqrt, tan

import numpy as np
import pytest

from colonnade.assessment.criteria import (
    CRITERIA,
    PERIODS,
    Demands,
    agreement,
    spectral_velocity,
    sudden_velocity,
)
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock

WIDTH, HEIGHT = 0.3, 1.8
BLOCK = Block.prism(width=WIDTH, depth=0.3, height=HEIGHT, mass=400.0)
BY_ID = {criterion.id: criterion for criterion in CRITERIA}


def ratio(name, acceleration=np.nan, velocity=np.nan, spectral_velocity=np.nan):
    return float(BY_ID[name].ratio(BLOCK, Demands(*map(np.float64, (acceleration, velocity, spectral_velocity)))))


def test_west_is_width_over_height():
    assert ratio("west", acceleration=BLOCK.gravity * WIDTH / HEIGHT) == pytest.approx(1.0)


@pytest.mark.parametrize(("factor", "overturns"), [(0.97, False), (1.03, True)])
def test_a_base_that_starts_at_once_overturns_at_the_sudden_velocity(factor, overturns):
    acceleration = np.zeros(6000)
    acceleration[1:3] = factor * sudden_velocity(BLOCK) / (2 * 1e-3)
    assert (rock(BLOCK, Motion(acceleration, 1e-3)).outcome == "overturned") is overturns


def test_ishiyamas_velocity_is_ten_times_width_over_root_height():
    """10 B/√H with B and H in cm, the velocity in cm/s."""
    cited = 10 * 30 / sqrt(180) / 100
    assert ratio("ishiyama", acceleration=np.inf, velocity=cited) == pytest.approx(1.0, rel=0.04)


def test_ishiyama_asks_for_both():
    limit = BLOCK.gravity * tan(BLOCK.critical_angle)
    assert ratio("ishiyama", acceleration=2 * limit, velocity=0.1) < 1
    assert ratio("ishiyama", acceleration=0.5 * limit, velocity=10.0) < 1
    assert ratio("ishiyama", acceleration=2 * limit, velocity=10.0) == pytest.approx(2.0)
    assert np.isnan(ratio("ishiyama", acceleration=2 * limit))


def test_housner_equates_the_energies():
    """½ (M R / I₀ S_v)² I₀ = M g R α² / 2."""
    side, alpha = BLOCK.positive, BLOCK.critical_angle
    momentum = BLOCK.mass * side.pole_distance
    limit = sqrt(BLOCK.gravity * alpha**2 * side.inertia / momentum)
    assert ratio("housner", spectral_velocity=limit) == pytest.approx(1.0)
    assert ratio("housner", spectral_velocity=2 * limit) == pytest.approx(2.0)


def test_after_a_short_impulse_every_undamped_oscillator_has_its_velocity():
    acceleration = np.zeros(4000)
    acceleration[1] = 500.0
    assert spectral_velocity(acceleration, 0.001) == pytest.approx(0.5, rel=1e-3)
    assert PERIODS[-1] < 0.001 * acceleration.size


def test_every_motion_is_counted_once():
    ratio, happened = np.array([0.5, 2, 3, 0.2, np.nan, 1.5]), np.array([False, False, True, True, True, True])
    assert agreement(ratio, happened) == {
        "right_overturned": 2,
        "right_stands": 1,
        "false_alarms": 1,
        "missed": 1,
        "unknown": 1,
    }
