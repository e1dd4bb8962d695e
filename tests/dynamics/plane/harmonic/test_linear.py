"""One arc of the linear equation under a sine, in closed form, against SciPy's DOP853 and textbook solutions."""

from math import cos, cosh, pi, sin, sinh

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.plane import landing
from colonnade.dynamics.plane.harmonic import linear as harmonic_linear
from colonnade.dynamics.plane.harmonic.linear import LONGEST_STEP, closed_arc

ALPHA, P, OMEGA = 0.2, 4.0, 11.0
STEADY = 0.3, 0.0
RISING = 0.1, 0.8
"""Level of a/g where an arc begins and its slope, 1/s."""


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(harmonic_linear, landing)


def arc(height, rate, *, side=1.0, angle=0.4, level=STEADY, remaining=0.5, top=False):
    state = height, rate, sin(angle), cos(angle)
    return closed_arc(state, side, ALPHA, P, OMEGA, *level, remaining, top)


def integrated(height, rate, x, *, side=1.0, angle=0.4, level=STEADY, times=None):
    """h'' = h − α − q sin φ by SciPy, h and h' in x = p t."""

    def rates(x, state):
        q = side * (level[0] + level[1] * x / P)
        return [state[1], state[0] - ALPHA - q * sin(angle + OMEGA / P * x)]

    found = solve_ivp(rates, (0.0, x), [height, rate], method="DOP853", rtol=1e-13, atol=1e-16, t_eval=times)
    return found.y if times is not None else found.y[:, -1]


@pytest.mark.parametrize("level", [STEADY, RISING], ids=["steady", "rising"])
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize(("height", "rate"), [(0.15, 0.0), (0.1, 0.05), (0.0, 0.1)])
def test_an_arc_is_that_of_another_integrator(level, side, height, rate):
    landed, x, _, (last, speed, sine, cosine) = arc(height, rate, side=side, level=level)
    np.testing.assert_allclose((last, speed), integrated(height, rate, x, side=side, level=level), atol=1e-12)
    assert landed == (last == 0.0)
    assert (sine, cosine) == pytest.approx((sin(0.4 + OMEGA / P * x), cos(0.4 + OMEGA / P * x)), abs=1e-13)


def test_on_a_table_at_rest_an_arc_is_that_of_hyperbolic_functions():
    """h = α + (h₀ − α) cosh x + h₀' sinh x."""
    _, x, _, (last, speed, *_) = arc(0.15, 0.02, level=(0.0, 0.0), remaining=0.4)
    away = 0.15 - ALPHA
    assert last == pytest.approx(ALPHA + away * cosh(x) + 0.02 * sinh(x), rel=1e-14)
    assert speed == pytest.approx(away * sinh(x) + 0.02 * cosh(x), rel=1e-12)


def test_an_impact_is_where_the_height_first_comes_to_nothing():
    landed, x, _, (last, speed, *_) = arc(0.05, -0.2, angle=0.5 * pi)
    assert landed
    assert last == 0.0
    heights = integrated(0.05, -0.2, x, angle=0.5 * pi, times=np.linspace(0.0, x, 50))[0]
    assert heights[-1] == pytest.approx(0.0, abs=1e-12)
    assert (heights[:-1] > 0.0).all()
    assert speed < 0.0


def test_a_block_on_the_table_that_moves_down_has_landed_at_once():
    landed, x, _, (_, speed, *_) = arc(0.0, -0.1)
    assert (landed, x, speed) == (True, 0.0, -0.1)


def test_the_top_inside_an_arc_is_given_where_it_is_asked_for():
    given = {"angle": 0.5 * pi, "remaining": 0.4}
    _, x, top, (last, speed, *_) = arc(0.1, 0.05, top=True, **given)
    assert speed < 0.0
    heights = integrated(0.1, 0.05, x, angle=0.5 * pi, times=np.linspace(0.0, x, 2001))[0]
    assert top == pytest.approx(heights.max(), rel=1e-7)
    assert arc(0.1, 0.05, **given)[2] == last < top


@pytest.mark.parametrize("x", [1e-6, 1e-3, 0.3, LONGEST_STEP])
def test_ten_terms_are_the_functions_to_rounding_up_to_the_longest_step(x):
    odd, even = harmonic_linear._odd_even(x * x)
    assert odd == pytest.approx(sinh(x) / x, rel=1e-15)
    assert even == pytest.approx(2 * sinh(x / 2) ** 2 / x**2, rel=1e-15)
    odd, even = harmonic_linear._odd_even(-x * x)
    assert odd == pytest.approx(sin(x) / x, rel=1e-15)
    assert even == pytest.approx(2 * sin(x / 2) ** 2 / x**2, rel=1e-15)
