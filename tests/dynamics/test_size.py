"""Lengths in other units than metres show in the density of a block."""

from math import pi

import pytest

from colonnade.dynamics.size import cone_volume, is_likely, mistaken_lengths

STEEL, MARBLE = 7850.0, 2700.0


def test_volumes_are_those_of_the_formulas():
    assert cone_volume(2.0, 2.0, 3.0) == pytest.approx(3.0 * pi)  # a cylinder
    assert cone_volume(2.0, 0.0, 3.0) == pytest.approx(pi)  # a third of it


@pytest.mark.parametrize(("density", "likely"), [(99.0, False), (100.0, True), (MARBLE, True), (23_001.0, False)])
def test_what_blocks_are_made_of(density, likely):
    assert is_likely(density) == likely


@pytest.mark.parametrize("density", [STEEL, MARBLE])
@pytest.mark.parametrize(("unit", "factor"), [("mm", 1e3), ("cm", 1e2)])
def test_three_lengths_in_another_unit_are_found(density, unit, factor):
    assert mistaken_lengths(density / factor**3) == (unit, 3)


def test_one_length_in_millimetres_is_found():
    assert mistaken_lengths(STEEL / 1e3) == ("mm", 1)


def test_what_no_unit_explains_is_left_open():
    assert mistaken_lengths(1e12) == ("", 0)
    assert mistaken_lengths(STEEL) == ("", 0)
