"""Bootstrap over records, and intervals that are Student's where those are right."""

import numpy as np
import pytest
import scipy

from colonnade.assessment.fragility.resampling import record_weights, studentised


def test_each_resample_has_as_many_records_and_draws_them_alike():
    weights = record_weights(7, 5000, 1)
    assert (weights.sum(axis=1) == 7).all()
    assert weights.mean(axis=0) == pytest.approx(np.ones(7), abs=0.05)
    assert weights.var(axis=0) == pytest.approx(np.full(7, 6 / 7), abs=0.1)


def test_of_a_mean_of_normal_values_it_is_about_students_interval():
    values = np.random.default_rng(3).normal(0, 1, 40)
    weights = record_weights(40, 20000, 2)
    means = weights @ values / 40
    errors = np.sqrt((weights @ values**2 / 40 - means**2) / 40)
    mean, error = values.mean(), values.std() / np.sqrt(40)
    band = studentised(np.array([mean]), np.array([error]), means[:, None], errors[:, None], 0.95, 40)
    reach = scipy.stats.t.ppf(0.975, 39) * error
    assert (band.low[0], band.high[0]) == pytest.approx((mean - reach, mean + reach), abs=0.25 * reach)
