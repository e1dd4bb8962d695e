"""What a run does of what is asked for, what it takes, and what a slip of the pen is answered with."""

import pytest

from colonnade.errors import CampaignError


def test_until_stops_after_a_stage_and_the_rest_is_pending(untouched):
    result = untouched.run(until="condition")
    assert {stage.stage for stage in result.stages} == {"ingest", "condition"}
    assert {test["status"] for test in untouched.summary()["tests"].values()} == {"pending"}
    assert result.report is None


@pytest.mark.parametrize("only", [["pulse-01"], "pulse-01"], ids=["a list", "one alone"])
def test_only_runs_the_tests_that_are_named_and_the_rest_is_pending(untouched, only):
    result = untouched.run(only=only, until="rocking")
    assert {stage.subject for stage in result.stages} == {"pulse-01"}
    assert not untouched.layout.test("pulse-02").exists()
    assert untouched.summary()["tests"]["pulse-02"]["status"] == "pending"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"until": "restitutoin"}, 'Did you mean "restitution"?'),
        ({"start_from": "ingets"}, 'Did you mean "ingest"?'),
        ({"only": ["puls-01"]}, 'Did you mean "pulse-01"?'),
        ({"start_from": "predict", "until": "rocking"}, "the last stage comes before the first"),
    ],
)
def test_a_slip_is_refused_with_the_nearest_name_and_nothing_is_written(untouched, options, said):
    with pytest.raises(CampaignError) as caught:
        untouched.run(**options)
    assert said in str(caught.value)
    assert not untouched.layout.processed.exists()


def test_progress_tells_each_stage_that_ended_and_counts_the_tests(untouched):
    told = []
    result = untouched.run(until="ingest", progress=lambda *step: told.append(step))
    assert told == [(stage, done, 4) for done, stage in enumerate(result.stages, 1)]


def test_only_an_earthquake_takes_the_restitution_of_its_specimens_free_vibrations(untouched, undisturbed):
    stages = untouched.run(only=["pulse-01"]).stages
    assert ("free-01", "predict") not in {(stage.subject, stage.stage) for stage in stages}
    predicted = [small.summary()["tests"]["pulse-01"]["predicted"]["linear"] for small in (untouched, undisturbed)]
    assert predicted[0] == predicted[1]


@pytest.mark.parametrize("options", [{"only": ["pulse-01"]}, {"until": "ingest"}], ids=["only", "until"])
def test_a_test_whose_results_are_out_of_date_is_pending(small, options):
    small.edit("456 mm", "400 mm")
    small.run(**options)
    told = small.summary()["tests"]["pulse-02"]
    assert told["status"] == "pending"
    assert told["reason"] == "its results are missing or out of date; `colonnade run` makes them"
