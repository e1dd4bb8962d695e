"""The walk over a campaign: which steps it takes until a stage, what it leaves out, and what it knows afterwards."""

from __future__ import annotations

import pytest

from colonnade.campaign import load
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.raw_files import raw_files
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk

EXCLUDE = """
schema = 1

[[exclude]]
test = "{test}"
who = "N. N."
when = 2013-04-26
why = "touched by hand"
"""


def walk_of(small, **options):
    """A walk over the campaign as it is now, in this process; it has not begun."""
    campaign, catalogue = load(small.folder), Catalogue(small.layout)
    raw = {test.id: raw_files(campaign, test, catalogue) for test in campaign.tests.values()}
    return Walk(Graph(campaign, small.layout, catalogue), "a run", raw, **{"workers": 1, "until": "compare"} | options)


def walked(small, *tests, **options):
    with only_run(small.layout) as run_id:
        walk = walk_of(small, **options)
        walk.run_id = run_id
        walk.through(tests)
    return walk


def did(walk):
    return [(stage.subject, stage.stage) for stage in walk.stages]


@pytest.mark.parametrize(
    ("until", "stages"),
    [
        ("ingest", [("pulse-01", "ingest")]),
        ("rocking", [("pulse-01", "ingest"), ("pulse-01", "condition"), ("pulse-01", "rocking")]),
    ],
)
def test_it_ends_with_the_stage_that_is_asked_for(untouched, until, stages):
    assert did(walked(untouched, "pulse-01", until=until)) == stages


def test_a_prediction_needs_the_free_vibrations_of_its_specimen_before_it(untouched):
    walk = walked(untouched, "pulse-01", until="predict")
    assert {subject for subject, _ in did(walk)} == {"pulse-01", "free-01", "free-02", "prism"}
    pooled = did(walk).index(("prism", "specimen"))
    assert {did(walk).index((name, "restitution")) < pooled for name in ("free-01", "free-02")} == {True}
    assert did(walk).index(("pulse-01", "predict")) > pooled
    assert ("free-01", "predict") not in did(walk)
    assert walk.failed_tests == walk.failed_specimens == {}


def test_what_people_excluded_is_not_pooled(untouched):
    (untouched.folder / "review.toml").write_text(EXCLUDE.format(test="free-01"), encoding="utf-8")
    walk = walked(untouched, "pulse-01", until="predict")
    assert walk.included == ["free-02", "pulse-01", "pulse-02"]
    assert "free-01" not in {subject for subject, _ in did(walk)}


def test_a_failed_test_is_known_with_its_reason_and_the_others_are_not_stopped(untouched):
    untouched.raw("pulse-01").write_text("", encoding="utf-8")
    walk = walked(untouched, "pulse-01", "pulse-02", until="rocking")
    assert set(walk.failed_tests) == {"pulse-01"}
    assert "the file is empty" in walk.failed_tests["pulse-01"]
    assert ("pulse-02", "rocking") in did(walk)


def test_tests_of_a_specimen_that_failed_are_not_predicted_and_say_whose_fault_it_is(small):
    walk = walk_of(small)
    walk.failed_specimens["prism"] = "no e"
    with only_run(small.layout) as run_id:
        walk.run_id = run_id
        walk._predict(["pulse-01"])
    assert walk.failed_tests == {"pulse-01": "specimen prism: no e"}
    assert small.layout.stage("pulse-01", "rocking").exists()
    assert not small.layout.stage("pulse-01", "predict", "linear").exists()


def test_progress_counts_the_tests_of_each_part_of_the_way(untouched):
    counted = []
    walk = walked(
        untouched,
        "pulse-01",
        "pulse-02",
        until="ingest",
        progress=lambda stage, done, total: counted.append((done, total)),
    )
    assert counted == [(1, 2), (2, 2)]
    assert [stage.action for stage in walk.stages] == ["done", "done"]


def test_what_is_out_of_date_is_found_without_being_done(small):
    assert walk_of(small).stale() == {}
    small.change_a_sample("pulse-02")
    walk = walk_of(small, start_from="ingest")
    assert walk.stale() == {"pulse-02": "its results are out of date (raw file changed); run again"}
    assert walk.stages == []


def test_a_test_that_was_not_run_to_the_end_says_how_far(untouched):
    untouched.run(until="ingest", only="pulse-02")
    untouched.run(until="restitution", only="free-01")
    tests = untouched.summary()["tests"]
    assert {name: test["reason"] for name, test in tests.items()} == {
        "free-01": "run only as far as restitution; `colonnade run` does the rest",
        "free-02": None,
        "pulse-01": None,
        "pulse-02": "run only as far as ingest; `colonnade run` does the rest",
    }


def test_a_chain_is_redone_from_the_first_stage_unless_it_is_only_looked_at(small):
    walk = walk_of(small, start_from="condition")
    steps = walk._steps("measuring", "pulse-01")
    assert walk.chain(steps).start_from == "condition"
    assert walk.chain(steps, redo=False).start_from is None
    pooling = walk.graph.pooling("prism", {})
    assert walk.chain([pooling]).raw == {}
