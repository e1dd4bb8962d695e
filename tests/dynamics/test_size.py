"""Volumes of bodies."""

from math import pi

import pytest

from colonnade.dynamics.size import cone_volume


def test_volumes_are_those_of_the_formulas():
    assert cone_volume(2.0, 2.0, 3.0) == pytest.approx(3.0 * pi)  # a cylinder
    assert cone_volume(2.0, 0.0, 3.0) == pytest.approx(pi)  # a third of it
