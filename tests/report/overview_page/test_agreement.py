"""Agreement of the overview: outcomes counted, peaks, spans, and what needs a look."""

from dataclasses import replace

import pytest

from colonnade.campaign.forms.summary import Warned
from colonnade.report.overview_page.agreement import confusions
from colonnade.report.overview_page.attention import attention, warning_groups
from colonnade.report.pages import rendered

MODELS = ("linear",)


def warned(severity, text, *, explained=False):
    return Warned(severity=severity, kind="gain", text=text, stage="rocking", explained=explained)


def looked_at(rows):
    groups = warning_groups((row.id, found) for row in rows for found in row.record.warnings)
    return attention(rows, MODELS, groups, confusions(rows, MODELS))


def test_each_kind_of_trouble_is_in_its_place(row_of):
    serious, follows = warned("serious", "ten times off"), warned("serious", "so no e", explained=True)
    rows = [
        row_of("good", "rocking", 0.2, linear=("rocking", 0.2, {"within_spread": 0.5})),
        row_of("dead", None, status="failed", reason="empty"),
        row_of("gain", "rocking", 0.2, warnings=(serious, follows)),
        row_of("missed", "overturned", linear=("rocking", 0.2, {"within_spread": 0.99})),
        row_of("odd", "rocking", 0.2, warnings=(warned("warning", "it drifts"), warned("note", "a spike"))),
    ]
    found = looked_at(rows)
    assert found.is_needed
    assert [row.id for row in found.failed] == ["dead"]
    assert [(group.first.text, group.subjects) for group in found.serious] == [("ten times off", ["gain"])]
    assert [(model, cell.tests) for model, cell in found.missed] == [("linear", ("missed",))]
    assert [group.first.text for group in found.warnings] == ["it drifts"]
    assert found.outside == [("linear", ["missed"], pytest.approx(0.1))]  # 5 % of the two that are judged
    assert (found.explained, found.notes) == (1, 1)


def test_a_note_needs_no_look(row_of):
    found = looked_at([row_of("a", "rocking", 0.2, warnings=(warned("note", "a spike"),))])
    assert not found.is_needed
    assert found.notes == 1


def test_an_excluded_test_has_not_failed(row_of):
    row = replace(row_of("a", None, status="pending"), excluded="left out by N. N.")
    assert not looked_at([row]).is_needed


def test_of_many_missed_tests_a_few_are_named_and_the_table_has_all(row_of, filled_campaign):
    found = looked_at([row_of(f"a{number:02d}", "overturned", linear=("rocking", 0.2)) for number in range(30)])
    page = rendered(filled_campaign[0], "attention", "index.html", attention=found, specimens=[])[0]
    assert page.count('href="tests/a') == 20
    assert 'href="?outcome=overturned&amp;linear=rocking#tests">10 more in the table</a>' in page


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


def test_the_wrong_cells_are_those_with_tests_off_the_diagonal_the_fullest_first(row_of):
    rows = [row_of(name, "overturned", linear=("rocking", 0.8)) for name in "ab"]
    rows += [
        row_of("c", "rocking", 0.2, linear=("overturned", None)),
        row_of("d", "rocking", 0.2, linear=("rocking", 0.2)),
    ]
    (found,) = confusions(rows, BOTH)
    assert [(cell.measured, cell.predicted, cell.tests) for cell in found.wrong] == [
        ("overturned", "rocking", ("a", "b")),
        ("rocking", "overturned", ("c",)),
    ]


def test_what_was_only_seen_to_stand_agrees_with_every_outcome_but_overturning(row_of):
    rows = [
        row_of("a", None, observed_outcome="not-overturned", linear=("rocking", 0.2)),
        row_of("b", None, observed_outcome="not-overturned", linear=("overturned", None)),
    ]
    (found,) = confusions(rows, BOTH)
    assert [(cell.predicted, cell.tests) for cell in found.wrong] == [("overturned", ("b",))]


def test_a_model_without_a_known_outcome_has_no_table(row_of):
    assert confusions([row_of("a", None, linear=("rocking", 0.2)), row_of("b", "rocking", 0.2)], BOTH) == []
