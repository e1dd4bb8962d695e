"""Every estimator says what it is, and may be asked in any order."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.estimators.registry import CANDIDATES, ESTIMATORS
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion
from colonnade.identification.restitution.fitting.samples import thinned
from colonnade.identification.restitution.free_vibration import FreeVibration
from prism import PRISM


@pytest.fixture(scope="module")
def record():
    history = rock(PRISM, restitution=0.95, theta0=0.6 * PRISM.critical_angle, duration=10.0, model="nonlinear")
    angle = history.angle + np.random.default_rng(1).normal(0.0, 1e-4, history.angle.size)
    return FreeVibration.seen(thinned(history.time, angle, PRISM), PRISM, lowest_amplitude=0.02, noise=None)


@pytest.mark.parametrize("estimator", ESTIMATORS.values(), ids=list(ESTIMATORS))
def test_an_estimator_names_itself_and_its_estimate(estimator, record):
    assert all((estimator.label, estimator.assumptions, estimator.description))
    estimate = replace(record, fits={}).fitted(estimator).estimate
    assert estimate.name == estimator.name
    assert estimate.assumptions.startswith(estimator.assumptions)
    assert estimate.value == pytest.approx(0.95, abs=3e-4)


@pytest.mark.parametrize("estimator", ESTIMATORS.values(), ids=list(ESTIMATORS))
def test_a_refusal_has_its_reason_and_no_value(estimator):
    refused = estimator.refuse(0.95, "too short")
    assert (refused.estimate.value, refused.estimate.reason, refused.objection) == (None, "too short", "too short")
    assert refused.zero_offset == 0.0


def test_candidates_have_a_method_and_are_in_their_order():
    assert [each.name for each in CANDIDATES] == ["history-scatter", "peaks"]
    assert all(each.method for each in CANDIDATES)


def test_on_a_moving_table_only_those_that_follow_it_are_asked(record):
    moving = replace(record, base=BaseMotion(np.zeros(4), 0.0, 1.0), fits={})
    refused = {name for name, each in ESTIMATORS.items() if "table moves" in moving.fitted(each).estimate.reason}
    assert refused == set(ESTIMATORS) - {"history-scatter"}
