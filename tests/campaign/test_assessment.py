"""[assessments.<name>], and the real column that it needs."""

import re

import pytest
from pydantic import ValidationError

from colonnade.campaign.assessment import Prototype
from colonnade.errors import CampaignError
from every import every

COLUMN = '\n[prototype.prism]\nrestitution = "identified"\n'
ASKED = '\n[assessments.site]\nspecimen = "prism"\nrecords = "records"\n'


def test_an_assessment_has_defaults_and_paths_within_the_campaign(load_text, contract, tmp_path):
    campaign = load_text(contract + COLUMN + ASKED + 'hazard = "records/hazard.csv"\n')
    asked = campaign.assessments["site"]
    assert asked.records == tmp_path / "records"
    assert (asked.measure, asked.model, asked.draws, asked.overturned) == ("pgv", "nonlinear", 8, 1.0)
    assert asked.levels_in_si() is None
    assert campaign.prototype["prism"].restitution == "identified"
    assert asked.hazard == tmp_path / "records" / "hazard.csv"


@pytest.mark.parametrize(
    ("added", "words"),
    [
        (ASKED, "[prototype.prism] is missing."),
        (COLUMN + ASKED.replace('"prism"', '"prsm"'), 'Unknown specimen "prsm". Did you mean "prism"?'),
        (COLUMN.replace("prism", "statue2"), 'Unknown specimen "statue2".'),
        (COLUMN + ASKED.replace('"records"', '"/etc"'), "is an absolute path"),
        (COLUMN + ASKED + "draws = 0\n", "It should be greater than or equal to 1: draws of e"),
        (COLUMN + ASKED + 'model = "contact"\n', '"contact" was found.'),
        (COLUMN + ASKED + 'measure = "pvg"\n', 'Unknown measure of intensity "pvg". Did you mean "pgv"?'),
        (COLUMN + ASKED + 'measure = "d5_95"\n', "does not grow with a motion"),
        (COLUMN + ASKED + 'baseline = "liner"\n', 'Unknown baseline correction "liner". Did you mean "linear"?'),
        (COLUMN + ASKED + 'levels = ["0.2 g"]\n', "A velocity was expected"),
        (COLUMN + ASKED + "levels = []\n", "It should have at least 1 item"),
    ],
)
def test_what_is_wrong_is_refused_with_its_place(load_text, contract, added, words):
    with pytest.raises(CampaignError, match=re.escape(words)):
        load_text(contract + added)


def test_values_and_limits_become_si():
    written = {"restitution": "identified", "restitution_range": [0.93, 0.97], "critical_angle": "10 deg"}
    prototype = Prototype.model_validate(written | {"p": "1.26 rad/s", "p_range": ["1.2 rad/s", "75 deg/s"]})
    assert prototype.restitution == "identified"
    assert prototype.restitution_range == (0.93, 0.97)
    assert prototype.critical_angle == pytest.approx(0.174533, abs=1e-6)
    assert prototype.p_range == pytest.approx((1.2, 1.308997))
    assert prototype.friction is None


@every(
    ("written", "place", "words"),
    [
        ({}, "restitution", "It is missing."),
        ({"restitution": "guessed"}, "restitution", 'Or "identified", "rigid-body".'),
        ({"restitution": 1.2}, "restitution", "It should be less than or equal to 1"),
        ({"restitution": 0.95, "restitution_range": [0.97, 0.93]}, "restitution_range", "has to be the larger one"),
        ({"restitution": 0.9, "restitution_range": [0.93, 0.97]}, "restitution_range", "do not hold restitution = 0.9"),
        ({"restitution": 0.9, "critical_angle": 0.18}, "critical_angle", "has no unit"),
        ({"restitution": 0.9, "p": "1.26 Hz"}, "p", "angular velocity was expected"),
    ],
)
def test_what_is_wrong_is_said_at_its_key(written, place, words):
    with pytest.raises(ValidationError) as refused:
        Prototype.model_validate(written)
    (found,) = refused.value.errors()
    assert found["loc"] == (place,)
    assert words in found["msg"]
