"""Tests found by the names of raw files: the same in every command, and nothing that a stray file could break."""

import pytest

from colonnade.campaign import load
from colonnade.errors import CampaignError
from colonnade.findings import Severity

BASE = """
schema = 1
campaign = "small"
title = "Small"
[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}
cone = {shape = "cone", base_diameter = "97 mm", top_diameter = "75.5 mm", height = "480 mm", mass = "21.94 kg"}
[setups.frame]
[setups.frame.recorders.daq2]
[setups.frame.channels]
table = {column = "a", quantity = "acceleration", unit = "g", on = "table", direction = [1, 0, 0]}
"""
WATCH = """
[watch]
words = {free = "free-vibration", EC = "El Centro 1940 NS"}
pattern = [
    "{specimen}-{kind}-{number}.csv",
    {file = "{specimen}-{motion}-{span}.csv", kind = "earthquake", operator = "M. Rossi, {specimen}"},
    "{specimen}-{kind}-{number}-{recorder}.csv",
]
"""

ENTRY = '[[tests]]\nid = "{}"\nkind = "other"\nspecimen = "cone"\nsetup = "frame"\nfile = "raw/{}.csv"\n'


@pytest.fixture
def with_files(tmp_path):
    """Load a campaign whose raw folder has these files."""

    def loaded(*names, text=WATCH):
        for name in names:
            path = tmp_path / "raw" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("a\n1\n")
        (tmp_path / "campaign.toml").write_text(BASE + text, encoding="utf-8")
        return load(tmp_path)

    return loaded


def texts(campaign, severity):
    return [str(each) for each in campaign.warnings if each.severity is severity and "raw/" in each.text]


def test_files_that_fit_a_pattern_are_tests(with_files):
    tests = with_files("prism-free-10.csv", "prism-free-2.csv", "cone-EC-2.5.csv").tests
    assert list(tests) == ["cone-EC-2.5", "prism-free-2", "prism-free-10"]
    quake = tests["cone-EC-2.5"]
    assert (quake.kind, quake.motion, quake.span, quake.setup) == ("earthquake", "El Centro 1940 NS", 2.5, "frame")
    assert quake.operator == "M. Rossi, cone"
    assert tests["prism-free-2"].kind == "free-vibration"


def test_the_files_of_two_recorders_are_one_test(with_files):
    campaign = with_files("prism-free-1.csv", "prism-free-1-daq2.csv")
    ((name, test),) = campaign.tests.items()
    files = {recorder: path.name for recorder, path in test.files.items()}
    assert (name, files) == ("prism-free-1", {"main": "prism-free-1.csv", "daq2": "prism-free-1-daq2.csv"})


def test_what_the_main_file_says_counts_whichever_file_comes_first(with_files):
    pattern = '{{file = "{}-{{number}}.csv", kind = "{}", specimen = "cone"}}'
    patterns = ", ".join(pattern.format(*each) for each in (("{recorder}", "sine"), ("x", "tilt")))
    (test,) = with_files("daq2-1.csv", "x-1.csv", text=f"[watch]\npattern = [{patterns}]\n").tests.values()
    assert (test.kind, list(test.files)) == ("tilt", ["daq2", "main"])


def test_an_entry_wins(with_files):
    entry = ENTRY.format("mine", "prism-free-1")
    campaign = with_files("prism-free-1.csv", "prism-free-2.csv", text=WATCH + entry)
    assert list(campaign.tests) == ["mine", "prism-free-2"]
    assert campaign.tests["mine"].kind == "other"


@pytest.mark.parametrize(
    ("names", "reason"),
    [
        (["a/prism-free-1.csv"], "fits no pattern"),
        (["prism-free-1.csv", "prism-free-1-daq2.csv", "Prism-Free-1-DAQ2.csv"], "are the same test"),
        (["prism-free-1-daq2.csv"], "main recorder is missing"),
        (["prism-EC-0.csv"], "span"),
    ],
)
def test_a_file_that_makes_no_test_is_reported_and_stops_nothing(with_files, names, reason):
    campaign = with_files("cone-free-7.csv", *names)
    assert list(campaign.tests) == ["cone-free-7"]
    (said,) = [each for each in campaign.warnings if each.kind == "raw file without a test"]
    assert reason in said.text
    assert any(name in said.text for name in names)


def test_a_file_that_fits_two_patterns_is_refused(with_files):
    text = '[watch]\npattern = ["{specimen}-{number}.csv", "prism-{span}.csv"]\n'
    campaign = with_files("prism-1.csv", text=text)
    assert not campaign.tests
    assert "two patterns" in texts(campaign, Severity.SERIOUS)[0]


def test_an_unknown_setup_is_reported_once(with_files):
    text = '[watch]\npattern = {file = "{specimen}-{number}.csv", kind = "sine", setup = "fram"}\n'
    campaign = with_files("prism-1.csv", "prism-2.csv", text=text)
    (said,) = texts(campaign, Severity.SERIOUS)
    assert 'raw/prism-1.csv and 1 more: no test was made of it. Unknown setup "fram". Did you mean "frame"?' in said


@pytest.mark.parametrize("name", [".prism-free-1.csv", "prism-free-1.csv.partial", "~prism-free-1.csv"])
def test_unfinished_and_hidden_files_are_not_looked_at(with_files, name):
    campaign = with_files(name)
    assert not campaign.tests
    assert not texts(campaign, Severity.NOTE)


def test_a_link_is_not_followed(with_files, tmp_path):
    (tmp_path / "elsewhere.csv").write_text("a\n1\n")
    (tmp_path / "raw").mkdir()
    (tmp_path / "raw" / "prism-free-1.csv").symlink_to(tmp_path / "elsewhere.csv")
    assert not with_files().tests


@pytest.mark.parametrize(
    ("key", "told"),
    [('pattern = "{spcimen}.csv"', r"watch\.pattern: Unknown part {spcimen}"), ('folder = "../raw"', ".* outside")],
)
def test_a_wrong_watch_is_an_error_of_the_campaign_file(with_files, key, told):
    with pytest.raises(CampaignError, match=told):
        with_files(text=f"[watch]\n{key}\n")


def test_a_planned_test_is_awaited_until_its_file_is_there(with_files, tmp_path):
    entry = ENTRY.format("t", "t") + "planned = true\n"
    assert with_files(text=entry).left_out("t") == "expected: raw/t.csv"
    assert with_files("t.csv", text=entry).left_out("t") == ""


def test_a_watch_awaits_every_file_that_is_missing(with_files):
    campaign = with_files("prism-free-1.csv", text=WATCH + ENTRY.format("t", "t"))
    assert campaign.left_out("t") == ""
    assert campaign.awaiting().left_out("t") == "expected: raw/t.csv"
    assert campaign.awaiting().left_out("prism-free-1") == ""
