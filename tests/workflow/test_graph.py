"""The graph of results, what its steps hand on, and what a run gives back."""

from pathlib import Path

import pytest

from colonnade.campaign import load
from colonnade.findings import note, serious, warning
from colonnade.store.results import results_of
from colonnade.workflow.chain import RunResult, StageRun
from colonnade.workflow.graph import Graph
from colonnade.workflow.product import Catalogue


@pytest.fixture
def graph(small):
    return Graph(load(small.folder), small.layout, Catalogue(small.layout))


@pytest.mark.parametrize("name", ["free-01", "pulse-01"])
def test_the_steps_of_a_test_make_its_results_in_their_order(graph, name):
    test = graph.campaign.tests[name]
    steps = graph.of_test(test)
    assert [step.result for step in steps] == results_of(graph.campaign, test)
    made = {graph.layout.stage(test.specimen, "specimen")}
    for step in steps:
        assert {each for each in step.upstream.values() if isinstance(each, Path)} <= made, step.result
        made |= {*step.paths}


def test_each_stage_has_code_of_its_own_that_the_models_of_the_plane_share(graph):
    of_stage = {}
    for step in (step for name in ("free-01", "pulse-01") for step in graph.of_test(graph.campaign.tests[name])):
        of_stage.setdefault(step.result.stage, set()).add(step.code)
    assert all(len(codes) == 1 for codes in of_stage.values())
    assert len(set.union(*of_stage.values())) == len(of_stage) > 4


def test_the_code_is_hashed_again_only_if_a_source_changed(graph, monkeypatch):
    test = graph.campaign.tests["pulse-01"]
    before = [step.code for step in graph.of_test(test)]
    graph.catalogue.save()
    monkeypatch.setattr("colonnade.workflow.product.code_hash", lambda *given, **more: "parsed again")
    again = Graph(graph.campaign, graph.layout, Catalogue(graph.layout))
    assert [step.code for step in again.of_test(test)] == before
    monkeypatch.setattr("colonnade.workflow.product.package_hash", lambda: "other sources")
    again = Graph(graph.campaign, graph.layout, Catalogue(graph.layout))
    assert {step.code for step in again.of_test(test)} == {"parsed again"}


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
