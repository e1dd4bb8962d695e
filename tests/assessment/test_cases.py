"""All histories of an assessment: each as rock runs it, in any parts, at levels from none overturned to all."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.assessment.cases import (
    AXES,
    FALLS_AWAY,
    NOT_RUN,
    Cases,
    default_levels,
    factors_at,
    joined,
    run_cases,
)
from colonnade.assessment.real_column import RealColumn, draw, drawn_column
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OUTCOMES
from colonnade.dynamics.rock import rock

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
UNEVEN = replace(BLOCK, positive=replace(BLOCK.positive, critical_angle=0.2))
RANGES = {"restitution_range": (0.9, 0.97), "critical_angle_range": (0.16, 0.19)}


def shaken(seed, samples=400, **others):
    random = np.random.default_rng(seed)
    smooth = np.convolve(random.standard_normal((3, samples)).ravel(), np.hanning(40), "same").reshape(3, samples)
    x, y, z = smooth * np.hanning(samples) / 5.0
    return Motion(x, 0.01, **{name: {"y": y, "z": 0.3 * z}[value] for name, value in others.items()})


MOTIONS = (shaken(1), shaken(2, transverse="y"), shaken(3, transverse="y", vertical="z"))
INTENSITY = np.array([[1.0, np.nan], [1.1, 0.9], [1.2, 0.8]])
CASES = Cases(
    RealColumn(UNEVEN, 0.95, **RANGES),
    np.stack([draw(RealColumn(UNEVEN, 0.95, **RANGES), 3, record=record) for record in range(len(MOTIONS))]),
    MOTIONS,
    factors_at(np.array([1.0, 2.0, 4.0, 40.0]), INTENSITY),
)


def test_every_case_ends_as_its_history_does():
    outcomes, seen = run_cases(CASES), set()
    assert outcomes.outcome.shape == CASES.shape == (3, 4, 4, 2, 2)
    assert len(AXES) == 5
    for index in np.ndindex(CASES.shape):
        record, level, which, side, place = index
        motion, factor = MOTIONS[record], CASES.factors[record, level, place]
        along = (motion.acceleration, motion.transverse)[place]
        seen.add(int(outcomes.outcome[index]))
        if along is None:
            assert outcomes.outcome[index] == NOT_RUN
            continue
        vertical = None if motion.vertical is None else factor * motion.vertical
        if vertical is not None and vertical.min() <= -BLOCK.gravity:
            assert outcomes.outcome[index] == FALLS_AWAY
            continue
        block, e = drawn_column(CASES.column, CASES.draws[record, which])
        plane = Motion((1, -1)[side] * factor * along, motion.dt, vertical)
        history = rock(block, plane, restitution=e, model="nonlinear")
        assert OUTCOMES[outcomes.outcome[index]] == history.outcome
        peak = np.nan if history.peak_ratio is None else history.peak_ratio
        np.testing.assert_array_equal(outcomes.peak_ratio[index], peak)
    assert seen == {FALLS_AWAY, NOT_RUN, 0, 1, 2}


@pytest.mark.parametrize(("most", "count"), [(1, 1), (2, 2), (3, 3), (50, 3)])
def test_blocks_of_records_give_what_the_whole_gives(most, count):
    whole, blocks = run_cases(CASES), CASES.blocks(most)
    assert len(blocks) == count
    found = joined([run_cases(block) for block in blocks])
    for name in ("outcome", "peak_ratio"):
        np.testing.assert_array_equal(getattr(found, name), getattr(whole, name))


def test_of_a_symmetric_column_the_opposite_motion_is_not_run_as_it_does_the_same():
    column = RealColumn(BLOCK, 0.95)
    cases = Cases(column, np.stack([draw(column, 0)] * 3), MOTIONS, CASES.factors)
    assert cases.signs == (1,)
    turned = tuple(
        Motion(-each.acceleration, each.dt, each.vertical, None if each.transverse is None else -each.transverse)
        for each in MOTIONS
    )
    outcomes, opposite = run_cases(cases), run_cases(replace(cases, motions=turned))
    np.testing.assert_array_equal(outcomes.outcome, opposite.outcome)
    np.testing.assert_allclose(outcomes.peak_ratio, opposite.peak_ratio, rtol=1e-9)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"factors": 1e9 * CASES.factors}, "Record 0, component x: The acceleration is"),
        ({"model": "contact"}, "Unknown plane model"),
    ],
)
def test_what_cannot_be_run_is_refused_before_anything_runs(changed, message):
    with pytest.raises(ValueError, match=message):
        replace(CASES, **changed)


COLUMN = RealColumn(BLOCK, 0.95)
TIME = np.arange(0.0, 6.0, 0.01)
WAVES = tuple(Motion(np.sin(2 * np.pi * hertz * TIME) * np.hanning(TIME.size), 0.01) for hertz in (0.5, 0.8, 1.2))
PEAKS = np.array([[wave.peak, np.nan] for wave in WAVES])


def test_the_share_that_overturns_goes_from_none_to_all():
    levels = default_levels(COLUMN, WAVES, PEAKS)
    assert (np.diff(levels) > 0).all()
    np.testing.assert_allclose(np.diff(np.log(levels), 2), 0.0, atol=0.02)
    cases = Cases(COLUMN, np.stack([draw(COLUMN, 0)] * 3), WAVES, factors_at(levels, PEAKS))
    shares = run_cases(cases).exceeds()[..., 0].mean(axis=(0, 2, 3))
    assert shares[0] == 0.0
    assert shares[-1] == 1.0
    assert len(set(shares)) >= 3


def test_levels_are_in_the_unit_and_of_the_power_of_the_measure():
    levels, squares = default_levels(COLUMN, WAVES, PEAKS), default_levels(COLUMN, WAVES, PEAKS**2, power=2)
    np.testing.assert_allclose(default_levels(COLUMN, WAVES, 1e-3 * PEAKS), 1e-3 * levels, rtol=1e-2)
    np.testing.assert_allclose(squares, levels**2, rtol=2e-2)


def test_a_column_that_nothing_overturns_has_levels_up_to_the_largest_trial():
    quick = (Motion(0.01 * np.sin(np.pi * np.arange(50)), 1e-4),)
    levels = default_levels(COLUMN, quick, np.array([[quick[0].peak, np.nan]]))
    assert levels[-1] == pytest.approx(50 * BLOCK.uplift_acceleration, rel=1e-2)
