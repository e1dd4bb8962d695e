"""A free vibration as the estimators see it: samples, arcs, and what of them is usable."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.record import Record, thinned
from colonnade.laboratory.truth import simulate
from prism import PRISM

ALPHA = PRISM.critical_angle
NOISE = 1e-4


@pytest.fixture(scope="module")
def history():
    return simulate(PRISM, np.arange(0.0, 6.0, 0.001), restitution=0.93, theta0=0.6 * ALPHA)


@pytest.fixture(scope="module")
def samples(history):
    angle = history.angle + np.random.default_rng(0).normal(0.0, NOISE, history.time.size)
    return thinned(history.time, angle, PRISM)


def seen(samples, *, lowest_amplitude=0.05, noise=None):
    return Record.seen(samples, PRISM, lowest_amplitude, noise)


def test_arcs_lie_between_the_impacts_and_have_their_peaks(history, samples):
    record = seen(samples)
    count = int(record.usable.sum())
    assert count >= 10
    impacts = history.impact_times[: count + 1]
    np.testing.assert_allclose(record.arcs.start[:count], impacts[:-1], atol=0.01)
    for n in range(count):
        inside = (history.time >= impacts[n]) & (history.time <= impacts[n + 1])
        peak = history.angle[inside][np.abs(history.angle[inside]).argmax()]
        assert record.peaks.angle[n] == pytest.approx(peak, abs=4 * NOISE)


@pytest.mark.parametrize("lowest", [0.05, 0.2])
def test_peaks_below_the_lowest_amplitude_are_not_counted(samples, lowest):
    record = seen(samples, lowest_amplitude=lowest)
    assert record.lowest == record.least == pytest.approx(lowest * ALPHA)
    assert np.abs(record.arcs.peak_angle[record.usable]).min() > lowest * ALPHA


def test_peaks_within_the_noise_are_not_counted(samples):
    record = seen(samples, noise=0.02 * ALPHA)
    assert record.lowest == pytest.approx(0.16 * ALPHA)  # eight standard deviations
    assert record.least == pytest.approx(0.05 * ALPHA)
    assert record.usable.sum() < seen(samples).usable.sum()


def test_the_noise_is_that_of_the_averaged_angle(samples):
    # Averaging over 0.1/p is over so many samples, an odd number of them, of white noise.
    length = 2 * (int(0.1 / (PRISM.p * samples.interval)) // 2) + 1
    assert length > 3
    rest = np.random.default_rng(1).normal(0.0, NOISE, samples.time.size)
    found = seen(replace(samples, angle=rest)).noise
    assert found == pytest.approx(NOISE / np.sqrt(length), rel=0.25)


def test_a_missing_sample_takes_its_arc_alone(samples):
    whole = seen(samples)
    middle = np.searchsorted(samples.time, (whole.arcs.start[3] + whole.arcs.end[3]) / 2)
    angle = samples.angle.copy()
    angle[middle] = np.nan
    record = seen(replace(samples, angle=angle))
    assert record.arcs.peak_angle.size == whole.arcs.peak_angle.size
    assert np.flatnonzero(record.usable != whole.usable).tolist() == [3]


def test_a_peak_above_the_critical_angle_is_not_usable(samples):
    record = seen(replace(samples, angle=2.5 * samples.angle))
    size = np.abs(record.arcs.peak_angle)
    assert (size[:3] > ALPHA).any()
    assert not record.usable[size >= ALPHA].any()
    assert record.usable[(size < ALPHA) & (size > record.lowest)].all()


def test_about_another_zero_peaks_move_and_impacts_stay(samples):
    record = seen(samples)
    moved = replace(record, zero=0.003)
    assert moved.arcs.start.tolist() == record.arcs.start.tolist()
    usable = record.usable & moved.usable
    shift = record.arcs.peak_angle[usable] - moved.arcs.peak_angle[usable]
    np.testing.assert_allclose(shift, 0.003, atol=1e-5)


@pytest.mark.parametrize("angle", [np.zeros(200), np.full(200, np.nan)], ids=["at rest", "missing throughout"])
def test_a_record_without_rocking_has_no_arcs(angle):
    record = seen(thinned(np.arange(200) * 0.01, angle, PRISM))
    assert record.usable.size == record.peaks.angle.size == 0


def test_the_longest_run_on_alternating_sides_begins_a_path(samples):
    record = seen(samples)
    peaks, times = record.run()
    assert peaks.tolist() == record.arcs.peak_angle[record.usable].tolist() or peaks.size >= record.usable.sum()
    assert (np.diff(np.sign(peaks)) != 0).all()
    assert (np.diff(times) > 0).all()


def test_groups_are_as_long_as_the_step_allows_and_white_noise_stays_white():
    time = np.arange(60_000) * 1e-4
    noise = np.random.default_rng(0).normal(0.0, 1.0, time.size)
    found = thinned(time, 1e-4 * noise, PRISM)
    assert found.group == int(0.02 / (PRISM.p * 1e-4))
    assert found.interval == pytest.approx(found.group * 1e-4)
    assert found.step == pytest.approx(1e-4)
    assert 1e4 * found.angle.std() == pytest.approx(1 / np.sqrt(found.group), rel=0.05)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_bend_of_rocking_within_a_group_is_taken_off(side):
    time = np.arange(3000) * 1e-4
    height = ALPHA - 0.6 * ALPHA * np.cosh(PRISM.p * (time - time.mean()))
    found = thinned(time, side * height, PRISM)
    exact = ALPHA - 0.6 * ALPHA * np.cosh(PRISM.p * (found.time - time.mean()))
    assert np.abs(side * found.angle - exact).max() < 2e-8


def test_an_uneven_clock_and_a_coarse_record_are_kept_as_they_are():
    time = np.sort(np.random.default_rng(1).uniform(0, 5, 500))
    assert not thinned(time, np.zeros(500), PRISM).is_even
    assert thinned(time, np.zeros(500), PRISM).time is time
    assert thinned(np.arange(50) * 0.01, np.zeros(50), PRISM).group == 1
