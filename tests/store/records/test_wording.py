from __future__ import annotations

from math import inf, nan

import pytest

from colonnade.campaign.forms import summary
from colonnade.store.records import wording


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.41234, "0.412"), (0.0, "0"), (123456.0, "123000"), (2e-6, "2·10⁻⁶"), (nan, "–"), (inf, "–"), (None, "–")],
)
def test_numbers_are_rounded_and_never_nan(value, text):
    assert wording.number(value) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"), [(0.23202, "mm", "232 mm"), (2.0, "mm", "2000 mm"), (nan, "s", "–"), (None, "s", "–")]
)
def test_quantities_carry_their_unit(value, unit, text):
    assert wording.quantity(value, unit) == text


def test_an_acceleration_is_given_in_both_units():
    assert wording.acceleration(9.80665) == "9.81 m/s² (1 g)"
    assert wording.acceleration(nan) == "–"


def test_an_interval_has_as_many_digits_as_its_half_width_allows():
    assert wording.interval(0.97608, 0.97528, 0.97688, 0.95) == "0.9761 ± 0.0008"
    assert wording.interval(0.97608, 0.97528, 0.97688, 0.9) == "0.9761 ± 0.0008 (90\u00a0% interval)"
    assert wording.interval(0.9760003, 0.9759995, 0.9760011, 0.95) == "0.9760003 ± 0.0000008"
    assert wording.interval(0.9, nan, nan, 0.95) == "0.9"
    assert wording.interval(nan, nan, nan, 0.95) == "–"


@pytest.mark.parametrize(
    ("measured", "predicted", "verdict"),
    [
        ("rocking", "rocking", True),
        ("rocking", "overturned", False),
        ("not-overturned", "rocking", True),
        ("not-overturned", "overturned", False),
        ("", "rocking", None),
        ("rocking", "", None),
    ],
)
def test_outcomes_are_compared_only_where_both_are_known(measured, predicted, verdict):
    assert wording.agree(measured, predicted) is verdict


def test_what_is_below_a_thousandth_of_the_critical_angle_is_written_as_that():
    assert [wording.ratio(value) for value in (9.99e-4, 1e-3, 0.0)] == ["< 0.001", "0.001", "0"]
    assert [wording.signed_ratio(value) for value in (-9.99e-4, -0.001, 0.25)] == ["< 0.001", "−0.001", "+0.25"]
    assert wording.signed_ratio(nan) == "–"


def shaken(outcome, peak, **predicted):
    models = {
        model: summary.PredictionSummary(outcome=what, peak_ratio=ratio, within_spread=rank)
        for model, (what, ratio, rank) in predicted.items()
    }
    return summary.TestSummary(
        status="done", kind="earthquake", specimen="prism", outcome=outcome, peak_ratio=peak, predicted=models
    )


@pytest.mark.parametrize(
    ("predicted", "said"),
    [
        (("rocking", 0.275, 0.95), "0.275 ✓"),  # 0.95: the last rank inside the 95 % band
        (("rocking", 0.275, 0.96), "0.275 ≠"),
        (("rocking", 0.275, None), "0.275"),
        (("overturned", None, 0.5), "overturned ≠"),
        (("overturned", None, None), "overturned ≠"),
        (("no-rocking", 0.0, 0.5), "no rocking ≠"),
    ],
)
def test_a_prediction_is_right_inside_the_band_wrong_outside_or_of_another_outcome_else_not_judged(predicted, said):
    assert wording.predicted(shaken("rocking", 0.281, nonlinear=predicted)) == {"nonlinear": said}


def test_what_another_outcome_than_rocking_was_predicted_is_named_with_its_peak():
    said = wording.predicted(
        shaken("overturned", None, linear=("rocking", 0.8, 0.2), nonlinear=("overturned", None, 0.2))
    )
    assert list(said.items()) == [("nonlinear", "overturned ✓"), ("linear", "rocking 0.800 ≠")]
    assert wording.predicted(shaken("rocking", 0.281, linear=(None, None, None))) == {}


def test_a_test_is_said_in_a_few_words():
    assert wording.measured(shaken("rocking", 0.2804)) == "rocking 0.280 α"
    assert wording.measured(shaken("no-rocking", 0.002)) == "no rocking"
    assert wording.measured(shaken("overturned", None)) == "overturned"
    free = summary.TestSummary(
        status="done", kind="free-vibration", specimen="prism", outcome="rocking", peak_ratio=0.557
    )
    known, none = (
        summary.IdentifiedSummary(value=0.97602, low=0.97562, high=0.97642),
        summary.IdentifiedSummary(reason="one peak"),
    )
    assert wording.measured(free.model_copy(update={"restitution": known})) == "e 0.9760 ± 0.0004"
    assert wording.measured(free.model_copy(update={"restitution": known}), 0.9).endswith("0.0004 (90\u00a0% interval)")
    assert wording.measured(free.model_copy(update={"restitution": none})) == "rocking 0.557 α, no e"
    seen = summary.TestSummary(status="pending", kind="sine", specimen="prism", observed_outcome="not-overturned")
    assert wording.measured(seen) == "not overturned (seen)"
    assert wording.measured(seen.model_copy(update={"observed_outcome": None})) == "pending"
    assert wording.measured(seen.model_copy(update={"status": "failed"})) == "failed"
