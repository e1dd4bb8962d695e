"""Names of columns and files in the languages of the laboratories."""

from __future__ import annotations

import pytest

from colonnade.campaign.draft.vocabulary import KINDS, PLACES, QUANTITIES, axis, find, words
from every import every


def meaning(name, meanings):
    found = find(words(name), meanings)
    return found and found[0]


@every(
    ("name", "quantity", "place"),
    [
        ("LVDT 1", "displacement", None),
        ("Laser top", "displacement", "specimen"),
        ("Tischweg", "displacement", "table"),
        ("Weg oben", "displacement", "specimen"),
        ("Beschleunigung Säule", "acceleration", "specimen"),
        ("Tischbeschl.", "acceleration", "table"),
        ("tableAccX", "acceleration", "table"),
        ("ACC_X", "acceleration", None),
        ("Spostamento tavola", "displacement", "table"),
        ("Accelerazione colonna", "acceleration", "specimen"),
        ("Μετατόπιση τράπεζας", "displacement", "table"),
        ("epitachynsi", "acceleration", None),
        ("Block accel 26430", "acceleration", "specimen"),
        ("Gyro Y", "angular_velocity", None),
        ("Kraft", "force", None),
        ("Voltage_27", None, None),
        ("impact", None, None),
    ],
)
def test_a_name_tells_quantity_and_place(name, quantity, place):
    assert (meaning(name, QUANTITIES), meaning(name, PLACES)) == (quantity, place)


@every(
    ("name", "kind"),
    [
        ("free-01", "free-vibration"),
        ("Freie_Schwingung_2", "free-vibration"),
        ("sinewave-test1", "sine"),
        ("SINUS 3Hz", "sine"),
        ("El_Centro_x1.5", "earthquake"),
        ("Span-2.0", "earthquake"),
        ("sisma03", "earthquake"),
        ("Erdbeben 4", "earthquake"),
        ("white-noise", "noise"),
        ("ricker", "pulse"),
        ("test 12", None),
    ],
)
def test_a_files_name_tells_the_kind_of_test(name, kind):
    assert meaning(name, KINDS) == kind


@pytest.mark.parametrize(
    ("name", "expected"), [("ACC_X", "x"), ("AccZ 2", "z"), ("ay", "y"), ("LVDT 1", None), ("max", None)]
)
def test_a_name_tells_the_axis(name, expected):
    assert axis(name) == expected
