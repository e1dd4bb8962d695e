"""Least squares of a stretch, by averaged samples."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.fitting.free_decay import ALWAYS
from colonnade.identification.restitution.fitting.least_squares import (
    Stretch,
    UnfollowedError,
    blur,
    closest_cutoff,
    fit_decay,
    nearest,
)
from colonnade.identification.restitution.fitting.samples import STEP, thinned
from prism import PRISM

WRONG = {"restitution": 0.01, "peak": 1e-3, "time": 5e-3, "zero_offset": 5e-4}


def stretch_of(known, **given):
    return Stretch(known.samples.time, known.samples.angle, interval=0.01, **given)


@pytest.mark.parametrize("linearised", [False, True])
def test_unknowns_are_found_from_nearby(known, linearised):
    truth = known(linearised=linearised)
    found = fit_decay(truth.decay.moved(WRONG), stretch_of(truth), ALWAYS)
    for name in ALWAYS:
        assert found.decay.values[name] == pytest.approx(truth.decay.values[name], abs=1e-7)
    assert found.mean_square < 1e-14


def test_the_block_is_found_too_where_it_is_free(known):
    truth = known(p=0.01, critical_angle=-0.02)
    start = replace(truth.decay, values=truth.decay.values | {"p": 0.0, "critical_angle": 0.0})
    found = fit_decay(start, stretch_of(truth), (*ALWAYS, "critical_angle", "p"))
    assert (found.decay.values["p"], found.decay.values["critical_angle"]) == pytest.approx((0.01, -0.02), abs=1e-6)


def test_the_errors_are_those_of_the_noise(known):
    """The inverse of JᵀJ times the noise's variance is how e scatters over records."""
    truth = known()
    random = np.random.default_rng(1)
    found = []
    for _ in range(40):
        noisy = replace(stretch_of(truth), angle=truth.samples.angle + random.normal(0, 1e-4, truth.samples.time.size))
        found.append(fit_decay(truth.decay, noisy, ALWAYS))
    errors = [np.sqrt(fit.inverse[0, 0] * fit.mean_square) for fit in found]
    scatter = np.std([fit.decay.values["restitution"] for fit in found])
    assert scatter == pytest.approx(np.mean(errors), rel=0.3)


def test_samples_near_impacts_and_gaps_are_left_out(known):
    truth = known()
    stretch = stretch_of(truth, margin=0.02)
    angle = np.where(np.arange(stretch.time.size) % 7 == 0, np.nan, stretch.angle)
    found = fit_decay(truth.decay, replace(stretch, angle=angle), ALWAYS)
    out = ~np.isfinite(found.residual)
    np.testing.assert_array_equal(out, np.isnan(angle) | (nearest(stretch.time, found.decay.arcs()[2]) < 0.02))
    assert not found.jacobian(ALWAYS)[out].any()


@pytest.mark.parametrize(
    ("change", "message"),
    [({"peak": 0.2}, "the block would overturn"), ({}, "too few samples")],
)
def test_what_cannot_be_followed_is_told(known, change, message):
    truth = known()
    stretch = stretch_of(truth)
    few = stretch if change else Stretch(stretch.time[:8], stretch.angle[:8])
    with pytest.raises(UnfollowedError, match=message):
        fit_decay(truth.decay.moved(change), few, ALWAYS)


def test_unknowns_that_do_the_same_are_not_separated(known):
    """Within the first arc alone no impact has shown its e."""
    truth = known()
    first = truth.samples.time < truth.decay.arcs()[2][0]
    stretch = Stretch(truth.samples.time[first], truth.samples.angle[first])
    with pytest.raises(UnfollowedError, match="no effect"):
        fit_decay(truth.decay, stretch, ALWAYS)


def test_nearest_is_the_way_to_the_end_before_or_after():
    ends = np.array([1.0, 2.0, 4.0])
    np.testing.assert_allclose(nearest(np.array([0.5, 1.0, 1.4, 3.5, 6.0]), ends), [0.5, 0.0, 0.4, 0.5, 2.0])


def test_a_low_pass_rounds_the_corners_and_nothing_else(known):
    truth = known()
    rounded = np.abs(blur(truth.decay, stretch_of(truth, cutoff_hz=20.0)))
    near = nearest(truth.samples.time, truth.decay.arcs()[2]) < 0.04
    assert rounded[near].max() > 5 * np.quantile(rounded[~near], 0.95)
    assert not blur(truth.decay, stretch_of(truth)).any()


def test_the_cut_off_is_found_by_the_rounding(known):
    truth = known()
    stretch = stretch_of(truth, cutoff_hz=15.0)
    filtered = replace(stretch, angle=stretch.angle + blur(truth.decay, stretch))
    assert closest_cutoff(truth.decay, filtered, 12.0) == pytest.approx(15.0, rel=0.05)
    assert closest_cutoff(truth.decay, replace(filtered, interval=None), 12.0) == 12.0


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
