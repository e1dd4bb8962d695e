"""One call gives all of it, and what the outcomes do not give is None."""

import numpy as np
import pytest

from colonnade.assessment.fragility.curves.hazard import hazard_curve
from colonnade.assessment.fragility.summary import summarise
from virtual_capacities import MEDIAN, lognormal, outcomes_of


def test_everything_is_of_the_same_outcomes():
    outcomes = lognormal(1)
    found = summarise(
        outcomes,
        threshold=(1.8, 1.9),
        hazard=hazard_curve([0.05, 2.0], [1e-1, 1e-5]),
        measures={"pgv": outcomes.intensity},
        magnitude=np.linspace(5, 7, 30),
        resamples=100,
    )
    assert found.lognormal.median.low < MEDIAN < found.lognormal.median.high
    total = np.hypot(found.betas.records.value, found.betas.parameters.value)
    assert total == pytest.approx(found.lognormal.beta.value, rel=0.1)
    assert found.rate.rate.low < found.influence.rate.mean() < found.rate.rate.high
    assert (found.uplift.threshold, found.resurrection.pairs, found.measures.scores[0].name) == ((1.8, 1.9), 0.0, "pgv")
    assert found.misfit.intensity == pytest.approx(found.isotonic.intensity)


def test_without_a_curve_the_isotonic_one_and_the_reason_remain():
    found = summarise(outcomes_of(np.full((4, 3), MEDIAN)), hazard=hazard_curve([0.1, 1.0], [1.0, 0.1]), resamples=20)
    assert (found.lognormal.reason, found.rate, found.measures) == ("separated", None, None)
    assert found.isotonic.probability.value.tolist() == [0.0] * 5 + [1.0] * 5
    assert found.taken == "isotonic"
    assert found.reaches(0.5) == found.isotonic.reaches(0.5)


def test_answers_are_read_from_the_lognormal_curve_if_it_fits():
    found = summarise(lognormal(1), measure="pgv", resamples=100)
    assert found.taken == "lognormal"
    assert found.reaches(0.5) == pytest.approx(found.lognormal.median, rel=1e-6)
    assert found.digest()["median"].endswith("m/s")
