"""The summary read back: records of tests with and without a run, and the points of a measured map."""

import csv
import io

import pytest

from colonnade.campaign.forms import summary as form
from colonnade.store.layout import Layout
from colonnade.store.records.summary import as_csv, map_points, read_summary, records_of_specimens, records_of_tests

SUMMARY = form.Summary(
    campaign="one",
    colonnade="0",
    specimens={},
    tests={"pulse-01": form.TestSummary(status="done", kind="pulse", specimen="prism", outcome="rocking")},
)


def test_a_test_is_pending_before_a_run_and_as_summarised_after_it(written):
    campaign = written(more='observed_outcome = "overturned"\n')
    before = records_of_tests(campaign, None)["pulse-01"]
    assert (before.status, before.observed_outcome, before.outcome) == ("pending", "overturned", None)
    assert records_of_tests(campaign, SUMMARY) == SUMMARY.tests


def test_a_specimen_has_its_geometry_before_a_run(written):
    record = records_of_specimens(written(), None)["prism"]
    assert record["critical_angle"] == pytest.approx(0.18641, abs=5e-6)  # atan(86/456)
    assert record["restitution"]["value"] is None


def test_a_summary_is_read_back_as_written(tmp_path):
    layout = Layout(tmp_path)
    assert read_summary(layout) is None
    layout.processed.mkdir()
    layout.summary_json.write_text(SUMMARY.text(), encoding="utf-8")
    assert read_summary(layout) == SUMMARY


def sine(**changes):
    values = {"status": "done", "kind": "sine", "specimen": "prism", "outcome": "rocking", "order": 3}
    return form.TestSummary(**(values | {"frequency_ratio": 3.3, "amplitude_ratio": 1.5} | changes))


@pytest.mark.parametrize(
    ("changes", "outcome"),
    [
        ({}, "rocking"),
        ({"outcome": None, "observed_outcome": "overturned"}, "overturned"),
        ({"outcome": None, "observed_outcome": "not-overturned"}, None),
        ({"amplitude_ratio": None}, None),
        ({"specimen": "cone"}, None),
    ],
    ids=["measured", "observed", "observed not to overturn", "of unknown amplitude", "of another specimen"],
)
def test_a_map_shows_sine_tests_of_known_outcome(changes, outcome):
    points = map_points({"one": sine(**changes)}, "prism")
    assert [(point.test, point.frequency_ratio, point.outcome) for point in points] == (
        [] if outcome is None else [("one", 3.3, outcome)]
    )


def rows(**tests):
    summary = form.Summary(campaign="one", colonnade="0", specimens={}, tests=tests)
    return list(csv.DictReader(io.StringIO(as_csv(summary), newline="")))


def test_each_part_of_a_record_has_columns_of_its_own_and_nothing_is_empty():
    predicted = {"linear": form.PredictionSummary(outcome="rocking", nrmse=0.1)}
    history = {"linear": form.HistorySummary(value=0.91)}
    e = form.IdentifiedSummary(value=0.9, low=0.8, reason="not in the table", whole_history=history)
    free = sine(predicted=predicted, restitution=e, prototype=form.TestPrototype(duration=4.5))
    first, second = rows(free=free, sine=form.TestSummary(status="pending", kind="sine", specimen="prism"))
    assert (first["test"], first["linear_outcome"], first["linear_nrmse"]) == ("free", "rocking", "0.1")
    assert (first["restitution_value"], first["restitution_low"], first["restitution_high"]) == ("0.9", "0.8", "")
    assert (first["restitution_history_linear_value"], first["prototype_duration"]) == ("0.91", "4.5")
    assert (second["test"], second["restitution_value"], second["linear_outcome"]) == ("sine", "", "")
    assert "not in the table" not in first.values()
    assert as_csv(form.Summary(campaign="one", colonnade="0", specimens={}, tests={})) == "test\n"


@pytest.mark.parametrize("text", ["=HYPERLINK(1)", "+1+1", "-1+1", "@SUM(A1)", "\t=1", "\r=1"])
def test_text_that_a_spreadsheet_would_calculate_is_quoted(text):
    warnings = (form.Warned(severity="note", kind="x", text=text),)
    (row,) = rows(one=sine(warnings=warnings, reason=text, peak_ratio=-0.5))
    expected = f"'{text}".replace("\r", "\n")
    assert (row["reason"], row["warnings"]) == (expected, f"note: {text}".replace("\r", "\n"))
    assert float(row["peak_ratio"]) == -0.5
