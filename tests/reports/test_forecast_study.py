"""The study of forecasts: what its numbers promise, and that it gives them again."""

import numpy as np
import pytest

import forecast_study
from colonnade.identification.forecasts import randomised_pit
from forecast_study import MAIN, score_difference
from forecast_trial import WRONG, run_campaign


def check_promises(judged):
    """Coverage is within what chance allows; a wrong e is found both ways by the main score."""
    bands = judged["coverage"]["identified"]
    for low, share, high in zip(bands["low"], bands["share"], bands["high"], strict=True):
        assert low <= share <= high
    for name in ("too high", "too low"):
        assert judged["difference"][name][MAIN]["low"] > 0.0
    assert min(judged["skill"][name][MAIN] for name in ("rigid", "base rate")) > 0.0


def test_the_stored_study_keeps_its_promises(found):
    assert (found["campaigns"] >= 20, found["judged"]["tests"]["count"] >= 200, WRONG) == (True, True, 0.01)
    check_promises(found["judged"])


def test_its_first_tests_come_out_as_stored(found):
    campaign = run_campaign(found["seed"], 0, 2, found["members"])
    for name, values in found["judged"]["pit"].items():
        pit = randomised_pit(
            [test.forecasts[name] for test in campaign.tests], [test.observed for test in campaign.tests]
        )
        np.testing.assert_allclose(pit, values[:2], atol=2.5 / found["members"])


@pytest.mark.whole
def test_a_small_study_finds_skill_over_the_base_rate_and_writes_its_page(tmp_path):
    found = forecast_study.study(6, 7, 1, tests=2, members=10)
    assert found["judged"]["tests"]["count"] == sum(found["judged"]["tests"]["outcomes"]) == 12
    assert found["judged"]["skill"]["base rate"][MAIN] > 0.3
    forecast_study.STUDY.write(found, tmp_path)
    assert "12 tests:" in (tmp_path / "forecast-study.md").read_text(encoding="utf-8")
    assert "6 virtual campaigns with 2 tests each" in (tmp_path / "forecast-study.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_whole_study_gives_its_numbers_again(found):
    again = forecast_study.study(found["campaigns"], found["seed"], forecast_study.WORKERS)
    check_promises(again["judged"])
    for name, row in found["judged"]["scores"].items():
        assert again["judged"]["scores"][name] == pytest.approx(row, abs=0.01)


@pytest.mark.parametrize("campaigns", [6, 20])
def test_an_interval_over_few_skewed_campaigns_holds_the_truth_nearly_as_often_as_it_says(campaigns):
    """Differences of exponential campaigns; plain quantiles of the resampled means hold it in 0.82 for 6 of them."""
    random = np.random.default_rng(2)
    tests = np.repeat(np.arange(campaigns), 4)
    held = 0
    for _ in range(300):
        found = score_difference(
            random.standard_exponential(campaigns)[tests] + random.normal(0, 0.5, tests.size),
            np.ones(tests.size),
            tests,
            resamples=500,
        )
        held += found.low <= 0 <= found.high
    assert 0.86 < held / 300 < 0.99
