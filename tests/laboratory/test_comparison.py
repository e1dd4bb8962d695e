"""What was found and what is true are put side by side, test by test."""

from __future__ import annotations

import json

from colonnade.laboratory.comparison import with_truth

TRUTH = {
    "specimens": {"prism": {"restitution": 0.95}},
    "tests": {"free-01": {"outcome": "rocking", "peak_ratio": 0.4, "release_ratio": 0.5}},
}


def test_each_number_has_its_truth_next_to_it(tmp_path):
    found = {"outcome": "overturned", "peak_ratio": None, "release_ratio": 0.49, "predicted": {"linear": {}}}
    summary = {"specimens": {"prism": {"restitution": {"value": 0.951}}}, "tests": {"free-01": found}}
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(summary), encoding="utf-8")
    compared = with_truth(TRUTH, path)
    assert compared["restitution"] == {"prism": {"true": 0.95, "value": 0.951}}
    assert compared["tests"]["free-01"] == {
        "true_outcome": "rocking",
        "outcome": "overturned",
        "true_peak_ratio": 0.4,
        "peak_ratio": None,
        "true_release_ratio": 0.5,
        "release_ratio": 0.49,
        "predicted": {"linear": {}},
    }
