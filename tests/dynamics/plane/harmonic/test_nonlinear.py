"""One arc of the full equation under a sine against SciPy's DOP853, and the march through a sine."""

from math import cos, pi, sin

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane import landing
from colonnade.dynamics.plane.harmonic import nonlinear as harmonic_nonlinear
from colonnade.dynamics.plane.harmonic.motion import Harmonic, harmonic_outcomes, harmonic_run
from colonnade.dynamics.plane.harmonic.nonlinear import empty_series
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA, P, OMEGA = 0.2, 4.0, 11.0
STEADY = 0.3, 0.0
RISING = 0.1, 0.8
"""Level of a/g where an arc begins and its slope, 1/s."""


@pytest.fixture
def as_python(interpreted):
    interpreted(harmonic_nonlinear, landing)


def arc(height, rate, *, side=1.0, angle=0.4, level=STEADY, remaining=0.5, top=False):
    return harmonic_nonlinear.series_arc(
        height, rate, side, ALPHA, P, OMEGA, angle, *level, remaining, top, empty_series()
    )


def integrated(height, rate, x, *, side=1.0, angle=0.4, level=STEADY, times=None):
    """u'' = sin u + q sin φ cos u by SciPy, as h = α − u and its rate in x = p t."""

    def rates(x, state):
        q = side * (level[0] + level[1] * x / P)
        lean = ALPHA - state[0]
        return [state[1], -sin(lean) - q * sin(angle + OMEGA / P * x) * cos(lean)]

    found = solve_ivp(rates, (0.0, x), [height, rate], method="DOP853", rtol=1e-13, atol=1e-16, t_eval=times)
    return found.y if times is not None else found.y[:, -1]


@pytest.mark.usefixtures("as_python")
@pytest.mark.parametrize("level", [STEADY, RISING], ids=["steady", "rising"])
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize(("height", "rate"), [(0.15, 0.0), (0.1, 0.05), (0.0, 0.1)])
def test_an_arc_is_that_of_another_integrator(level, side, height, rate):
    landed, x, _, last, speed = arc(height, rate, side=side, level=level)
    np.testing.assert_allclose((last, speed), integrated(height, rate, x, side=side, level=level), atol=1e-12)
    assert landed == (last == 0.0)
    assert 0.0 < x <= 0.5


@pytest.mark.usefixtures("as_python")
def test_an_impact_is_where_the_height_first_comes_to_nothing():
    landed, x, _, last, speed = arc(0.05, -0.2, angle=0.5 * pi)
    assert landed
    assert last == 0.0
    heights = integrated(0.05, -0.2, x, angle=0.5 * pi, times=np.linspace(0.0, x, 50))[0]
    assert heights[-1] == pytest.approx(0.0, abs=1e-12)
    assert (heights[:-1] > 0.0).all()
    assert speed < 0.0


@pytest.mark.usefixtures("as_python")
def test_a_block_on_the_table_that_moves_down_has_landed_at_once():
    landed, x, _, _, speed = arc(0.0, -0.1)
    assert (landed, x, speed) == (True, 0.0, -0.1)


@pytest.mark.usefixtures("as_python")
def test_the_top_inside_an_arc_is_given_where_it_is_asked_for():
    given = {"angle": 0.5 * pi, "remaining": 0.4}
    _, x, top, last, speed = arc(0.1, 0.05, top=True, **given)
    assert speed < 0.0
    heights = integrated(0.1, 0.05, x, angle=0.5 * pi, times=np.linspace(0.0, x, 2001))[0]
    assert top == pytest.approx(heights.max(), rel=1e-7)
    assert arc(0.1, 0.05, **given)[2] == last < top


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_harmonic_run_is_that_of_the_sampled_motion(model):
    motion = Harmonic.cycles(4.0 * PRISM.p, 5.0)
    time = np.linspace(0.0, motion.edges[2], 20_001)
    base = 1.3 * PRISM.uplift_acceleration * np.sin(motion.omega * time)
    sampled = rock(PRISM, Motion(base, time[1]), restitution=0.9, model=model)
    run = harmonic_run(PRISM, motion, 1.3, 0.9, model=model, samples=200, interval=100 * time[1])
    np.testing.assert_allclose(run.angle, sampled.angle[:20_000:100], atol=1e-6 * PRISM.critical_angle)
    np.testing.assert_allclose(run.impact_times, sampled.impact_times[: run.impact_times.size], atol=1e-6)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_outcomes_of_many_amplitudes_are_those_of_single_runs(model):
    motion = Harmonic.cycles(3.0 * PRISM.p, 4.0, ramp=1.0)
    amplitudes = np.linspace(0.5, 6.0, 12)
    codes = harmonic_outcomes(PRISM, motion, amplitudes, (0.9, 0.9), model)
    single = [harmonic_run(PRISM, motion, float(a), 0.9, model=model).outcome for a in amplitudes]
    assert [("no-rocking", "rocking", "overturned")[code] for code in codes] == single
