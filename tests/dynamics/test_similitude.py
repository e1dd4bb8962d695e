"""Prototype scale, held against the prototype computed as a block of its own."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.similitude import at_prototype

SCALE = 20.0
MODEL = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
PROTOTYPE = Block.prism(width=1.72, depth=1.72, height=9.12, mass=26.10 * SCALE**3)


@pytest.mark.parametrize(
    ("quantity", "name"), [("length", "pole_distance"), ("frequency", "p"), ("mass", "mass"), ("inertia", "inertia")]
)
def test_a_block_of_prototype_size_has_the_scaled_properties(quantity, name):
    assert at_prototype(quantity, getattr(MODEL, name), SCALE) == pytest.approx(getattr(PROTOTYPE, name), rel=1e-12)


def test_the_prototype_rocks_as_the_model_in_scaled_time():
    base = 1.8 * MODEL.uplift_acceleration * np.sin(2 * np.pi * 4 * np.arange(0, 3, 0.002))
    model = rock(MODEL, Motion(base, 0.002), restitution=0.9, model="nonlinear")
    prototype = rock(PROTOTYPE, Motion(base, at_prototype("time", 0.002, SCALE)), restitution=0.9, model="nonlinear")
    assert model.outcome == "rocking"
    np.testing.assert_allclose(prototype.angle, model.angle, atol=1e-9)


def test_gravity_is_the_same_for_both():
    assert at_prototype("acceleration", 9.81, SCALE) == 9.81
    assert at_prototype("velocity", 1.0, SCALE) == pytest.approx(
        at_prototype("length", 1.0, SCALE) / at_prototype("time", 1.0, SCALE)
    )


def test_an_unknown_quantity_or_scale_is_an_error():
    with pytest.raises(ValueError, match="is not a quantity that scales"):
        at_prototype("colour", 1.0, SCALE)
    with pytest.raises(ValueError, match="positive"):
        at_prototype("length", 1.0, 0.0)
