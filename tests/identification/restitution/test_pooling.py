"""e of several free vibrations pooled: scatter between tests, intervals, and the range of a new test."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from colonnade.identification.restitution.pooling import pool
from colonnade.identification.restitution.result import Joint


def test_agreeing_tests_are_weighted_by_their_errors():
    pooled = pool([0.976, 0.977], [0.001, 0.002])
    assert pooled.value == pytest.approx((0.976 * 4 + 0.977) / 5)
    assert pooled.between == 0.0


def test_one_test_keeps_its_own_interval():
    pooled = pool([0.976], [0.001])
    assert (pooled.low, pooled.high) == pytest.approx((0.976 - 0.00196, 0.976 + 0.00196), abs=1e-6)


def test_scatter_between_tests_is_found_apart_from_their_errors():
    rng = np.random.default_rng(0)
    pooled = pool(rng.normal(0.95, 0.005, 400) + rng.normal(0, 0.001, 400), np.full(400, 0.001))
    assert pooled.between == pytest.approx(0.005, rel=0.1)
    assert abs(pooled.value - 0.95) < 3 * pooled.standard_error


@pytest.mark.parametrize("tests", [2, 3, 10])
def test_a_test_that_is_far_surer_than_it_should_be_does_not_decide_alone(tests):
    """It is 15 of its own errors off, but no more than the others are."""
    rng, held = np.random.default_rng(tests), []
    for _ in range(300):
        e = rng.normal(0.97, 4e-4, tests)
        e[0] = 0.97 + 15 * 2e-5
        pooled = pool(e, np.append(2e-5, np.full(tests - 1, 4e-4)))
        held.append(pooled.low <= 0.97 <= pooled.high)
    assert np.mean(held) >= 0.92


def test_intervals_of_three_tests_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(400):
        error = rng.uniform(2e-4, 6e-4, 3)
        pooled = pool(0.976 + rng.normal(0, 3e-4, 3) + rng.normal(0, error), error)
        held += pooled.low <= 0.976 <= pooled.high
    assert held >= 0.94 * 400


@pytest.mark.whole
@pytest.mark.parametrize("tests", [2, 3, 10, 20])
@pytest.mark.parametrize("share", [0.5, 0.95])
def test_so_many_new_tests_are_within_their_range_as_it_says(tests, share):
    """e scatters by 0.003 from test to test; the error of the mean alone holds 85, 49, 37 % after 3, 10, 20 tests."""
    rng, held = np.random.default_rng(tests), []
    for _ in range(600):
        found = pool(rng.normal(0.97, 0.003, tests) + rng.normal(0, 3e-4, tests), np.full(tests, 3e-4))
        deviation, freedom = found.of_new_test(usual=np.nan)
        held.append(abs(rng.normal(0.97, 0.003) - found.value) < stats.t.ppf((1 + share) / 2, freedom) * deviation)
    assert np.mean(held) == pytest.approx(share, abs=3 * np.sqrt(share * (1 - share) / 600))


@pytest.mark.whole
@pytest.mark.parametrize("tests", [2, 3, 10, 20])
@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_a_95_percent_range_holds_new_tests_however_large_the_errors_of_the_tests_are(tests, ratio):
    """93 to 97 %, within 2 % for 900 repetitions; the scatter alone without what it hides holds 84 to 100 %."""
    rng, held = np.random.default_rng(tests), []
    for scatter in (0.0005, 0.001, 0.003):
        for _ in range(300):
            e = rng.normal(0.97, scatter, tests) + rng.normal(0, ratio * scatter, tests)
            found = pool(e, np.full(tests, ratio * scatter))
            deviation, freedom = found.of_new_test(usual=np.nan)
            held.append(abs(rng.normal(0.97, scatter) - found.value) < stats.t.ppf(0.975, freedom) * deviation)
    assert 0.91 <= np.mean(held) <= 0.985


def test_tests_that_agree_by_chance_leave_a_range_as_wide_as_their_errors():
    deviation, freedom = pool([0.97, 0.97], [0.002, 0.002]).of_new_test(usual=np.nan)
    assert stats.t.ppf(0.975, freedom) * deviation == pytest.approx(0.002 / np.sqrt(2))


def test_one_test_leaves_the_scatter_between_tests_to_what_is_usual():
    assert pool([0.97], [0.003]).of_new_test(usual=0.004) == (pytest.approx(0.005), None)


@given(st.lists(st.tuples(st.floats(0.5, 1.0), st.floats(1e-5, 1e-2)), min_size=1, max_size=8))
def test_the_pooled_value_lies_among_the_tests(rows):
    values, errors = zip(*rows, strict=True)
    assert min(values) - 1e-12 <= pool(values, errors).value <= max(values) + 1e-12


def joint(e, alpha, *, width=0.005, slope=0.5, own=1e-4):
    """A test whose ln e goes with its ln α, which it shows as well as `width` was known."""
    alone = width**2 / 2
    covariance = np.array([[own**2 + slope**2 * alone, slope * alone, 0.0], [slope * alone, alone, 0.0], [0, 0, 1e-12]])
    return Joint(np.array([np.log(e) + slope * alpha, alpha, 0.0]), covariance)


def test_tests_share_alpha_and_leave_a_common_error():
    tests = [joint(0.95, shift) for shift in (0.001, -0.002, 0.003)]
    values = [float(np.exp(each.mean[0])) for each in tests]
    errors = [value * float(np.sqrt(each.covariance[0, 0])) for value, each in zip(values, tests, strict=True)]
    apart, together = pool(values, errors), pool(values, errors, joints=tests, known=(0.005, 1e-6))
    assert together.between < 1e-6
    assert together.value == pytest.approx(0.95 * np.exp(0.5 * together.mean[1]), abs=2e-4)
    # Each test doubles what was known of α beforehand.
    assert together.covariance[1, 1] == pytest.approx(0.005**2 / 4, rel=1e-6)
    assert together.standard_error >= 0.95 * 0.5 * 0.0025
    assert apart.tests == together.tests == 3
