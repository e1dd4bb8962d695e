"""β of records and of parameters apart, of a population that has both."""

import numpy as np
import pytest

from colonnade.assessment.fragility.betas import separate_betas
from fragilities.population import Population
from virtual_capacities import MEDIAN, lognormal, outcomes_of

FINE = MEDIAN * np.exp(np.linspace(-2.5, 2.5, 121))


def test_both_are_near_the_truth_and_inside_their_intervals():
    found = separate_betas(lognormal(3, records=150), resamples=500)
    assert found.reason == ""
    assert found.records.low < Population.of_records < found.records.high
    assert found.parameters.low < Population.of_parameters < found.parameters.high
    truth = (Population.of_records, Population.of_parameters)
    assert (found.records.value, found.parameters.value) == pytest.approx(truth, rel=0.12)


def test_with_fine_levels_they_are_those_of_an_analysis_of_variance():
    random = np.random.default_rng(5)
    logs = random.normal(0, 0.5, (30, 1)) + random.normal(0, 0.2, (30, 8))
    found = separate_betas(outcomes_of(MEDIAN * np.exp(logs), FINE), resamples=50)
    within = logs.var(axis=1, ddof=1).mean()
    between = logs.mean(axis=1).var() - within / 8  # maximum likelihood of a balanced design
    assert found.parameters.value == pytest.approx(np.sqrt(within), rel=0.01)
    assert found.records.value == pytest.approx(np.sqrt(between), rel=0.01)


def test_what_cannot_be_separated_is_said():
    random = np.random.default_rng(6)
    records = MEDIAN * np.exp(random.normal(0, 0.4, (20, 1)))
    assert separate_betas(outcomes_of(records), resamples=20).reason == "one draw"
    assert separate_betas(outcomes_of(np.tile(records, 5)), resamples=20).reason == "parameters alike"
    assert separate_betas(outcomes_of(np.tile(records, 5) * 1e6), resamples=20).reason == "no overlap"
