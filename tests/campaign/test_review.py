"""What review.toml may say, and what is told where it says something else."""

import json
import re
import tomllib
from pathlib import Path

import jsonschema
import pytest

from colonnade.campaign import load
from colonnade.campaign.forms.schema import json_schema
from colonnade.campaign.review import Exclude, Review, ReviewFile, decided
from colonnade.errors import CampaignError
from every import every

CAMPAIGN = """\
schema = 1
campaign = "small"
title = "Small"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame.channels]
top = {column = 1, quantity = "other"}
table = {column = 2, quantity = "acceleration", unit = "g", on = "table", direction = [1, 0, 0]}
"""
TEST = '[[tests]]\nid = "{0}"\nkind = "other"\nspecimen = "prism"\nsetup = "frame"\nfile = "{0}.csv"\n'
CORRECT = '[[correct]]\ntest = "free-01"\nchannel = "{}"\nfactor = {}\n'
TRIM = '[[trim]]\ntest = "free-01"\nwindow = {}\n'
SIGNED = 'who = "V. D."\nwhen = 2013-04-26\nwhy = "the video"\n'


@pytest.fixture
def reviewed(tmp_path):
    (tmp_path / "campaign.toml").write_text(CAMPAIGN + TEST.format("free-01") + TEST.format("free-02"), "utf-8")

    def read(text):
        (tmp_path / "review.toml").write_text(text, encoding="utf-8")
        return load(tmp_path)

    return read


def test_a_campaign_without_a_review_is_as_it_was(reviewed):
    campaign = reviewed("schema = 1\n")
    assert campaign.reviews == {}
    assert campaign.review("free-01") == Review()


def test_every_decision_is_read_with_who_when_and_why(reviewed):
    campaign = reviewed(
        f'schema = 1\n[[exclude]]\ntest = "free-02"\n{SIGNED}[[exclude]]\ntest = "free-01"\nchannel = "top"\n{SIGNED}'
        f'[[trim]]\ntest = ["free-01", "free-02"]\nwindow = ["2 s", "1 min"]\n{SIGNED}'
        f'[[flag]]\ntest = "free-01"\nchannel = "table"\nwindow = ["3.2 s", "3400 ms"]\nas = "suspect"\n{SIGNED}'
        f'[[correct]]\ntest = "free-01"\nchannel = "table"\nfactor = -1\n{SIGNED}'
    )
    first, second = campaign.review("free-01"), campaign.review("free-02")
    assert first.sentences == (
        "2013-04-26, V. D.: channel top excluded: the video",
        "2013-04-26, V. D.: only 2 s to 60 s used: the video",
        "2013-04-26, V. D.: channel table from 3.2 s to 3.4 s flagged as suspect: the video",
        "2013-04-26, V. D.: gain of channel table multiplied by -1: the video",
    )
    assert (first.window, first.factors, first.excluded) == ((2.0, 60.0), {"table": -1.0}, "")
    flags = [(each.channel, each.window, each.flag) for each in first.flags]
    assert flags == [("top", None, "fail"), ("table", (3.2, 3.4), "suspect")]
    assert second.excluded == "excluded by V. D. on 2013-04-26: the video"


def test_several_corrections_multiply_and_several_trims_leave_what_they_share(reviewed):
    entries = [CORRECT.format("table", -2)] * 2 + [TRIM.format(each) for each in ('["1 s", "9 s"]', '["3 s", "12 s"]')]
    review = reviewed("schema = 1\n" + "".join(f"{entry}{SIGNED}" for entry in entries)).review("free-01")
    assert review.factors == {"table": 4.0}
    assert review.window == (3.0, 9.0)


@every(
    ("entry", "told"),
    [
        ('[[exclude]]\ntest = "free-1"', r'line 3: exclude\[1\]\.test: .*Did you mean "free-01"'),
        (CORRECT.format("tabel", 2), r'line 4: correct\[1\]\.channel: .*Unknown channel .* of free-01.*mean "table"'),
        (CORRECT.format("top", 0), "To leave the channel out"),
        (TRIM.format('["5 s", "2 s"]'), "second has to be the larger"),
        ('[[flag]]\ntest = "free-01"\nchannel = "top"\nwindow = ["1 s", "2 s"]\nas = "bad"', '"suspect", "fail"'),
        ('[[trim]]\ntest = "free-01"', r"trim\[1\]\.window: It is missing"),
        ('[[exlude]]\ntest = "free-01"', r'exlude: Unknown key\. Did you mean "exclude"'),
        ('[[exclude]]\ntest = "free-01"\nchanel = "top"', 'Did you mean "channel"'),
        ("[[exclude]]\ntest = 3", "the test it is about, or a list of them"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(reviewed, entry, told):
    with pytest.raises(CampaignError, match=rf"(?s)^review\.toml.*{told}"):
        reviewed(f"schema = 1\n{entry}\n{SIGNED}")


@pytest.mark.parametrize("missing", ["who", "when", "why"])
def test_nobody_decides_without_saying_who_when_and_why(reviewed, missing):
    signed = "".join(line for line in SIGNED.splitlines(keepends=True) if not line.startswith(missing))
    with pytest.raises(CampaignError, match=rf"exclude\[1\]\.{missing}: It is missing"):
        reviewed(f'schema = 1\n[[exclude]]\ntest = "free-01"\n{signed}')


@pytest.mark.parametrize("text", ["schema = 2\n", "exclude = 3\nschema = 1", "this is no TOML", ""])
def test_a_damaged_review_is_a_problem_of_the_review_file(reviewed, text):
    with pytest.raises(CampaignError, match=r"^review\.toml"):
        reviewed(text)


def test_the_example_of_the_contract_is_a_review():
    page = (Path(__file__).parents[2] / "raw_schema" / "README.md").read_text(encoding="utf-8")
    example = tomllib.loads(re.findall(r"^```toml\n(schema.*?)^```$", page, re.MULTILINE | re.DOTALL)[0])
    review = ReviewFile.model_validate(example)
    assert [len(getattr(review, kind)) for kind in ("exclude", "trim", "flag", "correct")] == [2, 1, 1, 1]
    jsonschema.validate(json.loads(json.dumps(example, default=str)), json_schema("review"))


@every(
    ("trimmed", "window", "taken"),
    [
        (None, None, None),
        ((2.0, 9.0), None, (2.0, 9.0)),
        ((3.0, 4.0), (2.0, 9.0), (3.0, 4.0)),
        ((0.0, 5.0), (2.0, 9.0), (2.0, 5.0)),
    ],
)
def test_what_is_taken_is_what_both_windows_share(trimmed, window, taken):
    assert Review(window=trimmed).within(window) == taken


def test_the_first_who_excludes_a_test_is_named():
    given = [
        Exclude.model_construct(who=who, when="2013-04-26", why=why)
        for who, why in (("V. D.", "the video"), ("A. N.", "noise"))
    ]
    assert decided(given).excluded == "excluded by V. D. on 2013-04-26: the video"
    assert decided(given).sentences == (
        "2013-04-26, V. D.: test excluded: the video",
        "2013-04-26, A. N.: test excluded: noise",
    )
    assert decided([]) == Review()
