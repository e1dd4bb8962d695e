"""The expected information against its definition, outcome by outcome."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from colonnade.identification.advice.information import candidates_of, expected_information
from colonnade.identification.advice.posterior import SineTests, find_boundaries

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
