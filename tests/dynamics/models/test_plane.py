"""Each model in the plane solves the equation that it names."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.models.linear import LINEAR
from colonnade.dynamics.models.model import Case
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.motion import Motion

PRISM = Block.prism(width=0.2, depth=0.2, height=0.5, mass=50.0)
ALPHA, P = PRISM.critical_angle, PRISM.p
STEP = 1e-3
TIME = np.arange(0.0, 0.3, STEP)
PULL = 0.1 * np.sin(9.0 * TIME)
EQUATIONS = {
    LINEAR: lambda angle: P**2 * (angle - ALPHA - PULL),
    NONLINEAR: lambda angle: -(P**2) * (np.sin(ALPHA - angle) + PULL * np.cos(ALPHA - angle)),
}


@pytest.mark.parametrize("model", EQUATIONS, ids=lambda model: model.name)
def test_its_run_solves_its_equation(model):
    case = Case(PRISM, Motion(PULL * PRISM.gravity, STEP), 0.9, 0.8 * ALPHA, 0.0, None, 1e-6, None, 0.0)
    angle = model.run(case).angle
    assert (angle > 0.0).all()
    bend = (angle[2:] - 2 * angle[1:-1] + angle[:-2]) / STEP**2
    expected = EQUATIONS[model](angle)[1:-1]
    np.testing.assert_allclose(bend, expected, atol=1e-5 * np.abs(expected).max())
