"""A test of a campaign file: its raw files, its zero, its photos; what is wrong is said by its key; and motions."""

import re

import pytest
from pydantic import ValidationError

from colonnade.campaign import test as one_test
from colonnade.errors import CampaignError

LEAST = {"id": "free-01", "kind": "free-vibration", "specimen": "prism", "setup": "frame", "file": "raw/free-01.csv"}


@pytest.fixture
def made(tmp_path):
    return lambda **given: one_test.Test.model_validate(LEAST | given, context={"folder": tmp_path})


def test_what_is_not_given_is_not_known(made):
    test = made()
    assert test.zero == "auto"
    assert test.photos == ()
    assert {test.window, test.frequency, test.motion, test.span, test.time_scale, test.date, test.notes} == {None}


def test_a_single_file_is_that_of_the_main_recorder_in_the_folder_of_the_campaign(made, tmp_path):
    assert made().files == {"main": tmp_path / "raw" / "free-01.csv"}
    several = made(file={"main": "raw/a.csv", "daq2": "raw/b.tdms"}).files
    assert several == {"main": tmp_path / "raw" / "a.csv", "daq2": tmp_path / "raw" / "b.tdms"}


def test_a_photo_is_listed_once_and_not_looked_for(made):
    assert made(photos=["photos/b.jpg", " photos/a.jpg", "photos/b.jpg"]).photos == ("photos/b.jpg", "photos/a.jpg")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"kind": "erthquake"}, 'Did you mean "earthquake"'),
        ({"observed_outcome": "fallen"}, "overturned"),
        ({"zero": "begin"}, "auto"),
        ({"span": 0.0}, "span"),
        ({"file": "/etc/passwd"}, "/etc/passwd"),
        ({"file": "../elsewhere.csv"}, "elsewhere.csv"),
        ({"file": {"daq2": "raw/b.csv"}}, "A file of `main` was expected"),
        ({"file": {"main": "raw/a.csv", "daq2": "../b.csv", "daq3": "../c.csv"}}, "daq3"),
        ({"photos": "photos/a.jpg"}, "A list was expected: photos of it"),
    ],
    ids=["kind", "outcome", "zero", "span", "absolute path", "path out", "no main file", "several files", "photos"],
)
def test_what_cannot_be_used_is_refused(made, given, said):
    with pytest.raises(ValidationError, match=re.escape(said)):
        made(**given)


MOTIONS = """
[motions]
"El Centro 1940 NS" = "motions/elcentro.dat"
Valley = {file = "motions/valley.txt", interval = "10 ms", column = 2}
Fault = {file = "motions/fault.dat", layout = "running"}

[setups.frame]
"""


def _with(contract, motions):
    return contract.replace("[setups.frame]\n", motions.lstrip("\n"), 1)


def test_motions_are_known_by_name(contract, load_text, tmp_path):
    motions = load_text(_with(contract, MOTIONS)).motions
    assert list(motions) == ["El Centro 1940 NS", "Valley", "Fault"]
    assert (motions["Valley"].layout, motions["Fault"].layout) == (None, "running")
    assert motions["El Centro 1940 NS"].file.name == "elcentro.dat"
    assert motions["El Centro 1940 NS"].interval is None
    assert motions["Valley"].interval == pytest.approx(0.01)
    assert motions["Valley"].column == 2


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ('"../elcentro.dat"', "is outside the campaign's folder"),
        ("3", "A path from the folder of the campaign file was expected"),
        ('{file = "a.txt", dt = "0.02 s"}', "Unknown key"),
        ('{file = "a.txt", interval = 0.02}', "has no unit"),
        ('{interval = "0.02 s"}', "It is missing"),
    ],
)
def test_what_is_no_motion_is_refused_at_its_place(entry, told, contract, load_text):
    with pytest.raises(CampaignError, match=told) as caught:
        load_text(_with(contract, f"[motions]\nValley = {entry}\n\n[setups.frame]\n"))
    assert "motions.Valley" in str(caught.value)
