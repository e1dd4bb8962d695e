"""The law of contact at one point: spring, damper, no pull, friction with elastic slip."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import force

STEP = 1e-3
DEPTH = 0.01
FIRM = 1000.0 * DEPTH
"""Of the spring at that depth, N."""


def pressed(engine, *, depth=DEPTH, velocity=(0.0, 0.0, 0.0), slip=(0.0, 0.0), growth=(0.0, 0.0), share=1.0):
    """Give the row of one point's load."""
    body, state, near = engine()
    near.share[0], near.depth[0] = share, depth
    near.load[0, 9:12], near.load[0, 12:14] = velocity, growth
    state.slip[0] = slip
    force.fill_force(body, state, near, 0, STEP)
    return near.load[0]


def test_at_rest_it_is_a_spring(engine):
    np.testing.assert_allclose(pressed(engine)[:4], [0.0, 0.0, FIRM, FIRM])


def test_a_point_above_the_table_feels_nothing(engine):
    assert not pressed(engine, depth=-DEPTH)[:4].any()


def test_sinking_it_is_damped_too(engine):
    load = pressed(engine, velocity=(0.0, 0.0, -0.3))
    assert (load[2], load[3]) == pytest.approx((FIRM + 20.0 * 0.3, FIRM))


def test_the_table_never_pulls(engine):
    assert pressed(engine, velocity=(0.0, 0.0, 5.0))[2] == 0.0


def test_a_point_that_arrives_in_the_middle_of_a_step_counts_for_half_of_it(engine):
    """Its depth goes from −s/2 to s/2: for half of the step it is s/4 deep in the mean."""
    sinking = 5.0 * STEP
    load = pressed(engine, depth=0.0, velocity=(0.0, 0.0, -5.0))
    assert load[3] == pytest.approx(1000.0 * 0.5 * sinking / 4)
    assert load[2] == pytest.approx(load[3] + 0.5 * 20.0 * 5.0)


def test_the_share_of_a_ring_scales_all_of_it(engine):
    given = {"velocity": (0.02, -0.01, -0.3), "growth": (1e-4, 2e-4)}
    np.testing.assert_allclose(pressed(engine, share=0.25, **given)[:4], 0.25 * pressed(engine, **given)[:4])


def test_below_the_limit_it_sticks_on_a_spring_and_a_damper(engine):
    load = pressed(engine, slip=(0.002, 0.0), growth=(0.001, -0.001), velocity=(0.05, 0.02, 0.0))
    assert load[:2] == pytest.approx([-400.0 * 0.003 - 10.0 * 0.05, 400.0 * 0.001 - 10.0 * 0.02])
    assert tuple(load[4:7]) == pytest.approx((0.003, -0.001, 1.0))


def test_beyond_it_slides_by_coulombs_law_against_its_slip(engine):
    load = pressed(engine, growth=(0.3, 0.4), velocity=(3.0, 4.0, 0.0))
    assert load[:2] == pytest.approx([-0.5 * FIRM * 0.6, -0.5 * FIRM * 0.8])
    assert load[6] == 0.0
    assert 400.0 * np.hypot(*load[4:6]) == pytest.approx(0.5 * FIRM)


def test_the_damper_of_a_point_that_sticks_stays_within_the_limit(engine):
    assert np.hypot(*pressed(engine, velocity=(3.0, 4.0, 0.0))[:2]) == pytest.approx(0.5 * FIRM)


def test_slip_that_a_lighter_force_holds_no_longer_is_let_go(engine):
    load = pressed(engine, slip=(1.0, 0.0))
    assert load[7:9] == pytest.approx([0.5 * FIRM / 400.0, 0.0])
