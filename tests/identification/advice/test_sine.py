"""Advice on sine tests: risk, repeats, enough; and that as many tests are left as it says."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.advice.posterior import SineTests, find_boundaries
from colonnade.identification.advice.prior import BoundaryPrior, chance
from colonnade.identification.advice.remaining import best_choice, count_tests_left
from colonnade.identification.advice.sine import advise_sine_tests

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
