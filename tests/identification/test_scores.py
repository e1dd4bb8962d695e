"""Scores against closed forms, quadrature and their own definitions."""

from itertools import product
from math import comb, log

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from colonnade.identification.forecasts import (
    OUTCOMES,
    Forecast,
    Response,
    brier_score,
    crps,
    logarithmic_score,
    ranked_probability_score,
    skill,
)
from every import every

AMPLITUDES = st.lists(st.floats(0, 1), min_size=2, max_size=12)


def forecast(outcomes, amplitudes=None):
    return Forecast(np.array(outcomes, dtype=np.int8), np.array(outcomes if amplitudes is None else amplitudes, float))


@pytest.mark.parametrize("members", [1, 2, 100])
def test_crps_of_a_point_mass_is_its_error(members):
    assert crps([0.3] * members, 0.75) == pytest.approx(0.45, abs=1e-15)
    assert crps([0.3] * members, 0.3) == 0.0


@given(AMPLITUDES, st.floats(0, 1))
def test_crps_is_the_area_between_the_distributions_but_for_the_size_of_the_ensemble(members, observed):
    """∫ (F(x) − 1{x ≥ y})² dx (Matheson and Winkler 1976) has m² in place of m (m − 1)."""
    edges = np.unique([*members, observed])
    share = np.searchsorted(np.sort(members), edges[:-1], side="right") / len(members)
    area = float(((share - (edges[:-1] >= observed)) ** 2) @ np.diff(edges))
    half = np.abs(np.subtract.outer(members, members)).mean() / 2
    assert crps(members, observed) == pytest.approx(area - half / (len(members) - 1), abs=1e-12)


def test_crps_of_few_members_has_the_mean_of_the_whole_normal_distribution():
    """Gneiting and Raftery (2007), section 4.2: of a normal forecast, z (2Φ − 1) + 2φ − 1/√π."""
    z = 0.7
    whole = z * (2 * stats.norm.cdf(z) - 1) + 2 * stats.norm.pdf(z) - 1 / np.sqrt(np.pi)
    draws = np.random.default_rng(0).standard_normal((5000, 4))
    found = np.array([crps(members, z) for members in draws])
    assert found.mean() == pytest.approx(whole, abs=3 * found.std() / np.sqrt(found.size))


@every(("members", "probability"), list(product([1, 2, 7], [0.0, 0.2, 1.0])))
def test_brier_score_of_few_members_has_the_mean_of_the_probability_itself(members, probability):
    """Over all counts that the members can give, each with its binomial probability; one member is a plain forecast."""
    chance = [comb(members, k) * probability**k * (1 - probability) ** (members - k) for k in range(members + 1)]
    spread = probability * (1 - probability) if members == 1 else 0.0
    for happened in (False, True):
        mean = sum(c * brier_score(k, members, happened=happened) for k, c in enumerate(chance))
        assert mean == pytest.approx((probability - happened) ** 2 + spread, abs=1e-12)


def test_ranked_probability_score_of_certain_forecasts_counts_the_steps_between_outcomes():
    for said, seen in product(range(len(OUTCOMES)), repeat=2):
        found = ranked_probability_score(forecast([said] * 5), Response(seen, 0.5))
        assert found == abs(said - seen)


def test_ranked_probability_score_of_an_example_by_hand():
    """Epstein (1969): cumulative shares 1/4, 3/4, 1 against 0, 1, 1, less the spread of four members."""
    found = ranked_probability_score(forecast([0, 1, 1, 2]), Response(1, 0.5))
    assert found == pytest.approx(2 * (1 / 16 - 3 / 16 / 3), abs=1e-15)


@pytest.mark.parametrize("happened", [False, True])
def test_logarithmic_score_is_never_infinite(happened):
    assert logarithmic_score(0 if happened else 100, 100, happened=happened) == pytest.approx(log(202))
    assert logarithmic_score(100 if happened else 0, 100, happened=happened) == pytest.approx(-log(1 - 1 / 202))


def test_logarithmic_score_takes_the_mean_of_jeffreys_posterior():
    assert logarithmic_score(3, 10, happened=True) == pytest.approx(-log(stats.beta(3.5, 7.5).mean()))


@given(st.floats(0.01, 0.99))
def test_the_probability_that_is_true_has_the_best_mean_score(truth):
    """Proper: of all shares of 1000 members, the true one has the smallest mean score, to the step of the shares."""
    shares = np.arange(0, 1001, 5)
    for rule in (brier_score, logarithmic_score):
        means = [
            truth * rule(k, 1000, happened=True) + (1 - truth) * rule(k, 1000, happened=False) for k in shares.tolist()
        ]
        assert shares[int(np.argmin(means))] / 1000 == pytest.approx(truth, abs=0.006)


@pytest.mark.parametrize(
    ("scores", "reference", "value"),
    [
        pytest.param([0.0, 0.0], [0.1, 0.3], 1.0, id="perfect"),
        pytest.param([0.1, 0.3], [0.3, 0.1], 0.0, id="as good"),
        pytest.param([0.6, 0.6], [0.1, 0.3], -2.0, id="worse"),
        pytest.param([0.1, 0.2], [0.0, 0.0], np.nan, id="beside a perfect reference"),
    ],
)
def test_skill_is_what_is_saved_of_the_score_of_the_reference(scores, reference, value):
    assert skill(np.array(scores), np.array(reference)) == pytest.approx(value, abs=1e-12, nan_ok=True)
