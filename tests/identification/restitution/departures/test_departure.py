"""What a departure is by itself, and that its names are those of the functions that find it."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace

import pytest

from colonnade.identification.restitution.departures import first_cycles, single_impacts
from colonnade.identification.restitution.departures.departure import Departure

FOUND = Departure("sliding", 1e-4, 1e-6, "m", "The block slides.")


def test_a_departure_leaves_nothing_out_and_refuses_nothing_unless_it_says_so():
    assert (FOUND.left_out, FOUND.refuses) == (0, False)


def test_a_departure_cannot_be_changed_and_equals_one_of_the_same_content():
    with pytest.raises(FrozenInstanceError):
        FOUND.size = 0.0
    assert replace(FOUND) == FOUND
    assert replace(FOUND, left_out=1) != FOUND


@pytest.mark.parametrize("name", [first_cycles.NAME, single_impacts.NAME, single_impacts.MOVING])
def test_names_that_are_given_are_described(name):
    assert f'"{name}"' in Departure.__doc__
