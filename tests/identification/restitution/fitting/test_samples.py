"""Samples are averaged as far as free rocking hardly bends in a group."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.fitting.samples import STEP, thinned
from prism import PRISM

INTERVAL = 2.5e-4
TIME = INTERVAL * np.arange(4000)


def test_groups_are_as_long_as_the_step_allows_and_keep_the_clock():
    found = thinned(TIME, np.zeros(TIME.size), PRISM)
    assert found.group == int(STEP / (PRISM.p * INTERVAL)) > 4
    assert found.interval == pytest.approx(found.group * INTERVAL)
    np.testing.assert_allclose(np.diff(found.time), found.interval)
    assert found.time[0] == pytest.approx((found.group - 1) / 2 * INTERVAL)


def test_white_noise_stays_white_and_as_much_smaller():
    noise = np.random.default_rng(0).normal(0.0, 1e-4, TIME.size)
    found = thinned(TIME, noise, PRISM)
    assert np.std(found.angle) == pytest.approx(1e-4 / np.sqrt(found.group), rel=0.1)
    assert abs(np.corrcoef(found.angle[1:], found.angle[:-1])[0, 1]) < 0.15


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_bend_of_rocking_within_a_group_is_taken_off(side):
    motion = Motion(np.zeros(TIME.size), INTERVAL)
    history = rock(PRISM, motion, model="nonlinear", restitution=0.9, theta0=side * 0.6 * PRISM.critical_angle)
    found = thinned(TIME, history.angle, PRISM)
    expected = np.interp(found.time, history.time, history.angle)
    before = found.time < history.impact_times[0] - found.interval
    plain = history.angle[: found.time.size * found.group].reshape(-1, found.group).mean(axis=1)
    off, plainly_off = (np.abs(each - expected)[before].max() for each in (found.angle, plain))
    assert off < 0.05 * plainly_off


def test_a_coarse_record_is_kept_as_it_is():
    time, angle = TIME[::100], np.arange(40.0)
    found = thinned(time, angle, PRISM)
    assert (found.group, found.interval) == (1, pytest.approx(100 * INTERVAL))
    assert found.angle is angle


@pytest.mark.parametrize("time", [np.array([0.0]), np.array([0.0, 1e-4, 3e-4, 4e-4])])
def test_without_an_even_clock_nothing_is_averaged(time):
    found = thinned(time, np.zeros(time.size), PRISM)
    assert (found.group, found.interval) == (1, None)


def test_a_gap_makes_its_groups_missing():
    angle = np.zeros(TIME.size)
    angle[100] = np.nan
    found = thinned(TIME, angle, PRISM)
    assert np.flatnonzero(np.isnan(found.angle)).tolist() == [100 // found.group]
