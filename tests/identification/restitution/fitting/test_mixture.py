"""The interval of a mean whose scatter is not known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate, stats

from colonnade.identification.restitution.fitting.mixture import SCATTERS, MeanByScatter, _weight, mean_over_scatters


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
