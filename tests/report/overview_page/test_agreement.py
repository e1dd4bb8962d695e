"""Right outcomes are never counted without the misfits and the verdict on the model's own spread."""

from __future__ import annotations

import pytest

import rebuild
from colonnade.laboratory.plans.ladder import KEPT_AWAY
from colonnade.report.overview_page.agreement import agreement


def prediction(outcome="rocking", nrmse=0.1, rank=None):
    return {"outcome": outcome, "nrmse": nrmse, "within_spread": rank}


TESTS = {
    "right": {"outcome": "rocking", "predicted": {"linear": prediction(rank=0.95)}},
    "wrong": {"outcome": "overturned", "predicted": {"linear": prediction(nrmse=0.3, rank=0.96)}},
    "seen": {
        "outcome": None,
        "observed_outcome": "not-overturned",
        "predicted": {"linear": prediction("no-rocking", nrmse=None)},
    },
    "unknown": {"outcome": None, "predicted": {"linear": prediction("no-rocking", nrmse=None)}},
}


def test_outcomes_misfits_and_spread_are_told_together():
    assert agreement(TESTS) == [
        "The linear model predicts the outcome of 2 of 3 tests. Its misfit (nrmse) is 0.2 at the median and 0.3 at "
        "most, in wrong. 1 of 2 misfits is within its own spread."
    ]


def test_a_spread_that_was_not_computed_is_told():
    (told,) = agreement({"right": {"outcome": "rocking", "predicted": {"linear": prediction()}}})
    assert told.endswith("0.1 at most, in right. Its own spread was not computed.")


@pytest.mark.parametrize(
    "tests",
    [{}, {"a": TESTS["unknown"]}, {"a": {"outcome": "rocking", "predicted": {"linear": prediction(outcome=None)}}}],
    ids=["no test", "outcome not known", "nothing predicted"],
)
def test_without_a_known_outcome_nothing_is_said(tests):
    assert agreement(tests) == []


def test_the_reference_reports_tell_them_too():
    test = {"outcome": {}, "peak_ratio": {}, "nrmse": {}, "order": None}
    numbers = {"seed": 0, "restitution": {}, "tests": {"right": test}, "agreement": agreement(TESTS)}
    page = rebuild.demo_table(numbers, "A demo", {})
    assert all(told in page for told in agreement(TESTS))
    assert KEPT_AWAY in page
