"""PIT and coverage where the answer is known."""

import numpy as np
import pytest
from scipy import stats

from colonnade.identification.forecasts import Forecast, Response, coverage, randomised_pit

TESTS, MEMBERS = 600, 19


def forecast(amplitudes):
    values = np.clip(amplitudes, 0.0, 1.0)
    return Forecast((values > 0).astype(np.int8) + (values >= 1), values)


def drawn(random, *, shift=0.0, spread=1.0, tests=TESTS):
    """Forecasts, and observations that are drawn as their members, or not; a third does not rock, a third overturns."""
    centre = random.normal(0.5, 0.8, tests)
    forecasts = [forecast(random.normal(each, 0.3, MEMBERS)) for each in centre]
    seen = np.clip(random.normal(centre + shift, 0.3 * spread), 0.0, 1.0)
    return forecasts, [Response(int(each > 0) + int(each >= 1), float(each)) for each in seen]


def test_pit_of_forecasts_that_are_right_is_even_in_spite_of_atoms():
    forecasts, observed = drawn(np.random.default_rng(0))
    assert sum(each.amplitude in (0.0, 1.0) for each in observed) > TESTS / 3
    assert stats.kstest(randomised_pit(forecasts, observed), "uniform").pvalue > 0.01


@pytest.mark.parametrize("wrong", [{"shift": 0.2}, {"spread": 2.0}], ids=["too low", "too narrow"])
def test_pit_of_forecasts_that_are_wrong_is_not(wrong):
    assert stats.kstest(randomised_pit(*drawn(np.random.default_rng(0), **wrong)), "uniform").pvalue < 1e-3


def test_pit_between_members_is_within_their_step_of_the_rank():
    """Members 0.1 … 0.9 and 0.45: four below, none equal: 4/10 to 5/10."""
    members = forecast(np.arange(1, 10) / 10)
    values = [randomised_pit([members], [Response(1, 0.45)], seed=seed)[0] for seed in range(200)]
    assert 0.4 <= min(values) < 0.41
    assert 0.49 < max(values) <= 0.5


def test_the_same_seed_gives_the_same_values_and_further_tests_change_none():
    forecasts, observed = drawn(np.random.default_rng(1), tests=20)
    first = randomised_pit(forecasts, observed, seed=5)
    assert randomised_pit(forecasts[:12], observed[:12], seed=5).tolist() == first[:12].tolist()
    assert randomised_pit(forecasts, observed, seed=6).tolist() != first.tolist()


def test_bands_hold_their_share_of_tests_and_the_interval_is_the_binomial_one():
    forecasts, observed = drawn(np.random.default_rng(2))
    found = coverage(randomised_pit(forecasts, observed), forecasts, np.arange(TESTS))
    assert found["band"].tolist() == [0.5, 0.8, 0.95]
    assert ((found["low"] <= found["share"]) & (found["share"] <= found["high"])).all()
    low, high = stats.binom.interval(0.95, TESTS, found["band"])
    assert found["low"] == pytest.approx(low / TESTS, abs=0.015)
    assert found["high"] == pytest.approx(high / TESTS, abs=0.015)


def test_bands_of_forecasts_that_are_too_narrow_hold_too_few():
    forecasts, observed = drawn(np.random.default_rng(2), spread=2.0)
    found = coverage(randomised_pit(forecasts, observed), forecasts, np.arange(TESTS))
    assert (found["share"] < found["low"]).all()


def test_a_campaign_whose_tests_share_their_error_has_a_wider_interval():
    """Member k is off by the same amount in all tests: the whole campaign is inside or outside."""
    random = np.random.default_rng(3)
    forecasts = [forecast(0.5 + 0.1 * stats.norm.ppf((np.arange(MEMBERS) + 0.5) / MEMBERS))] * 50
    shared = coverage(random.random(50), forecasts, np.zeros(50))
    alone = coverage(random.random(50), forecasts, np.arange(50))
    assert (shared["low"][0], shared["high"][0]) == pytest.approx((0.0, 1.0), abs=0.2)
    assert alone["high"][0] - alone["low"][0] < 0.35
