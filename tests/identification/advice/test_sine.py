"""Sine tests: the posterior against direct integration, the information by its definition, and the advice."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.identification.advice.posterior import LEVEL, SineTests, find_boundaries
from colonnade.identification.advice.prior import BoundaryPrior, chance
from colonnade.identification.advice.remaining import best_choice, candidates_of, count_tests_left, expected_information
from colonnade.identification.advice.sine import advise_sine_tests

PRIOR = BoundaryPrior()
AMPLITUDES, OUTCOMES = [1.9, 2.1, 2.0, 2.05], [False, True, False, True]


def test_one_frequency_agrees_with_direct_integration_over_all_that_is_unknown():
    rng = np.random.default_rng(0)
    draws = 1_000_000
    # The prior as its docstring has it, drawn; each draw weighed by the probability of the outcomes.
    between = PRIOR.between * PRIOR.factor ** rng.standard_normal(draws)
    offset = PRIOR.common * rng.standard_normal(draws) + between * rng.standard_normal(draws)
    width = PRIOR.width * PRIOR.factor ** rng.standard_normal(draws) * PRIOR.width_between ** rng.standard_normal(draws)
    weight = np.ones(draws)
    for amplitude, overturned in zip(AMPLITUDES, OUTCOMES, strict=True):
        chance = PRIOR.odd + (1 - 2 * PRIOR.odd) * scipy.special.ndtr((np.log(amplitude / 2.0) - offset) / width)
        weight *= chance if overturned else 1 - chance
    order = np.argsort(offset)
    reached = np.cumsum(weight[order]) / weight.sum()
    expected = 2.0 * np.exp(offset[order][np.searchsorted(reached, [0.05, 0.5, 0.95])])
    [boundary] = find_boundaries([SineTests.of(2.0, AMPLITUDES, OUTCOMES)])
    np.testing.assert_allclose(boundary.quantiles([0.05, 0.5, 0.95]), expected, rtol=0.003)


def test_without_tests_the_boundary_is_the_predicted_limit_within_the_prior():
    [boundary] = find_boundaries([SineTests.of(2.0)])
    low, high = boundary.interval
    assert boundary.median == pytest.approx(2.0, rel=1e-6)
    # The deviation between frequencies is small against the common one.
    assert np.log(high / low) / 2 == pytest.approx(scipy.special.ndtri((1 + LEVEL) / 2) * PRIOR.common, rel=0.05)
    assert boundary.risk(2.0) == pytest.approx(0.5)
    assert boundary.relative_width == pytest.approx(high / low - 1)


def test_tests_at_one_frequency_move_the_boundary_of_another_and_narrow_it():
    tested = SineTests.of(2.0, [2.2, 2.4, 2.3, 2.35], [False, True, False, True])
    alone, shared = find_boundaries([SineTests.of(4.0)])[0], find_boundaries([tested, SineTests.of(4.0)])[1]
    assert shared.median == pytest.approx(4.0 * 2.32 / 2.0, rel=0.02)
    assert shared.relative_width < 0.6 * alone.relative_width


def test_a_wrong_e_moves_frequencies_by_their_sensitivities():
    tested = [SineTests.of(2.0, [1.9, 2.1] * 3, [False, True] * 3, sensitivity=0.0)]
    tested += [SineTests.of(3.0, [3.1, 3.3] * 3, [False, True] * 3, sensitivity=0.06)]
    along, against = (find_boundaries([*tested, SineTests.of(5.0, sensitivity=each)])[2] for each in (0.06, -0.06))
    assert along.median > 5.1
    assert against.median < 4.9


def test_one_odd_outcome_does_not_move_a_well_tested_boundary_far():
    amplitudes, outcomes = [1.94, 2.06] * 6, [False, True] * 6
    [before] = find_boundaries([SineTests.of(2.0, amplitudes, outcomes)])
    [after] = find_boundaries([SineTests.of(2.0, [*amplitudes, 2.6], [*outcomes, False])])
    assert after.median == pytest.approx(before.median, rel=0.01)


@settings(max_examples=15)
@given(st.lists(st.tuples(st.floats(0.7, 1.4), st.booleans()), max_size=8), st.floats(0.8, 1.25))
def test_an_overturning_never_raises_the_boundary(tests, amplitude):
    amplitudes, outcomes = ([each[index] for each in tests] for index in (0, 1))
    [before] = find_boundaries([SineTests.of(1.0, amplitudes, outcomes)])
    [after] = find_boundaries([SineTests.of(1.0, [*amplitudes, amplitude], [*outcomes, True])])
    assert after.weight.sum() == pytest.approx(1.0)
    assert after.risk(amplitude) >= before.risk(amplitude) - 1e-9


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        pytest.param((0.0,), "predicted", id="no predicted limit"),
        pytest.param((1.0, [1.0, 2.0], [True]), "one outcome a test", id="an outcome is missing"),
        pytest.param((1.0, [-1.0], [True]), "positive", id="a negative amplitude"),
        pytest.param((1.0, [], [], 2.0), "sensitivity", id="a sensitivity out of range"),
    ],
)
def test_what_is_not_a_series_of_tests_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        SineTests.of(*arguments)


@pytest.mark.parametrize("name", ["common", "between", "width", "factor", "width_between", "odd"])
def test_a_prior_out_of_range_is_refused(name):
    with pytest.raises(ValueError, match=name):
        BoundaryPrior(**{name: 0.0})


[BOUNDARY] = find_boundaries([SineTests.of(2.0, [1.9, 2.2], [False, True])])
GRID, WEIGHT = BOUNDARY.grid, BOUNDARY.weight


def entropy(weight):
    return scipy.special.entr(weight.sum(axis=1) / weight.sum()).sum() / np.log(2)


@pytest.mark.parametrize("amplitude", [1.85, 2.05, 2.3])
def test_it_is_the_mean_fall_of_the_boundarys_entropy_over_both_outcomes(amplitude):
    index = int(np.argmin(np.abs(GRID.offset - np.log(amplitude / 2.0))))
    [information], [risk] = expected_information(GRID, WEIGHT, np.array([index]))
    fell = WEIGHT * GRID.chances[index]
    stood = WEIGHT - fell
    assert risk == pytest.approx(fell.sum())
    assert risk == pytest.approx(float(BOUNDARY.risk(2.0 * np.exp(GRID.offset[index]))))
    expected = entropy(WEIGHT) - fell.sum() * entropy(fell) - stood.sum() * entropy(stood)
    assert information == pytest.approx(expected, abs=1e-6)


def test_it_is_between_nothing_and_one_bit_and_largest_inside_the_bracket():
    candidates = candidates_of(GRID, WEIGHT)
    information, risk = expected_information(GRID, WEIGHT, candidates)
    assert ((information > -1e-9) & (information <= 1.0)).all()
    assert (np.diff(risk) > 0).all()
    assert 1.9 < 2.0 * np.exp(GRID.offset[candidates[int(np.argmax(information))]]) < 2.2


BRACKETED = SineTests.of(2.0, [1.9, 2.1, 1.95, 2.05], [False, True, False, True])


def advise(tests, risk=1.0, width=0.05):
    [advice] = advise_sine_tests([tests], wanted_width=width, largest_risk=risk)
    return advice


def test_the_first_test_halves_the_prior():
    advice = advise(SineTests.of(2.0))
    assert advice.amplitude_ratio == pytest.approx(2.0, rel=0.005)
    assert advice.risk == pytest.approx(0.5, abs=0.02)
    assert 0.5 < advice.information < 1.0
    assert advice.repeats == 0


@pytest.mark.parametrize("risk", [0.1, 0.3])
def test_a_smaller_risk_costs_information_and_tests(risk):
    bold, careful = advise(BRACKETED), advise(BRACKETED, risk)
    assert careful.risk <= risk
    assert careful.amplitude_ratio < bold.amplitude_ratio
    assert careful.information < bold.information
    assert careful.unlimited == bold.unlimited
    assert careful.unlimited.information == bold.information


def test_a_risk_below_every_test_gives_the_test_with_the_least():
    advice = advise(BRACKETED, risk=0.001)
    assert 0.001 < advice.risk < 0.05


def test_scattered_outcomes_lead_to_repeats():
    amplitudes, outcomes = [1.9, 2.0, 2.0, 2.1, 1.96, 2.04], [False, False, True, True, True, False]
    for number in range(6):
        [boundary] = find_boundaries([SineTests.of(2.0, amplitudes, outcomes)])
        amplitudes.append(2.0 * np.exp(boundary.grid.offset[best_choice(boundary.grid, boundary.weight, 1.0).index]))
        outcomes.append(number % 2 == 0)
    # The last advice came to an amplitude that had been tested before.
    before = SineTests.of(2.0, amplitudes[:-1], outcomes[:-1])
    advice = advise(before, width=0.02)
    assert advice.amplitude_ratio == pytest.approx(amplitudes[-1])
    assert advice.repeats == sum(abs(each / amplitudes[-1] - 1) < 0.005 for each in amplitudes[:-1]) > 0


def test_a_narrow_interval_is_enough():
    advice = advise(SineTests.of(2.0, [1.96, 2.04] * 8, [False, True] * 8))
    assert advice.is_enough
    assert (advice.left.median, advice.left.most) == (0, 0)


def test_as_many_tests_are_left_as_it_says():
    [boundary] = find_boundaries([BRACKETED])
    grid, prior = boundary.grid, BoundaryPrior()
    left = count_tests_left(grid, boundary.weight, wanted_width=0.05, largest_risk=1.0)
    rng = np.random.default_rng(3)
    counts = []
    for _ in range(60):
        row, column = np.unravel_index(
            rng.choice(boundary.weight.size, p=boundary.weight.ravel()), boundary.weight.shape
        )
        weight, count = boundary.weight, 0
        while count < 30:
            low_high = np.interp([0.05, 0.95], np.cumsum(weight.sum(axis=1)), grid.offset)
            if np.diff(low_high)[0] <= np.log(1.05):
                break
            index = best_choice(grid, weight, 1.0).index
            overturned = rng.random() < chance(grid.offset[index] - grid.offset[row], grid.width[column], prior.odd)
            weight = weight * (grid.chances[index] if overturned else 1 - grid.chances[index])
            weight, count = weight / weight.sum(), count + 1
        counts.append(count)
    assert left.median is not None
    assert left.most is not None
    assert abs(left.median - np.median(counts)) <= 1
    assert np.mean(np.array(counts) <= left.most) > 0.75


@pytest.mark.parametrize(("risk", "width", "message"), [(0.0, 0.05, "largest_risk"), (1.0, 0.001, "wanted_width")])
def test_settings_out_of_range_are_refused(risk, width, message):
    with pytest.raises(ValueError, match=message):
        advise(BRACKETED, risk, width)
