"""One arc of the linear model against its closed form, and whole samples against many arcs."""

from math import acosh, cosh, sinh, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.dynamics.plane import linear
from colonnade.dynamics.plane.step import Interval
from every import every
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
LEFT, RIGHT = -1.0, 1.0


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(linear)


def closed_step(base, dt, elapsed, angle, velocity, side, largest, sample=0):
    interval = Interval(dt * sample, dt, base[sample], base[sample + 1], 1.0, 1.0)
    return linear.closed_step(interval, elapsed, angle, velocity, side, ALPHA, P, largest)


def arc(x, angle, velocity, side, base, slope):
    """θ and ω after x = p t by the module's own formula, as it stands in its first lines; a/g = base + slope x."""
    pull = ALPHA * side + base
    scaled = velocity / P
    height = angle * cosh(x) + scaled * sinh(x) - pull * (cosh(x) - 1) - slope * (sinh(x) - x)
    return height, P * (angle * sinh(x) + scaled * cosh(x) - pull * sinh(x) - slope * (cosh(x) - 1))


@every("ratio", [1e-4, 0.2, 0.5, 0.95])
@every("side", [LEFT, RIGHT])
def test_let_go_it_lands_after_housners_quarter_period(ratio, side):
    step = closed_step(np.zeros(2), 10.0 / P, 0.0, side * ratio * ALPHA, 0.0, side, 0.0)
    assert step.has_landed
    assert P * step.elapsed == pytest.approx(acosh(1 / (1 - ratio)), rel=1e-12)
    assert step.velocity == pytest.approx(-side * P * ALPHA * sqrt(1 - (1 - ratio) ** 2), rel=1e-12)
    assert step.angle == 0.0


@given(
    st.floats(0.05, 0.9), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.sampled_from([0.1, 0.4])
)
@settings(max_examples=60)
def test_a_sample_is_the_closed_form_up_to_a_first_impact(ratio, climb, first, last, length):
    base, dt = ALPHA * np.array([first, last]), length / P
    angle, velocity = ratio * ALPHA, climb * ALPHA * P
    step = closed_step(base, dt, 0.0, angle, velocity, RIGHT, float(np.abs(base).max()))
    formula = (angle, velocity, 1, base[0], (base[1] - base[0]) / length)
    expected = arc(P * step.elapsed, *formula)
    assert (step.angle, step.velocity) == pytest.approx(expected, abs=1e-11 * ALPHA * P)
    heights = [arc(x, *formula)[0] for x in np.linspace(0.0, P * step.elapsed, 40)[1:-1]]
    assert min(heights, default=1.0) > 0.0
    assert step.has_landed or step.elapsed == dt


def test_the_end_of_a_sample_may_begin_inside_it():
    base, dt = ALPHA * np.array([0.2, -0.6]), 0.3 / P
    half = closed_step(base, dt, 0.0, 0.5 * ALPHA, 0.0, RIGHT, ALPHA)
    middle = arc(0.15, 0.5 * ALPHA, 0.0, 1, base[0], (base[1] - base[0]) / 0.3)
    rest = closed_step(base, dt, 0.5 * dt, *middle, RIGHT, ALPHA)
    assert rest.angle == pytest.approx(half.angle, rel=1e-13)
    assert rest.velocity == pytest.approx(half.velocity, rel=1e-13)


def test_beyond_its_critical_angle_and_outwards_it_never_returns():
    """Let go at rest above α: the height over α grows as cosh x."""
    step = closed_step(np.zeros(2), 1.0 / P, 0.0, 0.9 * ALPHA, 0.5 * ALPHA * P, RIGHT, 0.0)
    assert step.is_past
    # θ − α = α (−0.1 cosh x + 0.5 sinh x) is 0 at tanh x = 0.2.
    assert P * step.passed == pytest.approx(np.arctanh(0.2), rel=1e-12)
    pushed = closed_step(np.zeros(2), 1.0 / P, 0.0, 0.9 * ALPHA, 0.5 * ALPHA * P, RIGHT, ALPHA)
    assert not pushed.is_past


@pytest.mark.parametrize("side", [LEFT, RIGHT])
def test_samples_in_which_nothing_happens_are_passed_over_to_the_same_state(side):
    base = ALPHA * 0.3 * np.sin(np.arange(60.0))
    dt, largest = 0.05 / P, float(np.abs(base).max())
    angles, velocities = np.zeros(60), np.zeros(60)
    angles[0] = side * 0.6 * ALPHA
    whole = linear.whole_sample(side, ALPHA, P, dt, largest)
    reached = linear.undisturbed(angles, velocities, base, 0, False, (ALPHA, ALPHA), whole)
    angle, velocity = angles[0], velocities[0]
    for sample in range(reached):
        step = closed_step(base, dt, 0.0, angle, velocity, side, largest, sample)
        assert not step.has_landed
        angle, velocity = step.angle, step.velocity
        assert (angles[sample + 1], velocities[sample + 1]) == pytest.approx((angle, velocity), abs=1e-12)
    assert reached > 10
    # Where it stops, the block is about to land.
    assert side * angle < 0.1 * ALPHA


def test_at_rest_it_stays_until_the_base_pulls_harder_than_alpha():
    base = ALPHA * np.array([0.0, 0.9, -0.9, 1.0, 1.1, 0.0])
    whole = linear.whole_sample(RIGHT, ALPHA, P, 0.01, float(base.max()))
    rest = np.zeros(6), np.zeros(6)
    assert linear.undisturbed(*rest, base, 0, True, (ALPHA, ALPHA), whole) == 3
    assert linear.undisturbed(*rest, base, 4, True, (ALPHA, ALPHA), whole) == 4


def test_past_return_it_falls_by_the_equation_until_it_lies():
    count, step = 80, 0.1
    angles, velocities = np.zeros(count), np.zeros(count)
    angles[0], velocities[0] = 1.1 * ALPHA, 0.0
    last = linear.fall(angles, velocities, 0, np.zeros(count), step / P, 1, ALPHA, P)
    np.testing.assert_allclose(angles[: last + 1], ALPHA * (1 + 0.1 * np.cosh(step * np.arange(last + 1))), rtol=1e-10)
    assert angles[last - 1] < np.pi / 2 <= angles[last]
    assert linear.fall(angles, velocities, 0, np.zeros(5), step / P, 1, ALPHA, P) == 5
