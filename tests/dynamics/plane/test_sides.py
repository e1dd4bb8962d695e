"""What the kernels know of a block's two sides."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.plane.sides import sides_of
from colonnade.dynamics.restitution_law import RestitutionLaw

LOPSIDED = Block.measured(mass=80.0, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.15), inertia=(41.2, 40.0))


def test_each_side_has_its_own_angle_frequency_and_restitution():
    sides = sides_of(LOPSIDED, (0.9, 0.8), 1e-6)
    np.testing.assert_allclose(sides.critical, [0.21, 0.15])
    np.testing.assert_allclose(sides.p, np.sqrt([80 * 9.81 * 0.61 / 41.2, 80 * 9.81 * 0.60 / 40.0]))
    assert sides.restitution.ravel().tolist() == [0.9, 0.8]
    assert sides.rest_angle == 1e-6


def test_a_law_comes_with_its_speeds():
    sides = sides_of(LOPSIDED, RestitutionLaw.table([0.0, 2.0], [1.0, 0.8]), 0.0)
    assert sides.speeds.tolist() == pytest.approx([0.0, 2.0])
    assert set(sides.restitution.ravel()) == {1.0, 0.8}
