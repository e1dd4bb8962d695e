"""Reliability of probabilities whose truth is known, and how often the consistency bars hold."""

import numpy as np
import pytest
from scipy import stats

from colonnade.identification.calibration import BINS, FEW, FEW_BINS, reliability
from colonnade.identification.forecasts import Forecast, Response

MEMBERS = 100


def forecast(overturned):
    outcomes = np.where(overturned, 2, 1).astype(np.int8)
    return Forecast(outcomes, outcomes / 2)


def certain(share):
    """A forecast of exactly this share of the members."""
    return forecast(np.arange(MEMBERS) < round(share * MEMBERS))


def seen(happened):
    return [Response(2, 1.0) if each else Response(1, 0.5) for each in happened]


def test_bins_have_the_mean_probability_and_the_share_that_overturned():
    shares = [0.0, 0.1, 0.4, 0.5, 0.9, 1.0]
    found = reliability([certain(each) for each in shares], seen([0, 1, 0, 1, 1, 1]), np.arange(6), bins=3)
    assert found.probability == pytest.approx([0.05, 0.45, 0.95])
    assert found.frequency == pytest.approx([0.5, 0.5, 1.0])
    assert found.tests.tolist() == [2, 2, 2]


def test_bins_without_a_test_are_left_out():
    found = reliability([certain(0.1), certain(1.0)], seen([0, 1]), [0, 1], bins=10)
    assert found.probability.tolist() == [0.1, 1.0]


@pytest.mark.parametrize(("tests", "bins"), [(FEW - 1, FEW_BINS), (FEW, BINS)], ids=["few", "many"])
def test_few_tests_have_fewer_bins(tests, bins):
    forecasts = [certain(each) for each in np.linspace(0, 1, tests)]
    assert reliability(forecasts, seen(np.zeros(tests)), np.arange(tests), resamples=10).tests.size == bins


def test_the_bar_of_tests_on_their_own_is_the_binomial_one():
    forecasts = [certain(0.3)] * 60
    found = reliability(forecasts, seen(np.zeros(60)), np.arange(60), bins=1, resamples=10_000)
    low, high = stats.binom.interval(0.95, 60, 0.3)
    assert (found.low[0], found.high[0]) == pytest.approx((low / 60, high / 60), abs=0.02)
    assert found.frequency[0] < found.low[0]


def test_the_bar_of_a_certain_forecast_has_no_width():
    found = reliability([certain(1.0)] * 5, seen([1] * 5), np.arange(5))
    assert (found.low[0], found.high[0]) == (1.0, 1.0)


@pytest.mark.parametrize("shared", [0.0, 0.7], ids=["each test its own error", "campaigns share their error"])
def test_bars_hold_the_frequency_as_often_as_they_say(shared):
    """
    100 studies of 12 campaigns with 10 tests: overturned where a common and an own error together pass a limit, the
    members with the same common error k in all tests of a campaign. One bin, whose bar has to hold 95 %.
    """
    random = np.random.default_rng(4)
    campaigns = np.repeat(np.arange(12), 10)
    held = 0
    for _ in range(100):
        common = np.repeat(random.standard_normal((12, MEMBERS + 1)), 10, axis=0)
        errors = shared * common + np.sqrt(1 - shared**2) * random.standard_normal((120, MEMBERS + 1))
        passed = errors > random.normal(0.0, 1.0, (120, 1))
        forecasts = [forecast(each) for each in passed[:, 1:]]
        found = reliability(forecasts, seen(passed[:, 0]), campaigns, bins=1, resamples=200)
        held += found.low[0] <= found.frequency[0] <= found.high[0]
    assert stats.binom.sf(held - 1, 100, 0.95) > 1e-3
    assert stats.binom.cdf(held, 100, 0.95) > 1e-3


def test_bars_of_campaigns_that_share_their_error_are_wider():
    limits = np.linspace(-1, 1, 30)[:, None]
    common = np.random.default_rng(5).standard_normal(MEMBERS)
    forecasts = [forecast(each) for each in common > limits]
    one, many = (reliability(forecasts, seen(np.zeros(30)), groups, bins=1) for groups in (np.zeros(30), np.arange(30)))
    assert one.high[0] - one.low[0] > 2 * (many.high[0] - many.low[0])


def test_forecasts_and_tests_that_differ_in_number_are_refused():
    with pytest.raises(ValueError, match="1 forecasts and 2 tests"):
        reliability([certain(0.5)], seen([0, 1]), [0])
