"""The parts of the overview: what needs a look, outcomes counted, peaks, the ladder of sines, maps and Spans."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.forms.summary import PredictionSummary, TestSummary, Warned
from colonnade.dynamics.maps import stability_map
from colonnade.figures.panels.curve import Curve
from colonnade.report import overview
from colonnade.report.build import rendered
from colonnade.report.overview import HEIGHT, WIDTH, TestRow, attention, confusions, polyline, warning_groups
from colonnade.report.pictures import of_specimen, picture
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import as_dataset
from read_pages import words_of


@pytest.fixture
def rows(reported):
    return [TestRow.of(one.campaign, one.test, one.record, one.failures) for one in reported.values()]


@pytest.fixture
def row_of(reported):
    """Make a row: `row_of("a", "rocking", 0.4, linear=("rocking", 0.5))`; other keywords go into its record."""
    one = reported["span-2.0"]
    given = TestRow.of(one.campaign, one.test, one.record)

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


MODELS = ("linear",)


def warned(severity, text, **more):
    return Warned(**{"severity": severity, "kind": "gain", "text": text, "stage": "rocking"} | more)


def looked_at(rows):
    groups = warning_groups((row.id, found) for row in rows for found in row.record.warnings)
    return attention(rows, MODELS, groups, confusions(rows, MODELS))


def test_each_kind_of_trouble_is_in_its_place(row_of, filled_campaign):
    serious, follows = warned("serious", "ten times off"), warned("serious", "so no e", explained=True)
    rows = [
        row_of("good", "rocking", 0.2, linear=("rocking", 0.2, {"within_spread": 0.5})),
        row_of("dead", None, status="failed", reason="empty"),
        row_of("gain", "rocking", 0.2, warnings=(serious, follows)),
        row_of("missed", "overturned", linear=("rocking", 0.2, {"within_spread": 0.99})),
        row_of("odd", "rocking", 0.2, warnings=(warned("warning", "it drifts"), warned("note", "a spike"))),
    ]
    found = looked_at(rows)
    assert found["is_needed"]
    assert [row.id for row in found["failed"]] == ["dead"]
    assert [(group.first.text, group.subjects) for group in found["serious"]] == [("ten times off", ["gain"])]
    assert [(model, cell.tests) for model, cell in found["missed"]] == [("linear", ("missed",))]
    assert [group.first.text for group in found["warnings"]] == ["it drifts"]
    assert found["outside"] == [("linear", ["missed"], pytest.approx(0.1))]  # 5 % of the two that are judged
    assert (found["explained"], found["notes"]) == (1, 1)
    page = rendered(filled_campaign[0], "attention", "index.html", attention=found, specimens=[])[0]
    heads = (
        "1 test failed",
        "Results are wrong until this is corrected",
        "Outcomes that a model misses",
        "All findings",
    )
    places = [words_of(page).find(head) for head in heads]
    assert -1 < places[0] < places[1] < places[2] < places[3]


def test_a_note_and_an_excluded_test_need_no_look(row_of):
    excluded = replace(row_of("b", None, status="pending"), excluded="left out by N. N.")
    found = looked_at([row_of("a", "rocking", 0.2, warnings=(warned("note", "a spike"),)), excluded])
    assert not found["is_needed"]
    assert found["notes"] == 1


def test_of_many_missed_tests_a_few_are_named_and_the_table_has_all(row_of, filled_campaign):
    found = looked_at([row_of(f"a{number:02d}", "overturned", linear=("rocking", 0.2)) for number in range(30)])
    page = rendered(filled_campaign[0], "attention", "index.html", attention=found, specimens=[])[0]
    assert page.count('href="tests/a') == 20
    assert 'href="?outcome=overturned&amp;linear=rocking#tests">10 more in the table</a>' in page


def groups_of(*found):
    return [(group.first.text, group.subjects) for group in warning_groups(found)]


def test_warnings_of_a_stage_that_differ_in_their_numbers_alone_are_one_group_and_name_a_test_once():
    spikes = [
        ("a", warned("warning", "3 spikes")),
        ("b", warned("warning", "17 spikes")),
        ("a", warned("warning", "1 spikes")),
    ]
    assert groups_of(*spikes) == [("3 spikes", ["a", "b"])]
    others = (
        warned("note", "3 spikes"),
        warned("warning", "3 spikes", stage="condition"),
        warned("warning", "top-1"),
        warned("warning", "top-2"),
    )
    assert len(groups_of(*spikes, *(("a", each) for each in others))) == 5  # a number in a name is part of it


def test_the_worst_come_first_and_then_what_most_tests_have():
    found = [
        ("a", warned("warning", "one")),
        *((name, warned("warning", "two")) for name in "ab"),
        ("c", warned("serious", "bad")),
    ]
    assert [text for text, _ in groups_of(*found)] == ["bad", "two", "one"]


BOTH = ("linear", "nonlinear")


def test_each_test_is_counted_once_by_measured_and_predicted_outcome(row_of):
    rows = [
        row_of("a", "rocking", 0.3, linear=("rocking", 0.3)),
        row_of("b", "rocking", 0.3, linear=("overturned", None)),
        row_of("c", "overturned", linear=("rocking", 0.8)),
        row_of("d", "overturned", linear=("rocking", 0.7)),
        row_of("e", "no-rocking", 0.0, linear=("no-rocking", 0.0)),
    ]
    (found,) = confusions(rows, BOTH)
    assert found.model == "linear"
    counted = {(cell.measured, cell.predicted): cell.tests for row in found.rows for cell in row if cell.tests}
    assert counted == {
        ("no-rocking", "no-rocking"): ("e",),
        ("rocking", "rocking"): ("a",),
        ("rocking", "overturned"): ("b",),
        ("overturned", "rocking"): ("c", "d"),
    }
    wrong = [(cell.measured, cell.predicted, cell.tests) for cell in found.wrong]
    assert wrong == [("overturned", "rocking", ("c", "d")), ("rocking", "overturned", ("b",))], "the fullest first"


def test_what_was_only_seen_to_stand_agrees_with_every_outcome_but_overturning(row_of):
    rows = [
        row_of("a", None, observed_outcome="not-overturned", linear=("rocking", 0.2)),
        row_of("b", None, observed_outcome="not-overturned", linear=("overturned", None)),
    ]
    (found,) = confusions(rows, BOTH)
    assert [(cell.predicted, cell.tests) for cell in found.wrong] == [("overturned", ("b",))]


STRONG = "sine-3hz-too-strong-for-the-block-1"


def with_another(rows, frequency_ratio):
    """Add a sine test of another Ω that rocked."""
    (row,) = (row for row in rows if row.id == STRONG)
    changes = {"frequency_ratio": frequency_ratio, "amplitude_ratio": 1.5, "outcome": "rocking"}
    record = row.record.model_copy(update=changes)
    return [*rows, replace(row, test=row.test.model_copy(update={"id": "another"}), record=record)]


def with_records(campaign, layout, rows):
    """The prism with these tests."""
    return of_specimen(campaign, layout, "prism", {row.id: row.record for row in rows}, [], [])


def test_two_frequencies_make_a_map_whose_marks_lead_to_their_tests(rows, filled_campaign):
    subject = with_records(*filled_campaign, with_another(rows, 5.0))
    assert picture("map", subject) is None
    drawn = picture("measured-map", subject)
    assert [f'href="test:{name}"' in drawn.svg for name in (STRONG, "another")] == [True, True]
    assert len(overview.boundaries_of(subject.points)) == 2


def test_computed_maps_are_drawn_with_the_tests_and_a_failed_one_is_not(rows, filled_campaign, tmp_path):
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    chart = stability_map(
        campaign.block("prism"),
        restitution=0.93,
        frequency_ratio=[3.0, 5.5],
        amplitude_ratio=[1.0, 2.0],
        cycles=3,
        model="nonlinear",
    )
    attributes = {"stage": "map", "settings": json.dumps(chart.options)}
    files.write_failed(layout.stage("prism", "map", "linear"), "no", attributes=attributes)
    files.write(
        as_dataset(vars(chart), chart.options), layout.stage("prism", "map", "nonlinear"), attributes=attributes
    )
    drawn = picture("map", with_records(campaign, layout, with_another(rows, 5.0)))
    assert "nonlinear: lower limit" in drawn.svg
    assert ">linear: lower limit" not in drawn.svg
    assert 'href="test:another"' in drawn.svg


MODELS = ("linear", "nonlinear")


def test_the_peaks_that_agree_least_come_first_too_large_or_too_small(row_of):
    rows = [
        row_of("right", "rocking", 0.4, linear=("rocking", 0.4), nonlinear=("rocking", 0.44)),
        row_of("large", "rocking", 0.1, linear=("rocking", 0.3)),
        row_of("small", "rocking", 0.4, linear=("rocking", 0.1)),
        row_of("fallen", "overturned", linear=("rocking", 0.9)),
        row_of("still", "no-rocking", 0.001, linear=("rocking", 0.2)),
        row_of("falls", "rocking", 0.4, linear=("overturned", None)),
    ]
    found = overview.worst(rows, MODELS)
    assert [(each.row.id, each.model) for each in found] == [
        ("small", "linear"),
        ("large", "linear"),
        ("right", "nonlinear"),
        ("right", "linear"),
    ]
    assert found[0].factor == pytest.approx(0.25)


def test_every_prediction_of_a_test_that_rocked_is_a_point_with_its_band(row_of):
    rows = [
        row_of("a", "rocking", 0.4, linear=("rocking", 0.5, {"peak_low": 0.3, "peak_high": 0.6})),
        row_of("b", "rocking", 0.4, linear=("overturned", None)),
        row_of("c", "overturned", linear=("overturned", None)),
    ]
    found = overview.peak_points(rows, MODELS, overview.worst(rows, MODELS))
    assert found.keys() == {"linear"}
    assert found["linear"] == [(0.4, 0.5, 0.3, 0.6, "a", 1), (0.4, None, None, None, "b", None)]


def points(text):
    return [tuple(map(int, point.split(","))) for point in text.split()]


@given(st.lists(st.floats(-5, 5) | st.just(float("nan")), min_size=2, max_size=400))
def test_it_is_some_hundred_bytes_of_whole_numbers_within_the_picture(values):
    text = polyline(Curve(np.linspace(0.0, 7.0, len(values)), np.array(values)))
    assert re.fullmatch(r"(\d+,\d+( |$))*", text)
    assert len(text) < 600
    assert all(0 <= across <= WIDTH and 0 <= down <= HEIGHT for across, down in points(text))
    assert [across for across, _ in points(text)] == sorted(across for across, _ in points(text))


def test_a_still_test_is_two_points_and_nothing_measured_nothing():
    time = np.linspace(0.0, 30.0, 3001)
    assert polyline(Curve(time, np.full(time.size, 1e-4))) == "0,10 64,10"
    assert polyline(None) == polyline(Curve(np.array([1.0]), np.array([0.0]))) == ""
