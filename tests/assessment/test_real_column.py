"""The real column: ranges, draws that are the same however many, and the friction that it needs."""

from dataclasses import replace
from math import tan

import numpy as np
import pytest

from colonnade.assessment.cases import Cases, friction_needed
from colonnade.assessment.real_column import UNCERTAIN, RealColumn, draw, drawn_column
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
COLUMN = RealColumn(
    BLOCK,
    0.95,
    0.6,
    restitution_range=(0.93, 0.97),
    critical_angle_range=(0.17, 0.19),
    p_range=(1.2, 1.5),
    friction_range=(0.5, 0.7),
)


def test_more_draws_begin_with_the_same_and_the_first_has_nothing_varied():
    few, many = draw(COLUMN, 5, seed=3), draw(COLUMN, 50, seed=3)
    np.testing.assert_array_equal(few, many[:6])
    np.testing.assert_allclose(many[0], [0.95, 0.18, BLOCK.p, 0.6])
    assert (draw(COLUMN, 5, seed=4)[1:] != few[1:]).all()


def test_draws_fill_their_ranges_evenly():
    values = draw(COLUMN, 2000)[1:]
    for column, (low, high) in enumerate(COLUMN.ranges):
        share = (values[:, column] - low) / (high - low)
        assert 0.0 <= share.min() < 0.01
        assert 0.99 < share.max() <= 1.0
        assert share.mean() == pytest.approx(0.5, abs=4 / np.sqrt(12 * 2000))
    assert np.abs(np.corrcoef(values.T) - np.eye(4)).max() < 4 / np.sqrt(2000)


def test_a_range_that_goes_leaves_the_other_draws_as_they_are():
    without = draw(replace(COLUMN, p_range=None), 9)
    np.testing.assert_array_equal(without[:, [0, 1, 3]], draw(COLUMN, 9)[:, [0, 1, 3]])
    assert set(without[:, UNCERTAIN.index("p")]) == {BLOCK.p}


def test_the_sides_of_a_column_keep_their_proportions():
    uneven = replace(BLOCK, positive=replace(BLOCK.positive, critical_angle=0.27))
    column = replace(COLUMN, block=uneven, restitution=(0.94, 0.96))
    assert not column.is_symmetric
    draws = draw(column, 1)
    block, (negative, positive) = drawn_column(column, draws[1])
    assert block.positive.critical_angle / block.negative.critical_angle == pytest.approx(1.5)
    assert 0.5 * (negative + positive) == pytest.approx(draws[1, 0])
    assert positive - negative == pytest.approx(0.02)


TIME = np.arange(0.0, 6.0, 0.01)
WAVE = np.where(TIME < 1.0, np.sin(2 * np.pi * TIME), 0.0)


def needed(*factors, vertical=None):
    column = RealColumn(BLOCK, 0.9)
    factor = np.array([[[each, np.nan] for each in factors]])
    return friction_needed(Cases(column, draw(column, 0)[None], (Motion(WAVE, 0.01, vertical),), factor))


def test_a_column_at_rest_needs_the_accelerations_over_gravity():
    found = needed(0.1 * 9.81)
    assert found[0, 0, 0, 0] == pytest.approx(0.1, rel=1e-3)
    assert np.isnan(found[..., 1]).all()


def test_a_rising_base_presses_a_column_and_a_falling_one_lets_it_slide():
    down, up = (needed(0.981, vertical=sign * 3.0 * np.ones_like(TIME)).flat[0] for sign in (-1, 1))
    assert down == pytest.approx(0.981 / (9.81 - 3.0 * 0.981), rel=1e-3)
    assert up == pytest.approx(0.981 / (9.81 + 3.0 * 0.981), rel=1e-3)


def test_a_column_that_rocks_needs_more_than_tan_alpha_and_the_ratio_of_impulses_at_impacts():
    found = needed(0.4 * 9.81)[0, 0, 0, 0]
    assert found > tan(0.18)
    assert found >= (1 - 0.9) / ((1 + 0.9) * tan(0.18))


def test_a_record_that_begins_with_a_jump_uplifts_the_column_before_it_needs_friction_at_rest():
    column = RealColumn(BLOCK, 0.9)
    jump = Motion(np.where(TIME < 0.1, 5.0, 0.0), 0.01)
    found = friction_needed(Cases(column, draw(column, 0)[None], (jump,), np.array([[[1.0, np.nan]]])))
    assert tan(0.18) < found[0, 0, 0, 0] < 5.0 / 9.81


def test_a_base_that_falls_away_holds_nothing():
    found = needed(1.0, 4.0, vertical=-3.0 * np.ones_like(TIME))
    assert np.isinf(found[0, 1, 0, 0])
    assert np.isfinite(found[0, 0, 0, 0])
