"""The table of stages: their order, their names, and which results a test has."""

import pytest

from colonnade.campaign import load
from colonnade.store.results import RUN_STAGES, STAGES, ResultId, models_of, results_of

CAMPAIGN = """
schema = 1
campaign = "c"
title = "C"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[processing.predict]
models = ["linear", "contact"]

[setups.frame.channels]
table = {column = "t", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}
"""
TEST = '[[tests]]\nid = "{kind}"\nkind = "{kind}"\nspecimen = "prism"\nsetup = "frame"\nfile = "raw.csv"\n'


@pytest.fixture
def campaign(tmp_path):
    (tmp_path / "raw.csv").write_text("t\n")
    tests = "".join(TEST.format(kind=kind) for kind in ("free-vibration", "pulse", "tilt"))
    (tmp_path / "campaign.toml").write_text(CAMPAIGN + tests, encoding="utf-8")
    return load(tmp_path)


def test_the_stages_that_can_be_asked_for_are_those_of_the_contract():
    assert " ".join(RUN_STAGES) == "ingest condition rocking restitution predict ensemble compare report"


@pytest.mark.parametrize(("stage", "with_"), [("specimen", "restitution"), ("contact", "predict"), ("map", "report")])
def test_what_is_of_a_specimen_comes_with_a_stage_of_its_tests(stage, with_):
    assert ResultId("prism", stage).of == "specimen"
    assert ResultId("prism", stage).order == RUN_STAGES.index(with_)


def test_no_two_results_share_a_file():
    files = [ResultId("same", stage, "linear").file for stage in STAGES]
    assert len(set(files)) == len(files)


@pytest.mark.parametrize(
    ("test", "names"),
    [
        (
            "free-vibration",
            "ingest condition rocking restitution predict-linear predict-contact ensemble-linear compare",
        ),
        ("pulse", "ingest condition rocking predict-linear predict-contact ensemble-linear compare"),
        ("tilt", "ingest condition rocking compare"),
    ],
)
def test_a_test_has_the_results_of_its_kind_and_of_the_models_in_their_order(campaign, test, names):
    results = results_of(campaign, campaign.tests[test])
    assert " ".join(str(result).replace(" ", "-") for result in results) == names
    assert [result.order for result in results] == sorted(result.order for result in results)


def test_without_base_motion_nothing_is_predicted(campaign):
    assert models_of(campaign, campaign.tests["pulse"]) == ("linear", "contact")
    assert models_of(campaign, campaign.tests["tilt"]) == ()
