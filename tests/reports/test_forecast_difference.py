"""The interval of a difference of scores over campaigns."""

import numpy as np
import pytest

from forecast_study import FEWEST_CAMPAIGNS, score_difference


def test_a_difference_that_never_varies_is_certain():
    found = score_difference(np.full(30, 0.5), np.full(30, 0.2), np.repeat(np.arange(10), 3))
    assert (found.value, found.low, found.high) == pytest.approx((0.3, 0.3, 0.3), abs=1e-12)


def test_every_test_counts_the_same_whatever_the_size_of_its_campaign():
    campaigns = np.repeat(np.arange(6), [1, 2, 3, 4, 5, 15])
    scores = (campaigns == 5).astype(float)
    assert score_difference(scores, np.zeros(30), campaigns).value == pytest.approx(0.5, abs=1e-12)


def test_an_interval_over_campaigns_is_as_wide_as_their_means_scatter():
    """Students's interval of 40 campaign means; ten tests of one campaign are all alike, so that they count as one."""
    means = np.random.default_rng(1).normal(0.2, 1.0, 40)
    found = score_difference(np.repeat(means, 10), np.zeros(400), np.repeat(np.arange(40), 10))
    half = 2.0227 * means.std(ddof=1) / np.sqrt(40)  # Student's t of 39, 97.5 %
    assert found.value == pytest.approx(means.mean())
    assert (found.high - found.low) / 2 == pytest.approx(half, rel=0.05)


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


def test_the_same_seed_gives_the_same_interval():
    scores, campaigns = np.random.default_rng(3).random(40), np.repeat(np.arange(8), 5)
    first, again, other = (score_difference(scores, np.zeros(40), campaigns, seed=seed) for seed in (1, 1, 2))
    assert first == again != other


@pytest.mark.parametrize(
    ("campaigns", "said"),
    [
        pytest.param(np.arange(FEWEST_CAMPAIGNS - 1), "5 campaigns; at least 6", id="too few campaigns"),
        pytest.param(np.arange(3), "campaigns has shape", id="not one for each test"),
    ],
)
def test_an_interval_that_cannot_be_had_is_refused(campaigns, said):
    with pytest.raises(ValueError, match=said):
        score_difference(np.zeros(FEWEST_CAMPAIGNS - 1), np.zeros(FEWEST_CAMPAIGNS - 1), campaigns)
