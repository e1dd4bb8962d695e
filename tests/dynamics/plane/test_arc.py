"""One arc, in closed form and by series, under a sine and between two samples, against SciPy's DOP853 and textbooks."""

from math import acosh, cos, cosh, pi, sin, sinh, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.plane import arc, sides
from colonnade.dynamics.plane.arc import LONGEST_STEP, Push, empty_series, follow, verdict
from every import every
from prism import PRISM

ALPHA, RATIO = 0.2, 2.75
STEADY, RISING = (0.3, 0.0), (0.1, 0.2)
"""Level of a/g where an arc begins and its slope in x."""
MODELS = {"linear": None, "nonlinear": empty_series(), "linearised": empty_series(True)}


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(arc, sides)


def followed(model, height, rate, *, angle=0.4, level=STEADY, ratio=RATIO, weight=(1.0, 0.0), remaining=2.0, top=False):
    push = Push(*level, *weight, ratio, sin(angle), cos(angle))
    return follow(height, rate, ALPHA, push, remaining, top, MODELS[model])


def integrated(model, height, rate, x, *, angle=0.4, level=STEADY, ratio=RATIO, weight=(1.0, 0.0), times=None):
    """h and h' in x = p t by SciPy."""

    def rates(x, state):
        q, lean = (level[0] + level[1] * x) * sin(angle + ratio * x), ALPHA - state[0]
        held = weight[0] + weight[1] * x
        return [state[1], -held * sin(lean) - q * cos(lean) if model == "nonlinear" else -held * lean - q]

    found = solve_ivp(rates, (0.0, x), [height, rate], method="DOP853", rtol=1e-13, atol=1e-16, t_eval=times)
    return found.y if times is not None else found.y[:, -1]


FORCES = {
    "a steady sine": {"level": STEADY},
    "a rising sine": {"level": RISING},
    "its other side": {"level": (-0.3, 0.0)},
    "between two samples": {"level": RISING, "ratio": 0.0, "angle": pi / 2},
}


@every("model", MODELS)
@every("force", FORCES.values(), ids=FORCES)
@every(("height", "rate"), [(0.15, 0.0), (0.1, 0.05), (0.0, 0.1)])
def test_an_arc_is_that_of_another_integrator(model, force, height, rate):
    landed, x, last, speed, _, _, sine, cosine = followed(model, height, rate, **force)
    np.testing.assert_allclose((last, speed), integrated(model, height, rate, x, **force), atol=1e-12)
    assert 0.0 < x <= 2.0
    assert landed == (last == 0.0)
    if model == "linear":
        turned = force.get("angle", 0.4) + force.get("ratio", RATIO) * x
        assert (sine, cosine) == pytest.approx((sin(turned), cos(turned)), abs=1e-13)


@pytest.mark.parametrize("model", ["nonlinear", "linearised"])
def test_a_weight_that_changes_is_followed(model):
    given = {"level": RISING, "ratio": 0.0, "angle": pi / 2, "weight": (0.7, 0.4)}
    _, x, last, speed, *_ = followed(model, 0.15, 0.02, remaining=0.5, **given)
    np.testing.assert_allclose((last, speed), integrated(model, 0.15, 0.02, x, **given), atol=1e-13)


@every("ratio", [1e-4, 0.2, 0.5, 0.7])
def test_let_go_it_lands_after_housners_quarter_period(ratio):
    landed, x, _, speed, *_ = followed("linear", ratio * ALPHA, 0.0, level=(0.0, 0.0), ratio=0.0)
    if landed:
        assert x == pytest.approx(acosh(1 / (1 - ratio)), rel=1e-12)
        assert speed == pytest.approx(-ALPHA * sqrt(1 - (1 - ratio) ** 2), rel=1e-12)
    assert landed == (acosh(1 / (1 - ratio)) < LONGEST_STEP)


def test_the_end_of_a_sample_may_begin_inside_it_and_short_arcs_keep_their_digits():
    """Where a/g rises steeply, h = α + (h₀ − α − q) cosh x + ... hides the little that happens."""
    steep = {"ratio": 0.0, "angle": pi / 2}
    whole = followed("linear", 0.0, 0.0, level=(-ALPHA, -300.0), remaining=1e-3, **steep)
    assert whole[2:4] == pytest.approx((300.0 * (1e-9 / 6 + 1e-15 / 120), 300.0 * (1e-6 / 2 + 1e-12 / 24)), rel=1e-12)
    half = followed("linear", 0.0, 0.0, level=(-ALPHA, -300.0), remaining=5e-4, **steep)
    rest = followed("linear", half[2], half[3], level=(-ALPHA - 0.15, -300.0), remaining=5e-4, **steep)
    assert rest[2:4] == pytest.approx(whole[2:4], rel=1e-11)


