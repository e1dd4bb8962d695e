"""Estimators: each by its name, with its estimate, its bounds and its refusals."""

from dataclasses import dataclass, replace
from math import exp, log

import numpy as np
import pytest

from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.estimators.registry import CANDIDATES, ESTIMATORS
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion
from colonnade.identification.restitution.fitting.mixture import Mean
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


MEAN = Mean(log(0.95), log(0.94), log(0.96), 0.005, 0.0)


@dataclass(frozen=True)
class Told(Fit):
    """A fit with something of its own."""

    more: str = "nothing"


class Guess(Estimator[Told]):
    """An estimator that does not look at its record."""

    name = "guess"
    label = "a guess"
    assumptions = "luck"
    description = "made for a test"
    result = Told

    def fit(self, record):
        return Told(self.estimate_of(MEAN, 0.9), more=str(record))


def test_an_estimate_has_e_and_its_bounds_from_their_logarithms():
    estimate = Guess().estimate_of(MEAN, 0.9)
    assert (estimate.value, estimate.low, estimate.high) == pytest.approx((0.95, 0.94, 0.96), rel=1e-14)
    # By the derivative of the exponential.
    assert estimate.standard_error == pytest.approx(0.95 * 0.005, rel=1e-14)
    assert (estimate.name, estimate.level, estimate.assumptions) == ("guess", 0.9, "luck")
    assert (estimate.reason, estimate.residual) == ("", None)


def test_an_estimate_is_not_symmetric_where_its_logarithm_is():
    estimate = Guess().estimate_of(Mean(log(0.8), log(0.8) - 0.2, log(0.8) + 0.2, 0.1, 0.0), 0.95)
    assert estimate.low * estimate.high == pytest.approx(0.64)
    assert estimate.high - estimate.value == pytest.approx(0.8 * (exp(0.2) - 1))


def test_an_estimate_says_what_was_freed_and_what_was_left_over():
    estimate = Guess().estimate_of(MEAN, 0.95, residual=1e-4, freed="p freed")
    assert estimate.assumptions == "luck; p freed"
    assert estimate.residual == 1e-4
