from dataclasses import replace

import pytest

from colonnade.campaign.forms.summary import Warned
from colonnade.report.overview_page.attention import attention
from colonnade.report.overview_page.confusion import confusions
from colonnade.report.pages import renderer_of
from colonnade.report.problems import warning_groups

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
    page = renderer_of(filled_campaign[0]).page("overview/attention", "index.html", attention=found, specimens=[])
    assert page.count('href="tests/a') == 20
    assert 'href="?outcome=overturned&amp;linear=rocking#tests">10 more in the table</a>' in page
