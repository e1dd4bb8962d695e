"""Whole samples that are passed over against single arcs."""

import numpy as np
import pytest

from colonnade.dynamics.plane import arc, series, sides
from colonnade.dynamics.plane.arc import follow
from colonnade.dynamics.plane.series import Push
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(arc, series, sides)


@pytest.mark.parametrize("step", [0.05, 0.4])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_samples_in_which_nothing_happens_are_passed_over_to_the_same_state(side, step):
    base = ALPHA * 0.3 * np.sin(np.arange(60.0))
    angles, velocities = np.zeros(60), np.zeros(60)
    angles[0] = side * 0.6 * ALPHA
    whole = sides.whole_sample(side, ALPHA, P, step / P, float(np.abs(base).max()))
    reached = sides.undisturbed(angles, velocities, base, 0, False, (ALPHA, ALPHA), whole)
    height, rate = 0.6 * ALPHA, 0.0
    for sample in range(reached):
        push = Push(side * base[sample], side * (base[sample + 1] - base[sample]) / step, 1.0, 0.0, 0.0, 1.0, 0.0)
        landed, x, height, rate, *_ = follow(height, rate, ALPHA, push, step, False, None)
        assert (landed, x) == (False, step)
        found = side * angles[sample + 1], side * velocities[sample + 1] / P
        assert found == pytest.approx((height, rate), abs=1e-13)
    assert reached >= 2
    if step < 0.1:  # where it stops, the block is about to land
        assert height < 0.1 * ALPHA


def test_at_rest_it_stays_until_the_base_pulls_harder_than_alpha():
    base = ALPHA * np.array([0.0, 0.9, -0.9, 1.0, 1.1, 0.0])
    whole = sides.whole_sample(1.0, ALPHA, P, 0.01, float(base.max()))
    rest = np.zeros(6), np.zeros(6)
    assert sides.undisturbed(*rest, base, 0, True, (ALPHA, ALPHA), whole) == 3
    assert sides.undisturbed(*rest, base, 4, True, (ALPHA, ALPHA), whole) == 4
