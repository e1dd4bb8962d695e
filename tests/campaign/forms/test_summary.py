"""summary.json has the form of contract 1."""

import json
import math

import pytest
from pydantic import ValidationError

from colonnade.campaign.forms import summary as form

CONTRACT = """
{"schema": 1, "campaign": "prism-2013", "colonnade": "0.1.0",
 "specimens": {"prism": {"critical_angle": 0.1864, "p": 5.631, "pole_distance": 0.232, "inertia": 1.873,
               "restitution": {"value": 0.976, "low": 0.974, "high": 0.978, "level": 0.95, "source": "identified",
                               "method": "peaks", "reason": null, "tests": ["free-01"]}}},
 "tests": {"span-2.0": {"status": "done", "reason": null, "warnings": [], "kind": "earthquake", "specimen": "prism",
           "span": 2.0, "outcome": "rocking", "observed_outcome": null, "peak_ratio": 0.41, "peak_time": 4.2,
           "pga": 2.3, "impacts": 31, "frequency_ratio": null, "amplitude_ratio": null, "order": null,
           "predicted": {"linear": {"outcome": "rocking", "peak_ratio": 0.44, "nrmse": 0.06}, "nonlinear": {},
                         "contact": {}}}}}
"""


LATER = {
    "specimen": "prototype",
    "prediction": "order horizon within_spread peak_low peak_high peak_rank overturning_probability",
    "test": "duration peak_slide release_ratio frequency order_reason impacts_per_cycle restitution"
    " prototype date operator",
}
"""What was added to contract 1 since: null where a writer does not know it."""


def test_the_contracts_example_is_read_and_written_unchanged_but_for_later_additions():
    summary = form.Summary.model_validate_json(CONTRACT)
    written = json.loads(summary.text())
    expected = json.loads(CONTRACT)
    test = expected["tests"]["span-2.0"]
    for model in ("nonlinear", "contact"):
        test["predicted"][model] = dict.fromkeys(("outcome", "peak_ratio", "nrmse"))
    expected["forecasts"] = test["forecast"] = None
    expected["assessments"] = {}
    test["bodies"] = {}
    expected["specimens"]["prism"] |= dict.fromkeys(LATER["specimen"].split())
    test |= dict.fromkeys(LATER["test"].split())
    for prediction in test["predicted"].values():
        prediction |= dict.fromkeys(LATER["prediction"].split())
    assert written == expected
    assert form.Summary.model_validate_json(summary.text()) == summary


def test_what_is_not_a_number_becomes_null_and_infinity_is_refused():
    test = form.TestSummary(status="done", kind="sine", specimen="prism", peak_ratio=math.nan)
    assert json.loads(test.model_dump_json())["peak_ratio"] is None
    with pytest.raises(ValidationError, match="finite"):
        form.TestSummary(status="done", kind="sine", specimen="prism", peak_ratio=math.inf)


@pytest.mark.parametrize("order", [None, 1, 3, "irregular"])
def test_an_order_is_a_whole_number_or_irregular(order):
    test = form.TestSummary(status="done", kind="sine", specimen="prism", order=order)
    assert form.TestSummary.model_validate_json(test.model_dump_json()).order == order
    with pytest.raises(ValidationError):
        form.TestSummary(status="done", kind="sine", specimen="prism", order="harmonic")
