"""What a linear model with a scatter of unknown size says: generalised least squares, and intervals that hold."""

import numpy as np
import pytest

from colonnade.identification.restitution.scatter import SCATTERS, LinearModel

IMPACTS, SAMPLES, NOISE = 12, 400, 1e-3


def columns(seed=0):
    """Derivatives by e of each impact, their sum, and one other unknown."""
    own = np.cumsum(np.random.default_rng(seed).normal(size=(IMPACTS, SAMPLES)), axis=1) / 10
    return own, np.vstack((own.sum(axis=0), np.linspace(-1, 1, SAMPLES)))


def model_of(values, own, fixed, precision=(0.0, 0.0), origin=(0.0, 0.0)):
    rows = np.vstack((values, fixed, own))
    return LinearModel.of(rows @ rows.T, np.array(precision), np.array(origin), float(SAMPLES), 0.0)


def record(scatter, seed, mean=0.004):
    own, fixed = columns()
    random = np.random.default_rng((seed, 9))
    return mean * fixed[0] + (scatter * random.normal(size=IMPACTS)) @ own + NOISE * random.normal(size=SAMPLES)


@pytest.mark.parametrize("place", [0, 20, 40])
def test_each_scatter_has_the_mean_of_generalised_least_squares(place):
    own, fixed = columns()
    values = record(0.01, 1)
    model = model_of(values, own, fixed)
    solved = model.solved()
    covariance = model.level * np.eye(SAMPLES) + SCATTERS[place] ** 2 * own.T @ own
    weighted = np.linalg.solve(covariance, fixed.T)
    inverse = np.linalg.inv(fixed @ weighted)
    np.testing.assert_allclose(solved.centres[place], inverse @ (weighted.T @ values), rtol=1e-6)
    np.testing.assert_allclose(solved.covariances[place], inverse, rtol=1e-6)


def test_the_level_of_the_noise_is_found():
    own, fixed = columns()
    levels = [model_of(record(0.01, seed), own, fixed).level for seed in range(20)]
    assert np.mean(levels) == pytest.approx(NOISE**2, rel=0.05)


def test_a_prior_holds_an_unknown_that_the_record_does_not_show():
    own, fixed = columns()
    model = model_of(record(0.0, 2), own, np.vstack((fixed, 1e-9 * fixed[1] ** 2)), (0.0, 0.0, 4.0), (0.1, 0.2, 0.3))
    solved = model.solved()
    assert solved.mean[:2] == pytest.approx([0.1 + 0.004, 0.2], abs=1e-3)
    assert solved.mean[2] == pytest.approx(0.0, abs=1e-3)
    assert solved.covariance[2, 2] == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize("scatter", [0.0, 0.002, 0.01])
def test_intervals_hold_the_mean_as_often_as_they_say(scatter):
    own, fixed = columns()
    held = []
    for seed in range(120):
        solved = model_of(record(scatter, seed), own, fixed).solved()
        held.append(solved.quantile(0.05) <= 0.004 <= solved.quantile(0.95))
    # 108 of 120 expected, with a standard deviation of 3.3; wider where the scatter is unknown.
    assert sum(held) >= 98


def test_a_direction_along_the_impacts_is_found_as_an_unknown_of_its_own():
    own, fixed = columns()
    direction = np.linspace(-1, 1, IMPACTS)
    values = record(0.0, 3) + 0.01 * direction @ own
    solved = model_of(values, own, fixed).with_direction(direction).solved()
    assert solved.mean[-1] == pytest.approx(0.01, abs=4 * np.sqrt(solved.covariance[-1, -1]))
    assert solved.scatter < 1e-3
