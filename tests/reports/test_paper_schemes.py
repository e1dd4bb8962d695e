"""The paper's step-by-step schemes beside the exact solution of their equation."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from paper_schemes import rock_by_steps
from prism import PRISM

pytestmark = pytest.mark.whole

ALPHA = PRISM.critical_angle
SCHEMES = ("runge-kutta", "hamming")
RELEASED = {"restitution": 0.976, "theta0": 0.5 * ALPHA}
STILL = Motion(np.zeros(201), 0.01)


def _error(scheme, steps, refinement, until=None):
    exact = rock(PRISM, STILL, **RELEASED)
    ours = rock_by_steps(PRISM, STILL, scheme=scheme, steps_per_sample=steps, refinement=refinement, **RELEASED)
    before = exact.time < (exact.impact_times[0] if until == "impact" else np.inf)
    return np.abs(ours.angle - exact.angle)[before].max() / ALPHA


@pytest.mark.parametrize("scheme", SCHEMES)
def test_up_to_the_first_impact_the_order_is_at_least_four(scheme):
    coarse, fine = (_error(scheme, steps, 1, "impact") for steps in (1, 2))
    assert coarse < 1e-6
    assert coarse / fine > 2**3.8


@pytest.mark.parametrize("scheme", SCHEMES)
def test_over_impacts_the_order_is_one_and_refinement_divides_the_error(scheme):
    errors = {
        (steps, refinement): _error(scheme, steps, refinement)
        for steps in (50, 100, 200, 400)
        for refinement in (1, 10)
    }
    for refinement in (1, 10):
        sequence = [errors[steps, refinement] for steps in (50, 100, 200, 400)]
        assert 5 < sequence[0] / sequence[-1] < 13
    ratio = np.mean([errors[steps, 1] / errors[steps, 10] for steps in (50, 100, 200, 400)])
    assert 6 < ratio < 16


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_block_past_return_lies_and_one_below_the_threshold_stays(scheme):
    fallen = rock_by_steps(PRISM, STILL, scheme=scheme, steps_per_sample=10, theta0=1.05 * ALPHA)
    assert fallen.outcome == "overturned"
    assert fallen.angle[-1] == pytest.approx(np.pi / 2)
    below = Motion(np.full(50, PRISM.gravity * ALPHA), 0.01)
    assert np.abs(rock_by_steps(PRISM, below, scheme=scheme, steps_per_sample=10).angle).max() == 0.0
