"""Advice on free vibrations and on earthquakes: enough, how many more, and from where."""

import numpy as np
import pytest

from colonnade.identification.advice import advise_free_vibration, advise_span
from colonnade.identification.restitution.pooling import pool

WANTED = {"wanted_half_width": 0.001, "largest_release": 0.7}


def test_the_predicted_half_width_is_that_of_virtual_tests():
    rng = np.random.default_rng(0)
    error, scatter, tests = 5e-4, 1e-3, 6
    halves, predicted = [], []
    for _ in range(100):
        e = 0.97 + rng.normal(0, np.hypot(error, scatter), tests + 3)
        first = advise_free_vibration(e[:tests], [error] * tests, [0.7] * tests, **WANTED)
        later = pool(e, [error] * (tests + 3))
        predicted.append(first.predicted_half_width[2])
        halves.append((later.high - later.low) / 2)
    assert np.mean(predicted) == pytest.approx(np.mean(halves), rel=0.1)


def test_agreeing_tests_are_enough_and_scattered_ones_are_not():
    agreeing = advise_free_vibration([0.9760, 0.9761, 0.9759], [2e-4] * 3, [0.6, 0.6, 0.6], **WANTED)
    scattered = advise_free_vibration([0.974, 0.979, 0.976], [2e-4] * 3, [0.6, 0.6, 0.6], **WANTED)
    assert agreeing.is_enough
    assert agreeing.needed == 0
    assert not scattered.is_enough
    assert scattered.needed is None or scattered.needed > 5


def test_one_test_is_never_enough():
    advice = advise_free_vibration([0.976], [1e-5], [0.6], **WANTED)
    assert not advice.is_enough
    assert advice.needed is not None
    assert advice.needed >= 1


def test_a_larger_release_is_expected_to_give_a_smaller_interval():
    small, same = (
        advise_free_vibration([0.97, 0.97], [3e-3] * 2, [release] * 2, **WANTED).predicted_half_width[0]
        for release in (0.3, 0.7)
    )
    assert small < 0.9 * same


SPANS = [1.5, 2.0, 2.5, 3.0]
ROCKING, OVERTURNING = np.array([0.0, 0.6, 0.8, 0.5]), np.array([0.0, 0.0, 0.2, 0.5])


def test_the_least_certain_outcome_is_advised():
    advice = advise_span(SPANS, ROCKING, OVERTURNING, largest_risk=1.0)
    assert (advice.span, advice.probabilities) == (3.0, (0.0, 0.5, 0.5))
    assert advice.entropy == pytest.approx(1.0)
    assert not advice.is_enough


def test_three_possible_outcomes_are_less_certain_than_two():
    advice = advise_span([1.0, 2.0], np.array([1 / 3, 0.5]), np.array([1 / 3, 0.5]), largest_risk=1.0)
    assert advice.span == 1.0
    assert advice.entropy == pytest.approx(1.585, abs=1e-3)


def test_the_risk_leaves_the_span_below():
    assert advise_span(SPANS, ROCKING, OVERTURNING, largest_risk=0.3).span == 2.0


def test_certain_outcomes_are_enough():
    assert advise_span([1.0, 2.0], np.array([0.9, 0.0]), np.array([0.05, 1.0]), largest_risk=1.0).span == 1.0
    assert advise_span([1.0, 2.0], np.array([1.0, 0.0]), np.array([0.0, 1.0]), largest_risk=0.5).is_enough


@pytest.mark.parametrize(
    ("overturning", "risk", "is_step"), [([0.0, 0.0], 0.5, True), ([0.0, 0.02], 0.01, False), ([0.0, 1.0], 0.5, False)]
)
def test_where_it_surely_stands_at_every_span_the_last_is_a_step(overturning, risk, is_step):
    fell = np.array(overturning)
    advice = advise_span([1.0, 2.0], np.array([1.0, 1.0 - fell[1]]), fell, largest_risk=risk)
    assert (advice.is_step, advice.is_enough, advice.span) == (is_step, not is_step, 2.0 if is_step else 1.0)


def test_where_every_span_is_too_risky_the_least_risky_is_shown_as_such():
    advice = advise_span([2.0, 3.0], np.array([0.4, 0.1]), np.array([0.6, 0.9]), largest_risk=0.5)
    assert (advice.span, advice.is_enough) == (2.0, False)