@every("model", MODELS)
def test_an_impact_is_where_the_height_first_comes_to_nothing(model):
    landed, x, last, speed, *_ = followed(model, 0.05, -0.2, angle=pi / 2)
    assert landed
    assert last == 0.0
    heights = integrated(model, 0.05, -0.2, x, angle=pi / 2, times=np.linspace(0.0, x, 50))[0]
    assert heights[-1] == pytest.approx(0.0, abs=1e-12)
    assert (heights[:-1] > 0.0).all()
    assert speed < 0.0


@every("model", MODELS)
def test_a_block_on_the_table_that_moves_down_has_landed_at_once(model):
    assert followed(model, 0.0, -0.1)[:4] == (True, 0.0, 0.0, -0.1)


@every("model", MODELS)
def test_the_top_inside_an_arc_is_given_where_it_is_asked_for(model):
    given = {"angle": pi / 2, "remaining": 0.4}
    _, x, last, speed, top, *_ = followed(model, 0.1, 0.05, top=True, **given)
    assert speed < 0.0
    heights = integrated(model, 0.1, 0.05, x, angle=pi / 2, times=np.linspace(0.0, x, 2001))[0]
    assert top == pytest.approx(heights.max(), rel=1e-7)
    assert followed(model, 0.1, 0.05, **given)[4] == last < top


def test_where_it_passes_alpha_is_given():
    """θ − α = α (−0.1 cosh x + 0.5 sinh x) is 0 at tanh x = 0.2."""
    still = {"level": (0.0, 0.0), "remaining": 1.0}
    assert followed("linear", 0.9 * ALPHA, 0.5 * ALPHA, **still)[5] == pytest.approx(np.arctanh(0.2), rel=1e-12)
    assert np.isnan(followed("linear", 1.1 * ALPHA, 0.5 * ALPHA, **still)[5])
    assert np.isnan(followed("linear", 0.5 * ALPHA, 0.1 * ALPHA, **still)[5])


@pytest.mark.parametrize("x", [1e-6, 1e-3, 0.3, LONGEST_STEP])
def test_ten_terms_are_the_functions_to_rounding_up_to_the_longest_step(x):
    excess, rise = arc.excess_rise(x * x)
    assert 1 + excess == pytest.approx(sinh(x) / x, rel=1e-15)
    assert rise == pytest.approx(2 * sinh(x / 2) ** 2 / x**2, rel=1e-15)
    assert x * x * rise == pytest.approx(cosh(x) - 1, rel=1e-3 if x < 1e-5 else 1e-9)
    excess, rise = arc.excess_rise(-x * x)
    assert 1 + excess == pytest.approx(sin(x) / x, rel=1e-15)
    assert rise == pytest.approx(2 * sin(x / 2) ** 2 / x**2, rel=1e-15)


@pytest.mark.parametrize(
    ("start", "end", "told"),
    [
        ((1.0, 0.1, -0.2, 0.0), (0.9, -0.3, -0.2, 0.0), 1),
        ((0.1, -0.5, -0.1, 0.0), (-0.4, -0.6, -0.1, 0.0), -1),
        ((0.01, -0.5, 5.0, 0.0), (0.02, 0.5, 5.0, 0.0), 0),
    ],
    ids=["high above", "falls through", "close to the base"],
)
def test_a_verdict_on_a_piece(start, end, told):
    assert verdict(1.0, start, end, 0.1, 0.1) == told


LEAN, P = PRISM.critical_angle, PRISM.p


@pytest.mark.parametrize("step", [0.05, 0.4])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_samples_in_which_nothing_happens_are_passed_over_to_the_same_state(side, step):
    base = LEAN * 0.3 * np.sin(np.arange(60.0))
    angles, velocities = np.zeros(60), np.zeros(60)
    angles[0] = side * 0.6 * LEAN
    whole = sides.whole_sample(side, LEAN, P, step / P, float(np.abs(base).max()))
    reached = sides.pass_over(angles, velocities, base, 0, whole)
    height, rate = 0.6 * LEAN, 0.0
    for sample in range(reached):
        push = Push(side * base[sample], side * (base[sample + 1] - base[sample]) / step, 1.0, 0.0, 0.0, 1.0, 0.0)
        landed, x, height, rate, *_ = follow(height, rate, LEAN, push, step, False, None)
        assert (landed, x) == (False, step)
        found = side * angles[sample + 1], side * velocities[sample + 1] / P
        assert found == pytest.approx((height, rate), abs=1e-13)
    assert reached >= 2
    if step < 0.1:  # where it stops, the block is about to land
        assert height < 0.1 * LEAN


def test_at_rest_it_stays_until_the_base_pulls_harder_than_alpha():
    base = LEAN * np.array([0.0, 0.9, -0.9, 1.0, 1.1, 0.0])
    assert sides.stay(base, 0, (LEAN, LEAN)) == 3
    assert sides.stay(base, 4, (LEAN, LEAN)) == 4
