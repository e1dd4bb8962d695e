"""The table of stages: their order, their names, and which results a test has."""

import pytest

from colonnade.store.results import RUN_STAGES, ResultId, results_of
from prism import entry

PREDICTED = "predict-linear predict-contact ensemble-linear compare"
TABLE = 'table = {column = "t", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}\n'


@pytest.fixture
def campaign(written):
    tests = "".join(entry(kind, kind) for kind in ("free-vibration", "pulse", "tilt"))
    models = '[processing.predict]\nmodels = ["linear", "contact"]\n'
    return written("\n[[tests]]\n", f"{TABLE}\n[[tests]]\n", more=tests + models)


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
