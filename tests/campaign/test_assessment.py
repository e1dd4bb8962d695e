"""[assessments.<name>], and the real column that it needs."""

import re

import pytest

from colonnade.errors import CampaignError

COLUMN = '\n[prototype.prism]\nrestitution = "identified"\n'
ASKED = '\n[assessments.site]\nspecimen = "prism"\nrecords = "records"\n'


def test_an_assessment_has_defaults_and_paths_within_the_campaign(load_text, contract, tmp_path):
    campaign = load_text(contract + COLUMN + ASKED + 'hazard = "records/hazard.csv"\n')
    asked = campaign.assessments["site"]
    assert asked.records == tmp_path / "records"
    assert (asked.measure, asked.model, asked.draws, asked.overturned) == ("pgv", "nonlinear", 8, 1.0)
    assert asked.levels_in_si() is None
    assert campaign.prototype["prism"].restitution == "identified"
    moved = campaign.with_relative_paths().assessments["site"]
    assert (str(moved.records), str(moved.hazard)) == ("records", "records/hazard.csv")


@pytest.mark.parametrize(
    ("added", "words"),
    [
        (ASKED, "[prototype.prism] is missing."),
        (COLUMN + ASKED.replace('"prism"', '"prsm"'), 'Unknown specimen "prsm". Did you mean "prism"?'),
        (COLUMN.replace("prism", "statue2"), 'Unknown specimen "statue2".'),
        (COLUMN + ASKED.replace('"records"', '"/etc"'), "is an absolute path"),
        (COLUMN + ASKED + "draws = 0\n", "A whole number from 1 to 1000 was expected."),
        (COLUMN + ASKED + 'model = "contact"\n', '"contact" was found.'),
        (COLUMN + ASKED + 'measure = "pvg"\n', 'Unknown measure of intensity "pvg". Did you mean "pgv"?'),
        (COLUMN + ASKED + 'measure = "d5_95"\n', "does not grow with a motion"),
        (COLUMN + ASKED + 'baseline = "liner"\n', 'Unknown baseline correction "liner". Did you mean "linear"?'),
        (COLUMN + ASKED + 'levels = ["0.2 g"]\n', "A velocity was expected"),
        (COLUMN + ASKED + "levels = []\n", "A list of 1 to 100 values was expected"),
    ],
)
def test_what_is_wrong_is_refused_with_its_place(load_text, contract, added, words):
    with pytest.raises(CampaignError, match=re.escape(words)):
        load_text(contract + added)
