"""The verdict: exact under a true model, the same by hand, and able to see a history that is not one of the runs."""

import numpy as np
import pytest

from colonnade.identification.response.rank import FEWEST, distances, is_within, rank


def histories(random, number, *, length=60):
    """Histories that drift apart, some of them suddenly: their errors are neither normal nor independent."""
    steps = random.standard_normal((number, length)) * np.linspace(0.1, 1.0, length)
    late = random.uniform(size=(number, 1)) < 0.1
    return np.cumsum(steps, axis=1) + late * np.where(np.arange(length) > 40, 25.0, 0.0)


@pytest.mark.parametrize("members", [20, 59])
def test_a_true_model_is_called_outside_as_often_as_it_is_said(members):
    random = np.random.default_rng(members)
    drawn = [histories(random, members + 1) for _ in range(1500)]
    ranks = [rank(found.measured, found.members) for found in (distances(each[0], each[1:]) for each in drawn)]
    nominal = (np.floor(0.95 * members) + 1) / (members + 1)
    allowed = 3.0 * np.sqrt(nominal * (1 - nominal) / len(ranks))
    assert np.mean([is_within(each) for each in ranks]) == pytest.approx(nominal, abs=allowed)
    assert np.mean(ranks) == pytest.approx(0.5, abs=3 * np.sqrt(1 / 12 / len(ranks)))


def test_each_history_is_measured_by_the_median_and_band_of_all_others():
    everyone = histories(np.random.default_rng(5), 31)
    found = distances(everyone[0], everyone[1:])
    for number, expected in enumerate((found.measured, *found.members)):
        low, middle, high = np.quantile(np.delete(everyone, number, axis=0), (0.025, 0.5, 0.975), axis=0)
        deviation = everyone[number] - middle
        half = np.where(deviation > 0, high - middle, middle - low)
        assert expected == pytest.approx((np.abs(deviation) / half).max(), rel=1e-9)


def test_a_history_that_leaves_the_runs_for_a_moment_is_outside():
    random = np.random.default_rng(7)
    everyone = histories(random, 101)
    everyone[0, 20] += 8.0
    found = distances(everyone[0], everyone[1:])
    assert not is_within(rank(found.measured, found.members))


def test_missing_samples_of_the_measured_history_count_for_none():
    everyone = histories(np.random.default_rng(8), 41)
    gap = everyone[0].copy()
    gap[10:20] = np.nan
    found, short = (
        distances(gap, everyone[1:]),
        distances(*(np.delete(each, np.s_[10:20], -1) for each in (gap, everyone[1:]))),
    )
    assert found.measured == short.measured
    np.testing.assert_array_equal(found.members, short.members)


def test_equal_distances_count_by_half():
    assert rank(1.0, np.array([0.5, 1.0, 1.0, 2.0])) == 0.5


def test_without_a_rank_there_is_no_verdict():
    assert is_within(float("nan")) is None
    everyone = histories(np.random.default_rng(9), FEWEST + 1)
    assert distances(everyone[0], everyone[1:]) is not None
    assert distances(everyone[0], everyone[2:]) is None
    assert distances(np.full(60, np.nan), everyone[1:]) is None


@pytest.mark.parametrize(
    ("measured", "members", "message"),
    [
        (np.zeros(5), np.zeros((30, 6)), r"measured has shape \(5,\)"),
        (np.zeros(5), np.full((30, 5), np.nan), "a member is not finite"),
    ],
    ids=["shapes", "not finite"],
)
def test_what_cannot_be_ranked_is_refused(measured, members, message):
    with pytest.raises(ValueError, match=message):
        distances(measured, members)
