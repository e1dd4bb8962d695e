"""The graph of results: each one follows from what is made before it, by code that is its own."""

from __future__ import annotations

import pytest

from colonnade.campaign import load
from colonnade.store.results import results_of
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.steps import Graph


@pytest.fixture
def graph(small):
    return Graph(load(small.folder), small.layout, Catalogue(small.layout))


@pytest.mark.parametrize("name", ["free-01", "pulse-01"])
def test_the_steps_of_a_test_make_its_results_in_their_order(graph, name):
    test = graph.campaign.tests[name]
    steps = [*graph.measuring(test), *graph.predicting(test)]
    assert [step.result for step in steps] == results_of(graph.campaign, test)
    made = {graph.layout.stage(test.specimen, "specimen")}
    for step in steps:
        assert step.is_from_raw or set(step.upstream.values()) <= made, step.result
        made.add(step.path)


def test_each_stage_has_code_of_its_own_and_the_models_have_theirs(graph):
    steps = [step for name in ("free-01", "pulse-01") for step in graph.measuring(graph.campaign.tests[name])]
    steps += graph.predicting(graph.campaign.tests["pulse-01"])
    code = {(step.result.stage, step.result.model): step.code for step in steps}
    assert len(set(code.values())) == len(code)


def test_the_code_is_hashed_again_only_if_a_source_changed(graph, monkeypatch):
    test = graph.campaign.tests["pulse-01"]
    before = [step.code for step in graph.predicting(test)]
    graph.catalogue.save()
    monkeypatch.setattr("colonnade.workflow.catalogue.code_hash", lambda *given, **more: "parsed again")
    again = Graph(graph.campaign, graph.layout, Catalogue(graph.layout))
    assert [step.code for step in again.predicting(test)] == before
    monkeypatch.setattr("colonnade.workflow.catalogue.package_hash", lambda: "other sources")
    again = Graph(graph.campaign, graph.layout, Catalogue(graph.layout))
    assert {step.code for step in again.predicting(test)} == {"parsed again"}
