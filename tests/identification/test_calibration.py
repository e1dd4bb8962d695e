"""PIT and coverage where the answer is known."""

import numpy as np
import pytest
from scipy import stats

from colonnade.identification import calibration
from colonnade.identification.calibration import BINS, FEW, FEW_BINS, coverage, randomised_pit, reliability
from colonnade.identification.forecasts import Forecast, Response

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
    assert found.band.tolist() == [0.5, 0.8, 0.95]
    assert ((found.low <= found.share) & (found.share <= found.high)).all()
    low, high = stats.binom.interval(0.95, TESTS, found.band)
    assert found.low == pytest.approx(low / TESTS, abs=0.015)
    assert found.high == pytest.approx(high / TESTS, abs=0.015)


def test_bands_of_forecasts_that_are_too_narrow_hold_too_few():
    forecasts, observed = drawn(np.random.default_rng(2), spread=2.0)
    found = coverage(randomised_pit(forecasts, observed), forecasts, np.arange(TESTS))
    assert (found.share < found.low).all()


def test_a_campaign_whose_tests_share_their_error_has_a_wider_interval():
    """Member k is off by the same amount in all tests: the whole campaign is inside or outside."""
    random = np.random.default_rng(3)
    forecasts = [forecast(0.5 + 0.1 * stats.norm.ppf((np.arange(MEMBERS) + 0.5) / MEMBERS))] * 50
    shared = coverage(random.random(50), forecasts, np.zeros(50))
    alone = coverage(random.random(50), forecasts, np.arange(50))
    assert (shared.low[0], shared.high[0]) == pytest.approx((0.0, 1.0), abs=0.2)
    assert alone.high[0] - alone.low[0] < 0.35


RESAMPLED = 100


def overturning_forecast(overturned):
    outcomes = np.where(overturned, 2, 1).astype(np.int8)
    return Forecast(outcomes, outcomes / 2)


def certain(share):
    """A forecast of exactly this share of the members."""
    return overturning_forecast(np.arange(RESAMPLED) < round(share * RESAMPLED))


def seen(happened):
    return [Response(2, 1.0) if each else Response(1, 0.5) for each in happened]


def test_bins_have_the_mean_probability_and_the_share_that_overturned():
    shares = [0.0, 0.1, 0.4, 0.5, 0.9, 1.0]
    found = reliability([certain(each) for each in shares], seen([0, 1, 0, 1, 1, 1]), np.arange(6))
    assert found.probability == pytest.approx([0.05, 0.45, 0.95])
    assert found.frequency == pytest.approx([0.5, 0.5, 1.0])
    assert found.tests.tolist() == [2, 2, 2]


def test_bins_without_a_test_are_left_out():
    found = reliability([certain(0.1), certain(1.0)], seen([0, 1]), [0, 1])
    assert found.probability.tolist() == [0.1, 1.0]


@pytest.mark.parametrize(("tests", "bins"), [(FEW - 1, FEW_BINS), (FEW, BINS)], ids=["few", "many"])
def test_few_tests_have_fewer_bins(tests, bins):
    forecasts = [certain(each) for each in np.linspace(0, 1, tests)]
    assert reliability(forecasts, seen(np.zeros(tests)), np.arange(tests)).tests.size == bins


def test_the_bar_of_tests_on_their_own_is_the_binomial_one():
    forecasts = [certain(0.3)] * 60
    found = reliability(forecasts, seen(np.zeros(60)), np.arange(60))
    low, high = stats.binom.interval(0.95, 60, 0.3)
    assert (found.low[0], found.high[0]) == pytest.approx((low / 60, high / 60), abs=0.02)
    assert found.frequency[0] < found.low[0]


def test_the_bar_of_a_certain_forecast_has_no_width():
    found = reliability([certain(1.0)] * 5, seen([1] * 5), np.arange(5))
    assert (found.low[0], found.high[0]) == (1.0, 1.0)


@pytest.mark.parametrize("shared", [0.0, 0.7], ids=["each test its own error", "campaigns share their error"])
def test_bars_hold_the_frequency_as_often_as_they_say(monkeypatch, shared):
    """
    100 studies of 12 campaigns with 10 tests: overturned where a common and an own error together pass a limit, the
    members with the same common error k in all tests of a campaign. One bin, whose bar has to hold 95 %.
    """
    monkeypatch.setattr(calibration, "BINS", 1)
    random = np.random.default_rng(4)
    campaigns = np.repeat(np.arange(12), 10)
    held = 0
    for _ in range(100):
        common = np.repeat(random.standard_normal((12, RESAMPLED + 1)), 10, axis=0)
        errors = shared * common + np.sqrt(1 - shared**2) * random.standard_normal((120, RESAMPLED + 1))
        passed = errors > random.normal(0.0, 1.0, (120, 1))
        forecasts = [overturning_forecast(each) for each in passed[:, 1:]]
        found = reliability(forecasts, seen(passed[:, 0]), campaigns)
        held += found.low[0] <= found.frequency[0] <= found.high[0]
    assert stats.binom.sf(held - 1, 100, 0.95) > 1e-3
    assert stats.binom.cdf(held, 100, 0.95) > 1e-3
