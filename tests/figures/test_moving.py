"""The moving block turns about the pole that it rocks about, rides on its base, and ends in bounded time."""

from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from colonnade.figures.moving import MOST_FRAMES, RATE, rocking_block, turn
from colonnade.figures.panels.curve import Curve

CORNERS = np.array([(-0.043, 0.0), (0.043, 0.0), (0.043, 0.456), (-0.043, 0.456)])
POLES = (-0.043, 0.043)


@given(st.floats(-1.5, 1.5))
def test_the_pole_stays_and_all_lengths_stay(angle):
    (turned,) = turn(CORNERS, np.array([angle]), POLES)
    fixed = 1 if angle > 0 else 0
    np.testing.assert_allclose(turned[fixed], CORNERS[fixed], atol=1e-12)
    for one in range(4):
        assert hypot(*(turned[one] - turned[fixed])) == pytest.approx(hypot(*(CORNERS[one] - CORNERS[fixed])))
    assert turned[:, 1].min() >= -1e-9 or abs(angle) > 1.4


def movie(duration, base=None):
    time = np.linspace(0.0, duration, 2000)
    angles = {"measured": Curve(time, 0.1 * np.sin(time)), "linear": Curve(time, 0.1 * np.cos(time))}
    return rocking_block(angles, CORNERS, POLES, base, figure=Figure())


def test_a_short_test_is_shown_at_its_own_speed_and_a_long_one_faster():
    short, long = movie(4.0), movie(100.0)
    assert short.frames == 4 * RATE
    assert long.frames == MOST_FRAMES
    long.show(0)
    (clock,) = long.figure.axes[0].texts
    assert clock.get_text() == "0.00 s, 10 × faster"


def test_each_history_has_its_outline_on_the_moving_base():
    time = np.linspace(0.0, 4.0, 50)
    moving = movie(4.0, Curve(time, 0.02 * time))
    axes = moving.figure.axes[0]
    moving.show(moving.frames - 1)
    measured, linear = (patch.get_xy()[:4] for patch in axes.patches)
    aside = np.array([0.08, 0.0])
    np.testing.assert_allclose(measured, turn(CORNERS, np.array([0.1 * np.sin(4.0)]), POLES)[0] + aside, atol=1e-6)
    np.testing.assert_allclose(linear, turn(CORNERS, np.array([0.1 * np.cos(4.0)]), POLES)[0] + aside, atol=1e-6)
