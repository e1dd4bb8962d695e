"""Levels that nobody gave: from none overturned to all."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.assessment.cases.cases import Cases, factors_at, run_cases
from colonnade.assessment.cases.levels import default_levels
from colonnade.assessment.cases.prototype import Prototype, draw
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
COLUMN = Prototype(BLOCK, 0.95)
TIME = np.arange(0.0, 6.0, 0.01)
WAVES = tuple(Motion(np.sin(2 * np.pi * hertz * TIME) * np.hanning(TIME.size), 0.01) for hertz in (0.5, 0.8, 1.2))
PEAKS = np.array([[wave.peak, np.nan] for wave in WAVES])


def test_the_share_that_overturns_goes_from_none_to_all():
    levels = default_levels(COLUMN, WAVES, PEAKS, count=8)
    assert levels.size == 8
    assert (np.diff(levels) > 0).all()
    np.testing.assert_allclose(np.diff(np.log(levels), 2), 0.0, atol=0.02)
    cases = Cases(COLUMN, (draw(COLUMN, 0),) * len(WAVES), WAVES, factors_at(levels, PEAKS))
    shares = run_cases(cases).exceeds()[..., 0].mean(axis=(0, 2, 3))
    assert shares[0] == 0.0
    assert shares[-1] == 1.0
    assert len(set(shares)) >= 3


def test_levels_are_in_the_unit_of_the_measure():
    np.testing.assert_allclose(
        default_levels(COLUMN, WAVES, 1e-3 * PEAKS), 1e-3 * default_levels(COLUMN, WAVES, PEAKS), rtol=1e-2
    )


def test_levels_of_the_square_of_a_measure_are_its_squares():
    levels, squares = default_levels(COLUMN, WAVES, PEAKS), default_levels(COLUMN, WAVES, PEAKS**2, power=2)
    np.testing.assert_allclose(squares, levels**2, rtol=2e-2)


def test_a_column_that_nothing_overturns_has_levels_up_to_the_largest_trial():
    quick = (Motion(0.01 * np.sin(np.pi * np.arange(50)), 1e-4),)
    levels = default_levels(COLUMN, quick, np.array([[quick[0].peak, np.nan]]))
    assert levels[-1] == pytest.approx(50 * BLOCK.uplift_acceleration, rel=1e-2)


def test_records_that_do_not_move_have_none():
    with pytest.raises(ValueError, match="no record has a component with a positive measure"):
        default_levels(COLUMN, (Motion(np.zeros(9), 0.01),), np.array([[0.0, np.nan]]))
