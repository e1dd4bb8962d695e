from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.random_walk_fit import RandomWalkProblem

NUMBER = np.arange(40.0)
WALK = np.minimum.outer(NUMBER, NUMBER)


def problem(seed, *, error=0.01, scatter=0.0):
    random = np.random.default_rng(seed)
    walk = np.concatenate(([0.0], np.cumsum(scatter * random.normal(size=NUMBER.size - 1))))
    values = 1.0 - 0.1 * NUMBER + error * random.normal(size=NUMBER.size) + walk
    return RandomWalkProblem(
        np.column_stack((np.ones(NUMBER.size), NUMBER)), values, error**2 * np.eye(NUMBER.size), WALK
    )


@pytest.mark.parametrize(
    ("scatter", "least"),
    [(0.0, 0.65), (0.05, 0.8)],  # without a walk some is found now and then, never less than none: errors too wide
    ids=["errors alone", "a walk beside them"],
)
def test_the_slope_is_off_by_as_much_as_its_error_says(scatter, least):
    fits = [problem(seed, scatter=scatter).fit() for seed in range(120)]
    off = np.array([(fit.coefficients[1] + 0.1) / fit.error(1) for fit in fits])
    assert abs(off.mean()) < 0.25
    assert least < off.std() < 1.25


def test_errors_are_as_large_as_a_walk_makes_them_and_not_larger():
    errors = np.array([problem(seed, scatter=0.05).fit().error(1) for seed in range(120)])
    # The slope of a walk over n steps is as uncertain as the mean of n of them.
    expected = 0.05 / np.sqrt(NUMBER.size - 1)
    assert np.median(errors) == pytest.approx(expected, rel=0.2)
    assert errors.max() < 2 * expected


def test_a_coefficient_of_nothing_is_seldom_sure_and_a_large_one_is():
    sure = [problem(seed, scatter=0.02).fit(NUMBER > 9).is_sure(2, 3.0) for seed in range(120)]
    assert sum(sure) <= 3
    shifted = [
        RandomWalkProblem(one.design, one.values + 0.5 * (NUMBER > 9), one.covariance, one.walk).fit(NUMBER > 9)
        for one in map(problem, range(10))
    ]
    assert all(fit.is_sure(2, 4.0) for fit in shifted)


def test_the_gain_of_a_column_is_that_of_the_fit_with_it():
    one = problem(3)
    columns = np.column_stack((NUMBER > 9, np.sin(NUMBER)))
    gains = one.gains(columns)
    weight = 100.0

    def criterion(design):
        left = one.values - design @ np.linalg.lstsq(design, one.values, rcond=None)[0]
        power = weight**2 * left @ left
        scale = max(power / NUMBER.size, 1.0)
        return NUMBER.size * np.log(scale) + power / scale

    expected = [criterion(one.design) - criterion(np.column_stack((one.design, each))) for each in columns.T]
    assert gains == pytest.approx(expected, abs=0.3)  # a walk that is not there may still lower either by a little


def test_as_many_unknowns_as_values_are_refused():
    few = RandomWalkProblem(np.eye(2), np.ones(2), np.eye(2), np.zeros((2, 2)))
    with pytest.raises(ValueError, match="2 values for 2 coefficients"):
        few.fit()
