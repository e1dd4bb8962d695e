"""The table of stages: their order, their names, and which results a test has."""

from pathlib import Path

import pytest

from colonnade.store.layout import Layout
from colonnade.store.results import RUN_STAGES, STAGES, ResultId, models_of, results_of

TEST = '[[tests]]\nid = "{kind}"\nkind = "{kind}"\nspecimen = "prism"\nsetup = "frame"\nfile = "raw.csv"\n'
PREDICTED = "predict-linear predict-contact ensemble-linear compare"
TABLE = 'table = {column = "t", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}\n'


@pytest.fixture
def campaign(written):
    tests = "".join(TEST.format(kind=kind) for kind in ("free-vibration", "pulse", "tilt"))
    models = '[processing.predict]\nmodels = ["linear", "contact"]\n'
    return written("\n[[tests]]\n", f"{TABLE}\n[[tests]]\n", more=tests + models)


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
        ("free-vibration", f"ingest condition rocking restitution {PREDICTED}"),
        ("pulse", f"ingest condition rocking {PREDICTED}"),
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


def test_each_stage_has_its_file_in_the_tests_folder():
    stages = ("ingest", "condition", "rocking", "restitution", "compare")
    found = [Layout(Path("c")).stage("free-01", stage) for stage in stages]
    names = ("recorded", "conditioned", "rocking", "restitution", "compared")
    assert found == [Path(f"c/processed/tests/free-01/{name}.nc") for name in names]


def test_each_model_has_a_file():
    layout = Layout(Path("c"))
    assert layout.stage("free-01", "predict", "linear").name == "predicted-linear.nc"
    assert layout.stage("free-01", "ensemble", "linear").name == "ensemble-linear.nc"
    assert layout.stage("prism", "contact") == Path("c/processed/contact/prism.nc")
    assert layout.stage("prism", "responses", "linear") == Path("c/processed/maps/prism-linear-response.nc")


def test_specimens_summary_and_report_lie_where_the_contract_says():
    layout = Layout(Path("c"))
    assert layout.stage("prism", "specimen") == Path("c/processed/specimens/prism.nc")
    assert layout.summary_json == Path("c/processed/summary.json")
    assert layout.report == Path("c/report/index.html")
    assert layout.stage("prism", "map", "linear") == Path("c/processed/maps/prism-linear.nc")
