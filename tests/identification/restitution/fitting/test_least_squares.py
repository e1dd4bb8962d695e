"""The unknowns of a free rocking are found from its samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.free_decay import ALWAYS
from colonnade.identification.restitution.fitting.least_squares import (
    Stretch,
    UnfollowedError,
    blur,
    closest_cutoff,
    fit_decay,
    nearest,
)

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
