"""A path with an e of its own at each impact is laid through a record."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.forecast import stretch_of
from colonnade.identification.restitution.fitting.free_decay import ALWAYS
from colonnade.identification.restitution.fitting.least_squares import UnfollowedError, blur
from colonnade.identification.restitution.fitting.rocking_path import RockingPath, fit_path, fit_path_forward
from colonnade.identification.restitution.fitting.samples import AngleSamples

OWN = 0.004 * np.array([0.5, -1.0, 0.3, 1.2, -0.8, 0.4, -0.6])


def noisy(known, **given):
    truth = known(deviations=OWN, **given)
    noise = np.random.default_rng(2).normal(0.0, 1e-6, truth.samples.time.size)
    return truth, replace(truth.samples, angle=truth.samples.angle + noise)


def test_the_e_of_each_impact_is_found(known):
    truth, samples = noisy(known)
    start = RockingPath(replace(truth.decay, deviations=np.empty(0)))
    found = fit_path(start, stretch_of(samples, truth.decay), ALWAYS, 4e-3)
    logarithms = found.decay.values["restitution"] + found.decay.by_impact
    np.testing.assert_allclose(logarithms, truth.decay.values["restitution"] + OWN, atol=1e-4)


def test_without_scatter_all_impacts_have_one_e(known):
    truth, samples = noisy(known)
    found = fit_path(RockingPath(truth.decay), stretch_of(samples, truth.decay), ALWAYS, 1e-9)
    assert np.abs(found.decay.by_impact).max() < 1e-6


def test_a_zero_that_drifts_is_told_from_the_offset(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay)
    drifting = np.linspace(-0.5, 0.5, stretch.time.size) * 2e-4
    found = fit_path(RockingPath(truth.decay), replace(stretch, angle=stretch.angle + drifting), ALWAYS, 4e-3)
    assert found.drift == pytest.approx(2e-4, rel=0.02)
    assert found.decay.values["zero_offset"] == pytest.approx(0.0, abs=2e-6)


def test_it_is_seen_through_the_low_pass_of_the_record(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay, cutoff_hz=20.0)
    path = RockingPath(truth.decay, 1e-4)
    sharp = truth.decay.angle_alone(stretch.time)
    clock = (stretch.time - stretch.time[0]) / (stretch.time[-1] - stretch.time[0]) - 0.5
    np.testing.assert_allclose(path.seen(stretch), sharp + blur(truth.decay, stretch) + 1e-4 * clock, atol=1e-15)


def test_a_record_is_followed_forward_to_its_end(known):
    own = np.random.default_rng(5).normal(0.0, 3e-3, 23)
    truth = known(count=24, deviations=own)
    noise = np.random.default_rng(6).normal(0.0, 1e-5, truth.samples.time.size)
    samples = AngleSamples(truth.samples.time, truth.samples.angle + noise, 0.01)
    start = RockingPath(replace(truth.decay, count=5, deviations=np.empty(0)))
    found = fit_path_forward(samples, start, 1e-4)
    assert found.decay.count >= 22
    logarithms = (found.decay.values["restitution"] + found.decay.by_impact)[:15]
    np.testing.assert_allclose(logarithms, truth.decay.values["restitution"] + own[:15], atol=1e-3)


def test_a_path_that_overturns_is_refused(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay)
    with pytest.raises(UnfollowedError):
        fit_path(RockingPath(truth.decay.moved({"peak": 0.2})), stretch, ALWAYS, 1e-3)
