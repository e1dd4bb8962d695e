"""Rows of the table of all tests: those of the small campaign, and others of the same test with another record."""

from dataclasses import replace

import pytest

from colonnade.campaign.forms.summary import PredictionSummary, TestSummary
from colonnade.report.rows import TestRow


@pytest.fixture
def rows(reported):
    return [TestRow.of(one) for one in reported.values()]


@pytest.fixture
def row_of(reported):
    """Make a row: `row_of("a", "rocking", 0.4, linear=("rocking", 0.5))`; other keywords go into its record."""
    given = TestRow.of(reported["span-2.0"])

    def make(name, outcome, peak=None, **more):
        predicted = {
            model: PredictionSummary(outcome=said[0], peak_ratio=said[1], **(said[2] if len(said) > 2 else {}))
            for model in ("linear", "nonlinear")
            if (said := more.pop(model, None))
        }
        record = TestSummary(
            **{"status": "done", "kind": "earthquake", "specimen": "prism"} | more,
            outcome=outcome,
            peak_ratio=peak,
            predicted=predicted,
        )
        return replace(given, test=given.test.model_copy(update={"id": name}), record=record, failures=())

    return make
