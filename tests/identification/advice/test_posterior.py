"""The posterior on the grid against direct integration, and what tests of one frequency say about another."""

from __future__ import annotations

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.identification.advice.posterior import LEVEL, SineTests, find_boundaries
from colonnade.identification.advice.prior import BoundaryPrior

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
