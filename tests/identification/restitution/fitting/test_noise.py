"""Noise of a record, and intervals of means over scatters and random walks."""

import numpy as np
import pytest
from scipy import integrate, stats

from colonnade.identification.restitution.fitting.mixture import SCATTERS, MeanByScatter, _weight, mean_over_scatters
from colonnade.identification.restitution.fitting.noise import fit_noise, weighted_products
from colonnade.identification.restitution.fitting.random_walk_fit import RandomWalkProblem
from colonnade.signals.filters import lowpass

INTERVAL = 0.002


def noise(seed, cutoff, count=3000):
    white = np.random.default_rng(seed).normal(0, 1.0, count + 1000)
    return (white if cutoff is None else lowpass(white, INTERVAL, cutoff))[500:-500]


@pytest.mark.parametrize("cutoff", [None, 30.0, 60.0, 150.0], ids=lambda value: f"{value}")
def test_the_cutoff_and_the_level_before_it_are_found(cutoff):
    found = [fit_noise(noise(seed, cutoff), INTERVAL) for seed in range(12)]
    assert np.median([each.level for each in found]) == pytest.approx(1.0, rel=0.1)
    if cutoff is None:
        assert all(each.cutoff_hz is None for each in found)
    else:
        assert np.median([each.cutoff_hz for each in found]) == pytest.approx(cutoff, rel=0.05)


def test_lines_of_a_wrong_model_do_not_count_as_noise():
    seen = noise(1, None) + 3 * np.sin(2 * np.pi * 7.0 * INTERVAL * np.arange(3000))
    assert fit_noise(seen, INTERVAL).level == pytest.approx(1.0, rel=0.1)


def test_missing_samples_do_not_change_the_level():
    seen = noise(2, None)
    seen[1000:1400] = np.nan
    assert fit_noise(seen, INTERVAL).level == pytest.approx(1.0, rel=0.1)


@pytest.mark.parametrize("cutoff", [None, 60.0])
def test_sums_scatter_as_the_products_say(cutoff):
    square = np.sign(np.sin(2 * np.pi * 3.0 * INTERVAL * np.arange(3000) + 0.3))
    sums = [square @ noise(seed, cutoff) for seed in range(300)]
    expected = np.median([weighted_products(square[:, None], fit_noise(noise(s, cutoff), INTERVAL)) for s in range(8)])
    assert np.var(sums) == pytest.approx(float(expected), rel=0.25)


def test_nothing_counted_is_no_noise():
    assert fit_noise(np.full(100, np.nan), INTERVAL).level == 0.0


def parts(values, errors):
    """What independent values of known errors say of their mean, for each scatter; ordinary random effects."""
    variance = errors[:, None] ** 2 + SCATTERS**2
    weight = 1 / variance
    centre = (weight * values[:, None]).sum(axis=0) / weight.sum(axis=0)
    left = (weight * (values[:, None] - centre) ** 2).sum(axis=0)
    likelihood = -0.5 * (np.log(variance).sum(axis=0) + np.log(weight.sum(axis=0)) + left)
    return MeanByScatter(SCATTERS, likelihood, centre, weight.sum(axis=0) ** -0.5, 1e6)


def test_without_scatter_it_is_the_interval_of_the_errors():
    values = 1e-4 * np.array([0.3, -0.5, 0.1, 0.6, -0.4, -0.2, 0.2, 0.0])
    mean = mean_over_scatters(parts(values, np.full(8, 1e-4)), 0.95)
    assert mean.scatter == 0
    assert mean.high - mean.low == pytest.approx(2 * 1.96 * 1e-4 / np.sqrt(8), rel=1e-3)
    assert mean.value == pytest.approx(values.mean(), abs=1e-9)


@pytest.mark.parametrize("count", [5, 10, 40])
def test_with_much_scatter_it_is_about_students(count):
    values = np.random.default_rng(count).normal(0.0, 4e-3, count)
    mean = mean_over_scatters(parts(values, np.full(count, 1e-6)), 0.95)
    half = stats.t.ppf(0.975, count - 1) * values.std(ddof=1) / np.sqrt(count)
    assert (mean.high - mean.low) / 2 == pytest.approx(half, rel=0.25 if count < 10 else 0.12)


@pytest.mark.parametrize("scatter", [0.0, 1e-3, 4e-3])
def test_it_holds_the_mean_as_often_as_it_says(scatter):
    random = np.random.default_rng(7)
    held = 0
    for _ in range(300):
        values = random.normal(0.0, np.hypot(scatter, 5e-4), 6)
        mean = mean_over_scatters(parts(values, np.full(6, 5e-4)), 0.95)
        held += mean.low <= 0 <= mean.high
    # Of 300 within three standard errors.
    assert 0.912 <= held / 300 <= 0.988


def test_the_weights_of_all_scatters_make_one():
    assert integrate.quad(lambda x: float(_weight(np.exp(x))), -60, 60, limit=400)[0] == pytest.approx(1, abs=1e-6)


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
