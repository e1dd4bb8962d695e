"""The table of stages: their order, their names, and which results a test has."""

from pathlib import Path

import pytest

from colonnade.store.layout import Layout
from colonnade.store.results import RUN_STAGES, ResultId, results_of

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


@pytest.mark.parametrize(
    ("result", "file"),
    [
        (("free-01", "ingest"), "tests/free-01/recorded.nc"),
        (("free-01", "condition"), "tests/free-01/conditioned.nc"),
        (("free-01", "rocking"), "tests/free-01/rocking.nc"),
        (("free-01", "restitution"), "tests/free-01/restitution.nc"),
        (("free-01", "compare"), "tests/free-01/compared.nc"),
        (("free-01", "predict", "linear"), "tests/free-01/predicted-linear.nc"),
        (("free-01", "ensemble", "linear"), "tests/free-01/ensemble-linear.nc"),
        (("prism", "contact"), "contact/prism.nc"),
        (("prism", "specimen"), "specimens/prism.nc"),
        (("prism", "map", "linear"), "maps/prism-linear.nc"),
        (("prism", "responses", "linear"), "maps/prism-linear-response.nc"),
    ],
)
def test_results_lie_where_the_contract_says(result, file):
    assert Layout(Path("c")).stage(*result) == Path("c/processed") / file
