"""The sections of a test's page: each of that test, with numbers, units and reasons, and nothing where nothing is."""

import pytest

from colonnade.campaign.forms.summary import PredictionSummary
from colonnade.report.test_page import channels, page
from colonnade.report.test_page.page import verdict_sentence


def found_of(reported, name):
    return dict(page.measured_of(reported[name]))


def test_the_largest_angle_is_the_stored_one_in_mrad(reported):
    said = found_of(reported, "span-2.0")
    peak = abs(reported["span-2.0"].stored.value("rocking", "peak_angle"))
    value, unit = said["largest |θ|"].split()
    assert (float(value), unit) == (pytest.approx(1e3 * peak, rel=1e-3), "mrad")
    assert said["peak base acceleration"].endswith(" g)")


def test_a_free_vibration_has_its_release_and_what_predictions_use(reported):
    said = found_of(reported, "free-01")
    assert "largest |θ|, release included" in said
    assert "largest |θ|" not in said
    assert float(said["released at |θ|/α"]) == pytest.approx(0.5, abs=0.01)
    assert "predictions use" in said


def test_a_few_flagged_samples_are_told_from_many(reported):
    (few, *_), (many, *_) = (channels.of_test(reported[name].stored) for name in ("span-2.0", "span-2.5"))
    assert (few["name"], few["few_flagged"], many["few_flagged"]) == ("top", True, False)  # 1 of 1625 in the first


def test_a_clock_is_given_in_milliseconds_and_its_drift_in_millionths():
    assert channels._clock({"clock_offset": 0.0}) == channels._clock({"clock_rate_ppm": "unknown"}) == "–"
    late = {"clock_offset": 0.0201}
    assert channels._clock(late | {"clock_offset_standard_error": 2e-4}) == "20.10 ms ± 0.20 ms"
    assert channels._clock(late | {"clock_rate_ppm": -3.2}) == "20.10 ms, −3.2 ppm"


def predicted(horizon, rank, peak_rank, overturning):
    return PredictionSummary(
        horizon=horizon, within_spread=rank, peak_rank=peak_rank, overturning_probability=overturning
    )


def test_a_rank_within_the_limit_is_within_and_one_above_it_outside():
    told = verdict_sentence("linear", predicted(3.42, 0.95, 0.5, 0.0))
    assert told == (
        "Linear model: the measured angle is within its own spread up to 3.42 s (95\u00a0% of the runs are closer "
        "to their median; 50\u00a0% stay below the measured peak)."
    )
    told = verdict_sentence("linear", predicted(3.42, 0.96, 1.0, 0.12))
    assert "is outside its own spread" in told
    assert "12\u00a0% overturn" in told


def test_without_runs_enough_there_is_a_horizon_and_no_verdict():
    assert verdict_sentence("linear", PredictionSummary()) == ""
    told = verdict_sentence("contact", predicted(3.42, None, None, 0.0))
    assert told == "Contact model: predicted up to 3.42 s; not ranked: that needs 20 runs and a measured angle."
