"""Sine tests: the posterior against direct integration, the information by its definition, and the advice."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.identification.boundary import (
    BETWEEN,
    LEVEL,
    ODD,
    WIDTHS,
    SineTests,
    advise_sine_tests,
    find_boundaries,
)

COMMON = 0.15
AMPLITUDES, OUTCOMES = [1.9, 2.1, 2.0, 2.05], [False, True, False, True]


def median(boundary):
    return float(boundary.quantiles(0.5))


def chance_of(boundary, at):
    chances = ODD + (1 - 2 * ODD) * scipy.special.ndtr((at - boundary.offset[:, None]) / WIDTHS)
    return float((chances * boundary.weight).sum())


def test_one_frequency_agrees_with_direct_integration_over_all_that_is_unknown():
    rng = np.random.default_rng(0)
    draws = 1_000_000
    # The prior as its docstrings have it, drawn; each draw weighed by the probability of the outcomes.
    offset = COMMON * rng.standard_normal(draws) + BETWEEN * rng.standard_normal(draws)
    width = 0.02 * 2.0 ** rng.standard_normal(draws)
    weight = np.ones(draws)
    for amplitude, overturned in zip(AMPLITUDES, OUTCOMES, strict=True):
        chance = ODD + (1 - 2 * ODD) * scipy.special.ndtr((np.log(amplitude / 2.0) - offset) / width)
        weight *= chance if overturned else 1 - chance
    order = np.argsort(offset)
    reached = np.cumsum(weight[order]) / weight.sum()
    expected = 2.0 * np.exp(offset[order][np.searchsorted(reached, [0.05, 0.5, 0.95])])
    [boundary] = find_boundaries([SineTests(2.0, AMPLITUDES, OUTCOMES)])
    np.testing.assert_allclose(boundary.quantiles([0.05, 0.5, 0.95]), expected, rtol=0.003)


def test_without_tests_the_boundary_is_the_predicted_limit_within_the_prior():
    [boundary] = find_boundaries([SineTests(2.0)])
    low, high = boundary.interval
    assert median(boundary) == pytest.approx(2.0, rel=1e-6)
    deviation = np.hypot(COMMON, BETWEEN)
    assert np.log(high / low) / 2 == pytest.approx(scipy.special.ndtri((1 + LEVEL) / 2) * deviation, rel=0.01)
    assert boundary.relative_width == pytest.approx(high / low - 1)


def test_tests_at_one_frequency_move_the_boundary_of_another_and_narrow_it():
    tested = SineTests(2.0, [2.2, 2.4, 2.3, 2.35], [False, True, False, True])
    alone, shared = find_boundaries([SineTests(4.0)])[0], find_boundaries([tested, SineTests(4.0)])[1]
    assert median(shared) == pytest.approx(4.0 * 2.32 / 2.0, rel=0.02)
    assert shared.relative_width < 0.6 * alone.relative_width


def test_what_one_frequency_says_of_another_is_less_the_more_their_limits_depend_on_e():
    tested = SineTests(2.0, [2.2, 2.4, 2.3, 2.35], [False, True, False, True])
    firm, loose = (find_boundaries([tested, SineTests(4.0, sensitivity=each)])[1] for each in (0.0, 0.06))
    assert loose.relative_width > 1.5 * firm.relative_width


def test_one_odd_outcome_does_not_move_a_well_tested_boundary_far():
    amplitudes, outcomes = [1.94, 2.06] * 6, [False, True] * 6
    [before] = find_boundaries([SineTests(2.0, amplitudes, outcomes)])
    [after] = find_boundaries([SineTests(2.0, [*amplitudes, 2.6], [*outcomes, False])])
    assert median(after) == pytest.approx(median(before), rel=0.01)


@settings(max_examples=15)
@given(st.lists(st.tuples(st.floats(0.7, 1.4), st.booleans()), max_size=8), st.floats(0.8, 1.25))
def test_an_overturning_never_raises_the_boundary(tests, amplitude):
    amplitudes, outcomes = ([each[index] for each in tests] for index in (0, 1))
    [before] = find_boundaries([SineTests(1.0, amplitudes, outcomes)])
    [after] = find_boundaries([SineTests(1.0, [*amplitudes, amplitude], [*outcomes, True])])
    assert after.weight.sum() == pytest.approx(1.0)
    assert chance_of(after, np.log(amplitude)) >= chance_of(before, np.log(amplitude)) - 1e-9


@pytest.mark.parametrize("tests", [SineTests(2.0, [1.9, 2.2], [False, True]), SineTests(2.0, [1.9], [False])])
def test_the_information_is_the_mean_fall_of_the_posteriors_entropy_over_both_outcomes(tests):
    [advice] = advise_sine_tests([tests], wanted_width=0.05, largest_risk=1.0)
    weight, at = advice.boundary.weight, np.log(advice.amplitude_ratio / 2.0)
    fell = weight * (ODD + (1 - 2 * ODD) * scipy.special.ndtr((at - advice.boundary.offset[:, None]) / WIDTHS))
    stood = weight - fell
    before, *after = (scipy.special.entr(each / each.sum()).sum() / np.log(2) for each in (weight, fell, stood))
    assert advice.risk == pytest.approx(fell.sum()) == pytest.approx(chance_of(advice.boundary, at))
    assert advice.information == pytest.approx(before - fell.sum() * after[0] - stood.sum() * after[1], abs=1e-6)
    assert 0.0 < advice.information < 1.0


BRACKETED = SineTests(2.0, [1.9, 2.1, 1.95, 2.05], [False, True, False, True])


def advise(tests, risk=1.0, width=0.05):
    [advice] = advise_sine_tests([tests], wanted_width=width, largest_risk=risk)
    return advice


def test_the_first_test_halves_the_prior():
    advice = advise(SineTests(2.0))
    assert advice.amplitude_ratio == pytest.approx(2.0, rel=0.005)
    assert advice.risk == pytest.approx(0.5, abs=0.02)
    assert 0.5 < advice.information < 1.0


@pytest.mark.parametrize("risk", [0.1, 0.3])
def test_a_smaller_risk_costs_information_and_tests(risk):
    bold, careful = advise(BRACKETED), advise(BRACKETED, risk)
    assert careful.risk <= risk
    assert careful.amplitude_ratio < bold.amplitude_ratio
    assert careful.information < bold.information


def test_a_risk_below_every_test_gives_the_test_with_the_least():
    advice = advise(BRACKETED, risk=0.001)
    assert 0.001 < advice.risk < 0.05


def test_a_narrow_interval_is_enough():
    advice = advise(SineTests(2.0, [1.96, 2.04] * 8, [False, True] * 8))
    assert (advice.is_enough, advice.left) == (True, 0)


@pytest.mark.whole
@pytest.mark.parametrize("tests", [SineTests(2.0), BRACKETED], ids=["new", "bracketed"])
def test_about_as_many_tests_are_left_as_it_says(tests):
    before = advise(tests)
    rng = np.random.default_rng(3)
    counts = []
    for _ in range(40):
        place = rng.choice(before.boundary.weight.size, p=before.boundary.weight.ravel())
        row, column = np.unravel_index(place, before.boundary.weight.shape)
        advice, now = before, tests
        while not advice.is_enough and len(now.overturned) < 40:
            at = np.log(advice.amplitude_ratio / 2.0)
            chance = ODD + (1 - 2 * ODD) * scipy.special.ndtr((at - before.boundary.offset[row]) / WIDTHS[column])
            outcomes = [*now.overturned, rng.random() < chance]
            now = SineTests(2.0, [*now.amplitude_ratio, advice.amplitude_ratio], outcomes)
            advice = advise(now)
        counts.append(len(now.overturned) - len(tests.overturned))
    assert abs(before.left - np.median(counts)) <= 2
