"""What a run gives back: whether it failed, and its findings under the names of what they are about."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.findings import note, serious, warning
from colonnade.workflow.outcome import RunResult, StageRun


def result(*stages, **given):
    return RunResult(stages, Path("summary.json"), None, **given)


def test_a_stage_of_a_specimen_is_listed_as_one():
    assert StageRun("prism", "specimen", "done").heading == "specimen prism"
    assert StageRun("prism", "contact", "done").of == "specimen"
    assert StageRun("free-01", "predict", "done", "linear").heading == "free-01"


@pytest.mark.parametrize(
    ("actions", "failed"), [(["done", "up-to-date"], False), (["done", "failed"], True), ([], False)]
)
def test_one_failed_stage_makes_it_a_failure(actions, failed):
    assert result(*(StageRun("a", "ingest", action) for action in actions)).failed == failed


def test_findings_are_gathered_by_subject_the_worst_first():
    mild, bad = note("gap", "a gap."), serious("gain", "a wrong gain.")
    found = result(
        StageRun("a", "ingest", "done", findings=(mild,)),
        StageRun("a", "rocking", "up-to-date", findings=(bad,)),
        StageRun("b", "ingest", "done"),
        of_campaign=(warning("column", "an unused column."),),
    ).findings
    assert list(found) == ["campaign file", "a"]
    assert [each.text for each, _ in found["a"]] == ["a wrong gain.", "a gap."]


@pytest.mark.parametrize(("finding", "counts"), [(note("gap", "x."), False), (warning("gap", "x."), True)])
def test_notes_are_no_warnings(finding, counts):
    assert result(StageRun("a", "ingest", "done", findings=(finding,))).has_warnings == counts
    assert result(of_campaign=(finding,)).has_warnings == counts
