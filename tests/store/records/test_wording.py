import pytest

from colonnade.campaign.forms import summary
from colonnade.store.records import wording

SHAKEN = {"status": "done", "kind": "earthquake", "specimen": "prism"}


def shaken(outcome, peak, **predicted):
    models = {
        model: summary.PredictionSummary(outcome=what, peak_ratio=ratio, within_spread=rank)
        for model, (what, ratio, rank) in predicted.items()
    }
    return summary.TestSummary(**SHAKEN, outcome=outcome, peak_ratio=peak, predicted=models)


@pytest.mark.parametrize(
    ("predicted", "said"),
    [
        (("rocking", 0.275, 0.95), "0.275 α ✓"),  # 0.95: the last rank inside the 95 % band
        (("rocking", 0.275, 0.96), "0.275 α ≠"),
        (("rocking", 0.275, None), "0.275 α"),
        (("overturned", None, 0.5), "overturned ≠"),
        (("overturned", None, None), "overturned ≠"),
        (("no-rocking", 0.0, 0.5), "no rocking ≠"),
    ],
)
def test_a_prediction_is_right_inside_the_band_wrong_outside_or_of_another_outcome_else_not_judged(predicted, said):
    assert wording.predicted(shaken("rocking", 0.281, nonlinear=predicted)) == {"nonlinear": said}


def test_what_another_outcome_than_rocking_was_predicted_is_named_with_its_peak():
    test = shaken("overturned", None, linear=("rocking", 0.8, 0.2), nonlinear=("overturned", None, 0.2))
    assert list(wording.predicted(test).items()) == [("nonlinear", "overturned ✓"), ("linear", "rocking 0.800 α ≠")]
    assert wording.predicted(shaken("rocking", 0.281, linear=(None, None, None))) == {}


def test_a_test_is_said_in_a_few_words():
    assert wording.measured(shaken("rocking", 0.2804)) == "rocking 0.280 α"
    assert wording.measured(shaken("no-rocking", 0.002)) == "no rocking"
    assert wording.measured(shaken("overturned", None)) == "overturned"
    free = summary.TestSummary(**SHAKEN | {"kind": "free-vibration"}, outcome="rocking", peak_ratio=0.557)
    known = summary.IdentifiedSummary(value=0.97602, low=0.97562, high=0.97642)
    none = summary.IdentifiedSummary(reason="one peak")
    assert wording.measured(free.model_copy(update={"restitution": known})) == "e 0.9760 ± 0.0004"
    assert wording.measured(free.model_copy(update={"restitution": known}), 0.9).endswith("0.0004 (90\u00a0% interval)")
    assert wording.measured(free.model_copy(update={"restitution": none})) == "rocking 0.557 α, no e"
    seen = summary.TestSummary(status="pending", kind="sine", specimen="prism", observed_outcome="not-overturned")
    assert wording.measured(seen) == "not overturned (seen)"
    assert wording.measured(seen.model_copy(update={"observed_outcome": None})) == "pending"
    assert wording.measured(seen.model_copy(update={"status": "failed"})) == "failed"


def prediction(outcome="rocking", nrmse=0.1, rank=None):
    return {"outcome": outcome, "nrmse": nrmse, "within_spread": rank}


TESTS = {
    "right": {"outcome": "rocking", "predicted": {"linear": prediction(rank=0.95)}},
    "wrong": {"outcome": "overturned", "predicted": {"linear": prediction(nrmse=0.3, rank=0.96)}},
    "seen": {
        "outcome": None,
        "observed_outcome": "not-overturned",
        "predicted": {"linear": prediction("no-rocking", nrmse=None)},
    },
    "unknown": {"outcome": None, "predicted": {"linear": prediction("no-rocking", nrmse=None)}},
}


def test_outcomes_misfits_and_spread_are_told_together():
    assert wording.agreement(TESTS) == [
        "The linear model predicts the outcome of 2 of 3 tests. Its misfit (nrmse) is 0.2 at the median and 0.3 at "
        "most, in wrong. 1 of 2 misfits is within its own spread."
    ]


def test_a_spread_that_was_not_computed_is_told():
    (told,) = wording.agreement({"right": {"outcome": "rocking", "predicted": {"linear": prediction()}}})
    assert told.endswith("0.1 at most, in right. Its own spread was not computed.")


@pytest.mark.parametrize(
    "tests",
    [{}, {"a": TESTS["unknown"]}, {"a": {"outcome": "rocking", "predicted": {"linear": prediction(outcome=None)}}}],
    ids=["no test", "outcome not known", "nothing predicted"],
)
def test_without_a_known_outcome_nothing_is_said(tests):
    assert wording.agreement(tests) == []


def test_what_is_told_of_a_body_has_its_units():
    told = dict(wording.lines_of({"bodies": {"top": {"residual_x": -0.0021, "opening_time": 3.2, "peak_ratio": 0.5}}}))
    assert told == {
        "bodies.top.residual_x": "−2.1 mm",
        "bodies.top.opening_time": "3.2 s",
        "bodies.top.peak_ratio": "0.5 α",
    }
