"""Peaks as a first guess, arcs before and after, and the band of the line."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.arcs.energy import angle_of_energy, released_energy
from colonnade.identification.restitution.fitting.confidence_band import confidence_band
from colonnade.identification.restitution.fitting.forecast import (
    BLURRED,
    FIRST_ARCS,
    RELEASED,
    earlier,
    extended,
    first_guess,
    fit_forward,
    stretch_of,
    without_first,
)
from colonnade.identification.restitution.fitting.free_decay import ALWAYS
from colonnade.identification.restitution.fitting.least_squares import UnfollowedError
from prism import PRISM


def arcs_of(angles, times):
    """Arcs of which only the peaks are asked for."""
    nothing = np.zeros(len(angles))
    return Arcs(nothing, nothing, np.array(times), np.array(angles), *[nothing] * 6)


def signed(decay):
    """Peaks with the sign of their side."""
    return np.where(decay.sides == 1, 1, -1) * decay.arcs()[0]


def test_the_first_guess_is_that_of_the_peaks(known):
    decay = known(count=14).decay
    found = first_guess(arcs_of(signed(decay), decay.arcs()[1]), decay.block, linearised=False)
    for name in ALWAYS:
        assert found.values[name] == pytest.approx(decay.values[name], abs=1e-9)
    assert (found.side, found.count) == (1, FIRST_ARCS)


def test_it_takes_the_longest_run_on_alternating_sides(known):
    decay = known(count=7).decay
    peaks = signed(decay)
    peaks[2] = np.nan
    found = first_guess(arcs_of(peaks, decay.arcs()[1]), decay.block, linearised=False)
    assert (found.values["time"], found.count, found.side) == (pytest.approx(decay.arcs()[1][3]), 4, 0)


@pytest.mark.parametrize(
    ("angles", "message"), [([0.1, np.nan, -0.1], "2 arcs are too few"), ([0.3, -0.1], "above the critical angle")]
)
def test_peaks_that_begin_no_decay_are_refused(known, angles, message):
    with pytest.raises(UnfollowedError, match=message):
        first_guess(arcs_of(angles, range(len(angles))), known().decay.block, linearised=False)


def test_a_stretch_goes_from_the_first_arc_to_the_end_of_the_last(known):
    decay, samples = known(count=5)
    _, times, ends = decay.arcs()
    shorter = replace(decay, count=3)
    inside = stretch_of(samples, shorter, margin=0.01)
    assert inside.time[-1] < ends[2] < inside.time[-1] + 0.011
    first = 2 * times[0] - ends[0] + BLURRED / decay.p[0]
    assert inside.time[0] - 0.01 < max(first, samples.time[0]) <= inside.time[0]
    released = stretch_of(samples, shorter, from_release=True)
    assert released.time[0] - 0.01 < times[0] + RELEASED * (ends[0] - times[0]) <= released.time[0]
    assert (inside.margin, inside.interval) == (0.01, 0.01)


def test_as_many_arcs_are_added_as_are_foreseen(known):
    decay, samples = known(count=12)
    short = replace(decay, count=4)
    sure = np.zeros(12)
    assert extended(short, decay, sure, samples, 0.0).count == 12
    unsure = np.where(np.arange(12) > 7, 1.0, 0.0)
    assert extended(short, decay, unsure, samples, 0.0).count == 8
    low = float(decay.arcs()[0][6])
    assert extended(short, decay, sure, samples, low).count == 6
    assert extended(short, decay, np.full(12, 1.0), samples, 0.0) is None


def test_a_record_is_followed_to_its_end_from_a_rough_guess(known):
    decay, samples = known(count=25)
    start = replace(decay, count=5).moved({"restitution": 0.004, "time": 2e-3})
    found, is_from_release = fit_forward(samples, start, ALWAYS, 1e-4, from_release=False)
    assert not is_from_release
    assert found.decay.count >= 24
    assert np.exp(found.decay.values["restitution"]) == pytest.approx(0.92, abs=1e-7)


def test_the_arc_before_the_first_is_the_one_that_leads_to_it(known):
    whole, samples = known(count=6)
    later = without_first(whole)
    assert (later.count, later.side) == (5, 0)
    np.testing.assert_allclose(later.arcs(), np.array(whole.arcs())[:, 1:], rtol=1e-10)
    back = earlier(later, replace(samples, time=samples.time - 1.0))
    assert (back.count, back.side) == (6, 1)
    assert back.values["peak"] == pytest.approx(whole.values["peak"], rel=1e-9)
    assert back.values["time"] == pytest.approx(whole.values["time"], rel=1e-9)


def test_no_arc_is_before_the_record(known):
    decay, samples = known(count=6)
    assert earlier(decay, samples) is None


NUMBER = np.arange(20)
TRUTH = np.log(0.7) + 2 * np.log(0.96) * NUMBER
ERROR = np.full(NUMBER.size, 2e-4)


def peaks(seed):
    angle = np.asarray(angle_of_energy(np.exp(TRUTH), PRISM.critical_angle)) * (-1.0) ** NUMBER
    return angle + ERROR * np.random.default_rng(seed).normal(size=NUMBER.size)


def line(angle):
    """The line with its offset by plain weighted least squares, of tests' own."""
    size = np.abs(angle)
    energy = np.log(released_energy(size, PRISM.critical_angle))
    slope = np.sin(PRISM.critical_angle - size) / (np.cos(PRISM.critical_angle - size) - np.cos(PRISM.critical_angle))
    design = np.column_stack((np.ones(NUMBER.size), NUMBER, np.sign(angle) * slope))
    weight = 1 / (slope * ERROR)
    solved = np.linalg.lstsq(design * weight[:, None], energy * weight, rcond=None)[0]
    return solved[0] + solved[1] * NUMBER


def test_the_band_holds_the_true_line_as_often_as_it_says():
    inside = []
    for seed in range(100):
        angle = peaks(seed)
        half = confidence_band(angle, ERROR, np.ones(NUMBER.size, dtype=bool), PRISM)
        inside.append(np.abs(line(angle) - TRUTH) < half)
    assert 0.92 < np.mean(inside) <= 0.995


def test_the_band_is_narrow_within_the_peaks_used_and_widens_beyond_them():
    used = (NUMBER >= 2) & (NUMBER < 12)
    half = confidence_band(peaks(0), ERROR, used, PRISM)
    assert half[used].max() < half[-1]
    wider = confidence_band(peaks(0), ERROR, used, PRISM, level=0.999)
    assert (wider > half).all()


@pytest.mark.parametrize("count", [0, 2, 3])
def test_too_few_peaks_have_no_band(count):
    half = confidence_band(peaks(0), ERROR, count > NUMBER, PRISM)
    assert np.isnan(half).all()
    assert half.shape == NUMBER.shape
