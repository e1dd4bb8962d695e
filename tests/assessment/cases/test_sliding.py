"""The friction that a column needs: in closed form at rest and at impacts, and what a lower one means."""

from __future__ import annotations

from math import tan

import numpy as np
import pytest

from colonnade.assessment.cases.cases import Cases
from colonnade.assessment.cases.prototype import Prototype, draw
from colonnade.assessment.cases.sliding import FrictionNeeded, friction_needed, holds
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
TIME = np.arange(0.0, 6.0, 0.01)
WAVE = np.where(TIME < 1.0, np.sin(2 * np.pi * TIME), 0.0)


def needed(*factors, vertical=None):
    column = Prototype(BLOCK, 0.9)
    factor = np.array([[[each, np.nan] for each in factors]])
    return friction_needed(Cases(column, (draw(column, 0),), (Motion(WAVE, 0.01, vertical),), factor))


def test_a_column_at_rest_needs_the_accelerations_over_gravity():
    found = needed(0.1 * 9.81)
    assert found.standing[0, 0, 0, 0] == pytest.approx(0.1, rel=1e-3)
    assert found.rocking[0, 0, 0, 0] == found.impact[0, 0, 0, 0] == 0.0
    assert np.isnan(found.largest[..., 1]).all()


def test_a_rising_base_presses_a_column_and_a_falling_one_lets_it_slide():
    down, up = (needed(0.981, vertical=sign * 3.0 * np.ones_like(TIME)).standing.flat[0] for sign in (-1, 1))
    assert down == pytest.approx(0.981 / (9.81 - 3.0 * 0.981), rel=1e-3)
    assert up == pytest.approx(0.981 / (9.81 + 3.0 * 0.981), rel=1e-3)


def test_a_column_that_rocks_needs_tan_alpha_at_rest_and_the_ratio_of_impulses_at_impacts():
    found = needed(0.4 * 9.81)
    assert 0.8 * tan(0.18) < found.standing[0, 0, 0, 0] <= tan(0.18)
    assert found.impact[0, 0, 0, 0] == pytest.approx((1 - 0.9) / ((1 + 0.9) * tan(0.18)), rel=1e-9)
    assert found.rocking[0, 0, 0, 0] > tan(0.18)


def test_a_record_that_begins_with_a_jump_uplifts_the_column_before_it_needs_friction_at_rest():
    column = Prototype(BLOCK, 0.9)
    jump = Motion(np.where(TIME < 0.1, 5.0, 0.0), 0.01)
    found = friction_needed(Cases(column, (draw(column, 0),), (jump,), np.array([[[1.0, np.nan]]])))
    assert found.standing[0, 0, 0, 0] <= tan(0.18)
    assert tan(0.18) < found.rocking[0, 0, 0, 0] < 5.0 / 9.81


def test_a_base_that_falls_away_holds_nothing():
    found = needed(1.0, 4.0, vertical=-3.0 * np.ones_like(TIME))
    assert np.isinf(found.largest[0, 1, 0, 0])
    assert np.isfinite(found.largest[0, 0, 0, 0])


def test_a_case_holds_where_the_drawn_friction_reaches():
    one = np.array([0.3, 0.5, np.nan]).reshape(1, 3, 1, 1)
    found = holds(FrictionNeeded(one, 0.5 * one, 0.0 * one), np.array([[0.2, 0.4, 0.6]]))
    assert found.shape == (1, 3, 3, 1, 1)
    assert found[0, :, :, 0, 0].tolist() == [[False, True, True], [False, False, True], [False, False, False]]
