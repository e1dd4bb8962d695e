"""Restitution over the speed of the impact."""

import math

import numpy as np
import pytest

from colonnade.dynamics.rock import RestitutionLaw, rock
from prism import PRISM

RELEASED = {"theta0": 0.5 * PRISM.critical_angle, "duration": 3.0}


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_law_that_is_constant_is_the_constant(model):
    law = RestitutionLaw([0.0, 10.0], [0.9, 0.9])
    ours, constant = (rock(PRISM, restitution=e, model=model, **RELEASED) for e in (law, 0.9))
    np.testing.assert_array_equal(ours.angle, constant.angle)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_each_impact_loses_by_the_law_at_its_own_speed(model):
    law = RestitutionLaw([0.1, 0.4, 0.8], [0.99, 0.9, 0.7])
    history = rock(PRISM, restitution=law, model=model, **RELEASED)
    arriving = np.abs(history.impact_velocities)
    assert arriving[0] > 0.8
    assert arriving[-1] < 0.4
    # On a base at rest the next arrival has the speed of the last departure.
    kept = arriving[1:6] / arriving[:5]
    np.testing.assert_allclose(kept, np.interp(arriving[:5], [0.1, 0.4, 0.8], [0.99, 0.9, 0.7]), rtol=1e-9)


@pytest.mark.parametrize(
    ("speeds", "values", "words"),
    [
        ([0.0, 1.0], [0.9], "one for each of 2 speeds"),
        ([], [], "at least one number"),
        ([1.0, 0.5], [0.9, 0.9], "rising"),
        ([-1.0, 0.5], [0.9, 0.9], "rising"),
        ([0.0, math.nan], [0.9, 0.9], "speeds is not finite"),
        ([0.0, 1.0], [0.9, 1.1], "e at 1 rad/s is 1.1"),
        ([0.0, 1.0], [math.nan, 0.9], "values is not finite"),
    ],
)
def test_a_table_that_is_none_is_refused(speeds, values, words):
    with pytest.raises(ValueError, match=words):
        RestitutionLaw(speeds, values)
