"""Advice on earthquakes: the least certain outcome within the risk."""

from __future__ import annotations

import pytest

from colonnade.identification.advice.span import advise_span

SPANS = [1.5, 2.0, 2.5, 3.0]
ROCKING, OVERTURNING = [0.0, 0.6, 0.8, 0.5], [0.0, 0.0, 0.2, 0.5]


def test_the_least_certain_outcome_is_advised():
    advice = advise_span(SPANS, ROCKING, OVERTURNING, largest_risk=1.0)
    assert (advice.span, advice.probabilities) == (3.0, (0.0, 0.5, 0.5))
    assert advice.entropy == pytest.approx(1.0)
    assert not advice.is_enough


def test_three_possible_outcomes_are_less_certain_than_two():
    advice = advise_span([1.0, 2.0], [1 / 3, 0.5], [1 / 3, 0.5], largest_risk=1.0)
    assert advice.span == 1.0
    assert advice.entropy == pytest.approx(1.585, abs=1e-3)


def test_the_risk_leaves_the_span_below():
    assert advise_span(SPANS, ROCKING, OVERTURNING, largest_risk=0.3).span == 2.0


def test_certain_outcomes_are_enough():
    assert advise_span([1.0, 2.0], [0.9, 0.0], [0.05, 1.0], largest_risk=1.0).span == 1.0
    assert advise_span([1.0, 2.0], [1.0, 0.0], [0.0, 1.0], largest_risk=0.5).is_enough


@pytest.mark.parametrize(
    ("overturning", "risk", "is_step"), [([0.0, 0.0], 0.5, True), ([0.0, 0.02], 0.01, False), ([0.0, 1.0], 0.5, False)]
)
def test_where_it_surely_stands_at_every_span_the_last_is_a_step(overturning, risk, is_step):
    rocking = [1.0, 1.0 - overturning[1]]
    advice = advise_span([1.0, 2.0], rocking, overturning, largest_risk=risk)
    assert (advice.is_step, advice.is_enough, advice.span) == (is_step, not is_step, 2.0 if is_step else 1.0)


def test_where_every_span_is_too_risky_the_least_risky_is_shown_as_such():
    advice = advise_span([2.0, 3.0], [0.4, 0.1], [0.6, 0.9], largest_risk=0.5)
    assert (advice.span, advice.is_within_risk, advice.is_enough) == (2.0, False, False)


@pytest.mark.parametrize(
    ("span", "rocking", "overturning", "message"),
    [
        ([2.0, 1.0], [0.5, 0.5], [0.0, 0.0], "increase"),
        ([1.0, 2.0], [0.5, 0.9], [0.0, 0.2], "sum"),
        ([1.0, 2.0], [0.5], [0.0, 0.2], "shape"),
    ],
)
def test_what_is_not_a_probability_of_each_span_is_refused(span, rocking, overturning, message):
    with pytest.raises(ValueError, match=message):
        advise_span(span, rocking, overturning, largest_risk=1.0)
