"""Names of columns and files in the languages of the laboratories, and the ids and lines made of them."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.draft.words import axis, comment, find, line, unique
from colonnade.campaign.syntax.document import toml_key
from colonnade.campaign.syntax.names import clashes, identifier
from every import every


def meaning(name, about):
    found = find(name, about)
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
    assert (meaning(name, "quantities"), meaning(name, "places")) == (quantity, place)


KINDS = {
    "free-vibration": ("free-01", "Freie_Schwingung_2"),
    "sine": ("sinewave-test1", "SINUS 3Hz"),
    "earthquake": ("El_Centro_x1.5", "Span-2.0", "sisma03", "Erdbeben 4"),
    "noise": ("white-noise",),
    "pulse": ("ricker",),
    None: ("test 12",),
}


@every(("name", "kind"), [(name, kind) for kind, names in KINDS.items() for name in names])
def test_a_files_name_tells_the_kind_of_test(name, kind):
    assert meaning(name, "kinds") == kind


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("ACC_X", "x"),
        ("AccZ 2", "z"),
        ("ay", "y"),
        ("LVDT 1", None),
        ("max", None),
        ("Besch. vertikal", "z"),
        ("BO.AOM001..UD", "z"),
        ("cloud", None),
    ],
)
def test_a_name_tells_the_axis(name, expected):
    assert axis(name) == expected


@given(st.lists(st.text(), max_size=8))
def test_ids_are_valid_and_differ(names):
    ids = unique(names, "test", as_variables=True)
    assert [identifier(each) for each in ids] == ids
    assert not clashes(ids, as_variables=True)


TEXT = st.text(st.characters(exclude_categories=("Cs",)))


@given(name=TEXT.filter(bool), content=TEXT, said=TEXT)
def test_every_line_reads_back(name, content, said):
    text = f"{comment(said)}\n{line(toml_key(name), {name: content}, said, said)}\n"
    assert tomllib.loads(text) == {name: {name: content}}
