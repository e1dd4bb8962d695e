"""What the page of a test says of a model's spread: the one verdict, with the horizon up to which it holds."""

from colonnade.campaign.forms.summary import PredictionSummary
from colonnade.report.test_page.spread import verdict_sentence


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
    told = verdict_sentence("contact", predicted(3.42, None, None, 0.0))
    assert told == "Contact model: predicted up to 3.42 s; not ranked: that needs 20 runs and a measured angle."


def test_without_runs_nothing_is_said():
    assert verdict_sentence("linear", PredictionSummary()) == ""
