"""What all estimators share, shown on one that is made for it."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log

import pytest

from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.fitting.mixture import Mean
from colonnade.identification.restitution.result import Estimate

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


def test_a_refusal_is_of_the_estimators_own_kind():
    refused = Guess().refuse(0.9, "too short")
    assert refused == Told(Estimate("guess", None, None, None, None, 0.9, "luck", "too short"), None, "nothing")
    assert refused.objection == "too short"


def test_a_fit_with_a_value_has_no_objection_and_no_zero_offset_of_its_own():
    found = Guess().fit("a record")
    assert (found.objection, found.zero_offset, found.more) == ("", 0.0, "a record")


def test_an_estimator_is_not_recommended_nor_asked_on_a_moving_table_unless_it_says_so():
    assert (Guess.priority, Guess.follows_table, Guess.method, Guess.references) == (0, False, "", ())


def test_an_estimator_without_a_fit_cannot_be_made():
    class Nothing(Estimator[Fit]):
        name = label = assumptions = description = "nothing"

    with pytest.raises(TypeError, match="fit"):
        Nothing()
