"""Reference motions: by name, as a path or a table."""

from __future__ import annotations

import pytest

from colonnade.errors import CampaignError

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


def test_without_the_table_there_are_none(contract, load_text):
    assert load_text(contract).motions == {}


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
