"""What a block rocks about, laid out about the middle between its poles."""

from math import cos, sin

import pytest

from colonnade.dynamics.block import Block
from colonnade.figures.drawing.view import Rocking


def test_a_prism_rocks_about_the_edges_of_its_base():
    rocking = Rocking.of(Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.1))
    assert rocking.poles == pytest.approx((-0.043, 0.043))
    assert rocking.centre == pytest.approx((0.0, 0.228))


def test_the_centre_of_mass_is_nearer_to_the_pole_of_the_smaller_angle():
    block = Block.measured(mass=80, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.24), inertia=41.2)
    rocking = Rocking.of(block)
    (left, right), (x, z) = rocking.poles, rocking.centre
    assert x - left == pytest.approx(0.61 * sin(0.21))
    assert right - x == pytest.approx(0.60 * sin(0.24))
    assert left == -right
    assert z == pytest.approx((0.61 * cos(0.21) + 0.60 * cos(0.24)) / 2)
