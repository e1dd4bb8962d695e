"""e from the times between impacts, exact times from the adaptive integrator of another engine."""

import re

import numpy as np
import pytest

from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.estimators.half_periods import HalfPeriods
from prism import PRISM

ERROR = 1e-4


def impacts(restitution, block=PRISM, count=20):
    history = rock(block, restitution=restitution, theta0=0.6 * block.critical_angle, duration=15.0, model="nonlinear")
    return np.asarray(history.impact_times)[:count]


@pytest.mark.parametrize("restitution", [0.85, 0.93, 0.98])
def test_exact_times_give_e(restitution):
    times = impacts(restitution)
    found = HalfPeriods().fit_times(times, np.eye(times.size) * ERROR**2, 0, PRISM)
    assert found.estimate.value == pytest.approx(restitution, abs=1e-7)


def test_intervals_hold_the_truth_as_often_as_they_say():
    times, rng = impacts(0.95), np.random.default_rng(1)
    found = [
        HalfPeriods()
        .fit_times(times + rng.normal(0, ERROR, times.size), np.eye(times.size) * ERROR**2, 0, PRISM)
        .estimate
        for _ in range(60)
    ]
    assert 54 <= sum(each.low <= 0.95 <= each.high for each in found) <= 60
    assert abs(np.mean([each.value for each in found]) - 0.95) < 3 * found[0].standard_error / np.sqrt(60)


def test_p_is_freed_where_it_is_known_well_enough_and_correlation_is_told():
    heavier = PRISM.override(inertia=1.05 * PRISM.inertia)
    times = impacts(0.95, block=heavier)
    covariance = np.eye(times.size) * (0.1 * ERROR) ** 2
    fixed = HalfPeriods().fit_times(times, covariance, 0, PRISM)
    freed = HalfPeriods().fit_times(times, covariance, 0, PRISM, free_p=True)
    assert abs(fixed.estimate.value - 0.95) > 1e-4
    assert freed.estimate.value == pytest.approx(0.95, abs=4 * freed.estimate.standard_error)
    said = re.search(r"p freed: (.*) ± (.*) of the block's, correlation with e (.*)$", freed.estimate.assumptions)
    factor, error, correlation = map(float, said.groups())
    assert factor == pytest.approx(1 / np.sqrt(1.05), abs=4 * error + 1e-4)
    assert abs(correlation) > 0.9


def test_p_stays_fixed_where_freeing_it_would_tell_nothing():
    times = impacts(0.95, count=8)
    freed = HalfPeriods().fit_times(times, np.eye(times.size) * (20 * ERROR) ** 2, 0, PRISM, free_p=True)
    assert freed.estimate.assumptions.endswith("; the block's p")


def test_a_zero_offset_does_not_move_e():
    times = impacts(0.95)
    clean = HalfPeriods().fit_times(times, np.eye(times.size) * ERROR**2, 0, PRISM).estimate
    speeds = np.asarray(
        rock(
            PRISM, restitution=0.95, theta0=0.6 * PRISM.critical_angle, duration=15.0, model="nonlinear"
        ).impact_velocities
    )[: times.size]
    seen = times - 0.002 * PRISM.critical_angle / speeds
    found = HalfPeriods().fit_times(seen, np.eye(times.size) * ERROR**2, 0, PRISM).estimate
    assert found.value == pytest.approx(clean.value, abs=1e-5)


def test_few_impacts_are_refused():
    found = HalfPeriods().fit_times(impacts(0.95, count=5), np.eye(5), 0, PRISM)
    assert found.estimate.value is None
    assert found.estimate.reason.endswith("; the record has 5.")
