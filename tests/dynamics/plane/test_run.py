"""One run of a plane model: what it refuses, and the law of restitution that reaches as far as the run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.models.linear import LINEAR
from colonnade.dynamics.models.model import Case
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import LARGEST_ACCELERATION, LONGEST_SAMPLE, run
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
CASE = Case(PRISM, None, 0.9, 0.5 * ALPHA, 0.0, 2.0, 1e-6, None, 0.0)


def shaken(values, dt=0.01, **others):
    return replace(CASE, motion=Motion(np.array(values), dt, **others), theta0=0.0, duration=None)


@pytest.mark.parametrize("model", [LINEAR, NONLINEAR], ids=["linear", "nonlinear"])
def test_a_rebound_is_e_times_the_speed_before_it(model):
    history = run(model, CASE)
    assert history.model == model.name
    np.testing.assert_allclose(history.rebound_velocities, 0.9 * history.impact_velocities)
    assert history.impact_times.size >= 3


def test_each_side_has_its_own_e():
    history = run(LINEAR, replace(CASE, restitution=(0.95, 0.85)))
    expected = np.where(history.impact_velocities > 0, 0.95, 0.85)
    np.testing.assert_allclose(history.rebound_velocities / history.impact_velocities, expected)
    assert {0.95, 0.85} == set(expected)


def test_without_e_it_is_that_of_a_rigid_body():
    history = run(LINEAR, replace(CASE, restitution=None))
    assert history.rebound_velocities[0] / history.impact_velocities[0] == pytest.approx(PRISM.restitution)


def test_a_law_reaches_as_far_as_the_fastest_impact():
    """Thrown down ten times faster than it falls by itself: the law is asked there too, not held at its end."""
    case = replace(CASE, restitution=lambda speed: 1.0 / (1.0 + 0.1 * speed), omega0=-10 * ALPHA * P)
    history = run(LINEAR, case)
    speed = abs(history.impact_velocities[0])
    assert speed > 9 * ALPHA * P
    assert history.rebound_velocities[0] / history.impact_velocities[0] == pytest.approx(
        1 / (1 + 0.1 * speed), rel=1e-3
    )


@pytest.mark.parametrize(
    ("case", "message"),
    [
        (replace(CASE, out_of_plane=0.1), 'for models in space; the model is "linear"'),
        (replace(CASE, restitution=1.2), "restitution is 1.2; a number between 0 and 1"),
        (shaken([0.0, 1.1 * LARGEST_ACCELERATION * 9.81]), r"at sample 1; at most 1e\+06 g .* Check its unit"),
        (shaken([0.0, 1.0], 1.01 * LONGEST_SAMPLE / P), "a sampling interval below 300/p"),
        (shaken([0.0, 1.0], transverse=np.array([0.0, 1.0])), "a Motion without `transverse`"),
        (shaken([0.0, 1.0], vertical=np.array([0.0, -9.9])), "the base falls faster than the block"),
    ],
    ids=["space", "e", "acceleration", "interval", "transverse", "vertical"],
)
def test_what_the_plane_does_not_have_is_refused(case, message):
    with pytest.raises(ValueError, match=message):
        run(LINEAR, case)
