"""What a column is taken for: by its unit before its name, and never without a reason."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.campaign.draft.meaning import meaning
from colonnade.campaign.draft.signal import Shape
from colonnade.campaign.draft.survey import Column

MOVING = Shape(1.0, False, None, False)


def column(name: str, unit: str | None = None, shape: Shape = MOVING, *, is_clock: bool = False) -> Column:
    return Column(1, name, f"{name} [{unit}]", unit, is_clock, True, shape)


@pytest.mark.parametrize(
    ("name", "unit", "quantity", "because"),
    [
        ("LVDT 1", None, "displacement", 'from "lvdt" in its name'),
        ("Channel 3", "mm", "displacement", 'from its unit "mm"'),
        ("top", "g", "acceleration", 'from its unit "g"'),
        ("top", "V", None, ""),
    ],
)
def test_the_quantity_has_its_reason(name, unit, quantity, because):
    found = meaning(column(name, unit))
    assert (found.quantity, found.because, found.left_out) == (quantity, because, "")


def test_a_unit_and_a_name_that_contradict_each_other_are_both_told():
    found = meaning(column("LVDT 1", "g"))
    assert found.quantity == "acceleration"
    assert found.conflict == 'its unit "g" says acceleration, its name "lvdt" displacement'


def test_a_voltage_is_known_but_not_physical():
    found = meaning(column("LVDT 1", "V"))
    assert (found.unit_known, found.is_physical) == (True, False)
    assert not meaning(column("LVDT 1", "furlong")).unit_known


@pytest.mark.parametrize(
    ("each", "reason"),
    [
        (column("t", "s", is_clock=True), "the clock"),
        (column("LVDT 1", "mm", Shape(0.0, False, None, False)), "it never changes in any of these files"),
        (column("LVDT 1", "mm", Shape(np.nan, False, None, False)), "it holds no number in any of these files"),
        (column("n", None, Shape(9.0, True, None, False)), "a running number: it rises by one from sample to sample"),
        (column("Trigger"), 'a synchronisation signal, from "trigger" in its name'),
    ],
    ids=["clock", "constant", "empty", "counter", "trigger"],
)
def test_what_measures_nothing_is_left_out_with_the_reason(each, reason):
    assert meaning(each).left_out == reason


def test_the_place_and_the_axis_are_read_from_the_name():
    found = meaning(column("Tischweg X", "mm"))
    assert (found.place, found.place_word, found.axis) == ("table", 'from "tischweg" in its name', "x")
