"""Advice on free vibrations: enough, how many more, and from where."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.advice.restitution import advise_free_vibration
from colonnade.identification.restitution.pooling import pool

WANTED = {"wanted_half_width": 0.001, "largest_release": 0.7}


def test_the_predicted_half_width_is_that_of_virtual_tests():
    rng = np.random.default_rng(0)
    error, scatter, tests = 5e-4, 1e-3, 6
    halves, predicted = [], []
    for _ in range(100):
        e = 0.97 + rng.normal(0, np.hypot(error, scatter), tests + 3)
        first = advise_free_vibration(e[:tests], [error] * tests, [0.7] * tests, **WANTED)
        later = pool(e, [error] * (tests + 3))
        predicted.append(first.predicted_half_width[2])
        halves.append((later.high - later.low) / 2)
    assert np.mean(predicted) == pytest.approx(np.mean(halves), rel=0.1)


def test_agreeing_tests_are_enough_and_scattered_ones_are_not():
    agreeing = advise_free_vibration([0.9760, 0.9761, 0.9759], [2e-4] * 3, [0.6, -0.6, 0.6], **WANTED)
    scattered = advise_free_vibration([0.974, 0.979, 0.976], [2e-4] * 3, [0.6, -0.6, 0.6], **WANTED)
    assert agreeing.is_enough
    assert agreeing.needed == 0
    assert not scattered.is_enough
    assert scattered.limited_by == "scatter"
    assert scattered.needed is None or scattered.needed > 5


def test_one_test_is_never_enough():
    advice = advise_free_vibration([0.976], [1e-5], [0.6], **WANTED)
    assert not advice.is_enough
    assert advice.needed is not None
    assert advice.needed >= 1


def test_the_release_is_the_largest_allowed_to_the_side_with_fewer_tests():
    assert advise_free_vibration([0.97, 0.97], [1e-3] * 2, [0.5, 0.5], **WANTED).release_ratio == -0.7
    assert advise_free_vibration([0.97, 0.97], [1e-3] * 2, [-0.5, 0.5], **WANTED).release_ratio == 0.7


def test_a_larger_release_is_expected_to_give_a_smaller_error():
    small = advise_free_vibration([0.97, 0.97], [1e-3] * 2, [0.3, 0.3], **WANTED)
    same = advise_free_vibration([0.97, 0.97], [1e-3] * 2, [0.7, 0.7], **WANTED)
    assert small.test_error < 1e-3
    assert same.test_error == pytest.approx(1e-3)


def test_more_tests_give_a_narrower_interval():
    advice = advise_free_vibration([0.97, 0.975], [1e-3, 2e-3], [0.5, 0.6], **WANTED)
    assert (np.diff(advice.predicted_half_width) < 0).all()


@pytest.mark.parametrize(
    ("release", "largest", "message"),
    [([0.5], 0.7, "release_ratio"), ([0.5, 1.2], 0.7, "release_ratio"), ([0.5, 0.5], 1.0, "largest_release")],
)
def test_what_is_not_a_release_is_refused(release, largest, message):
    with pytest.raises(ValueError, match=message):
        advise_free_vibration([0.97, 0.97], [1e-3] * 2, release, wanted_half_width=1e-3, largest_release=largest)
