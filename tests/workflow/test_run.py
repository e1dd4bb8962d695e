"""What a run does of what is asked for, what a slip of the pen is answered with, and numbers at their bounds."""

import pytest

from colonnade.campaign.syntax.fields import BETWEEN, CONVERSION
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


def bounds(kind, unit):
    return [f'"{value:g} {unit}"' for value in BETWEEN[kind]]


MASS = 'mass = "26.10 kg"}'
SETTINGS = dict.fromkeys(("sampling_rate", "lowpass", "base_lowpass"), bounds("frequency", "Hz"))
SETTINGS |= dict.fromkeys(("flat_duration", "rest_duration", "longest_offset"), bounds("time", "s"))
SETTINGS |= dict.fromkeys(("spike_threshold", "gap"), (1.0000001, 999.9))
SETTINGS |= dict.fromkeys(("predict.ensemble.critical_angle", "predict.ensemble.p"), (5e-324, 0.5))
SETTINGS |= {
    "jitter": [5e-324, 0.9999999999999999],
    "restitution.lowest_amplitude": [1.0000001e-6, 0.9999999999999999],
    "restitution.level": [0.5000000000000001, 0.9999989],
    "predict.rest_angle": [1.0000001e-10, 0.09999999],
    "predict.ensemble.filter": [5e-324, 0.5],
}
PLACES = {
    **{f"processing.{key} = {{}}\n\n[specimens]": ("[specimens]", both) for key, both in SETTINGS.items()},
    "mass = {}}}": (MASS, bounds("mass", "kg")),
    MASS.replace("}", ", scale = {}}}"): (MASS, [1.0, 999.0]),
    MASS.replace("}", ", restitution = {}}}"): (MASS, [5e-324, 1.0]),
    "gravity = {}\n\n[specimens]": ("[specimens]", bounds("acceleration", "m/s^2")),
    'unit = "mm", gain = {}, on': ('unit = "mm", on', [1e3 * CONVERSION[0], CONVERSION[1]]),
}
CASES = [(before, after.format(value)) for after, (before, both) in PLACES.items() for value in both]


@pytest.mark.slow
@pytest.mark.parametrize(("before", "after"), CASES, ids=[" ".join(after.split())[:60] for _, after in CASES])
def test_numbers_at_their_bounds_give_results_or_a_refusal(untouched, before, after):
    untouched.edit("[processing.predict.ensemble]\nmembers = 20\n", "")
    untouched.edit(before, f"processing.predict.ensemble.members = 20\n{after}" if before == "[specimens]" else after)
    try:
        stages = untouched.run(only=["free-01"], until="compare").stages
    except CampaignError as refused:
        assert "expected" in str(refused)  # noqa: PT017
        return
    assert not [stage.reason for stage in stages if "Internal error" in stage.reason]
