"""summary.csv: a row a test, safe to open in a spreadsheet."""

from __future__ import annotations

import csv
import io

import pytest

from colonnade.campaign.forms import summary as form
from colonnade.store.records.table import as_csv


def rows(**tests):
    summary = form.Summary(campaign="one", colonnade="0", specimens={}, tests=tests)
    return list(csv.DictReader(io.StringIO(as_csv(summary), newline="")))


def test_each_part_of_a_record_has_columns_of_its_own_and_nothing_is_empty():
    free = form.TestSummary(
        status="done",
        kind="free-vibration",
        specimen="prism",
        predicted={"linear": form.PredictionSummary(outcome="rocking", nrmse=0.1)},
        restitution=form.IdentifiedSummary(
            value=0.9, low=0.8, reason="not in the table", whole_history={"linear": form.HistorySummary(value=0.91)}
        ),
        prototype=form.TestPrototype(duration=4.5),
    )
    first, second = rows(free=free, sine=form.TestSummary(status="pending", kind="sine", specimen="prism"))
    assert (first["test"], first["linear_outcome"], first["linear_nrmse"]) == ("free", "rocking", "0.1")
    assert (first["restitution_value"], first["restitution_low"], first["restitution_high"]) == ("0.9", "0.8", "")
    assert (first["restitution_history_linear_value"], first["prototype_duration"]) == ("0.91", "4.5")
    assert (second["test"], second["restitution_value"], second["linear_outcome"]) == ("sine", "", "")
    assert "not in the table" not in first.values()


@pytest.mark.parametrize("text", ["=HYPERLINK(1)", "+1+1", "-1+1", "@SUM(A1)", "\t=1", "\r=1"])
def test_text_that_a_spreadsheet_would_calculate_is_quoted(text):
    warnings = (form.Warned(severity="note", kind="x", text=text),)
    test = form.TestSummary(
        status="done", kind="pulse", specimen="prism", warnings=warnings, reason=text, peak_ratio=-0.5
    )
    (row,) = rows(one=test)
    expected = f"'{text}".replace("\r", "\n")
    assert (row["reason"], row["warnings"]) == (expected, f"note: {text}".replace("\r", "\n"))
    assert float(row["peak_ratio"]) == -0.5


def test_a_campaign_without_tests_has_a_heading():
    assert as_csv(form.Summary(campaign="one", colonnade="0", specimens={}, tests={})) == "test\n"
