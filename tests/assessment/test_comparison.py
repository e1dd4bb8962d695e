"""The measure that decides is found, with how sure that is."""

import numpy as np
import pytest

from colonnade.assessment.comparison import compare_measures
from colonnade.assessment.intervals import Resampling
from virtual_capacities import lognormal


@pytest.fixture(scope="module")
def outcomes():
    return lognormal(4)


@pytest.fixture(scope="module")
def measures(outcomes):
    noise = np.exp(np.random.default_rng(5).normal(0, 1.2, (30, 1, 1)))
    own = np.tile(outcomes.levels[:, None], (30, 1, 1))
    return {"noisy": own * noise, "pgv": own, "unrelated": np.tile(noise, (1, own.shape[1], 1))}


def test_the_measure_that_decides_comes_first_by_every_criterion(outcomes, measures):
    scores = compare_measures(outcomes, measures, Resampling(200))
    assert [each.measure for each in scores] == ["pgv", "noisy", "unrelated"]
    best = scores[0]
    assert best.best > 0.8
    assert scores[0].auc > scores[1].auc > 0.5
    assert scores[0].scatter < scores[1].scatter
    assert sum(each.best for each in scores) == pytest.approx(1.0)


def test_the_auc_is_the_share_of_pairs_in_their_order(outcomes, measures):
    found = compare_measures(outcomes, {"noisy": measures["noisy"]}, Resampling(2))[0].auc
    x = np.broadcast_to(measures["noisy"][:, :, None], outcomes.peak.shape)
    fell, stood = x[outcomes.overturned], x[~outcomes.overturned]
    assert found == pytest.approx(np.mean((fell[:, None] > stood) + 0.5 * (fell[:, None] == stood)))


def test_a_measure_that_leaves_magnitude_to_explain_is_not_sufficient(outcomes, measures):
    magnitude = np.random.default_rng(6).uniform(5, 7.5, 30)
    without = measures["pgv"] * np.exp(-0.8 * (magnitude - 6))[:, None, None]
    both = {"pgv": measures["pgv"], "without": without}
    scores = compare_measures(outcomes, both, Resampling(2), magnitude=magnitude)
    by_name = {each.measure: each for each in scores}
    assert by_name["without"].magnitude < 0.02 < by_name["pgv"].magnitude
    assert by_name["pgv"].distance is None
