"""A free vibration as the estimators see it: arcs, what of them is usable, and fits that are made once."""

import numpy as np
import pytest

from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.free_vibration import MOVING_TABLE, FreeVibration
from colonnade.identification.restitution.result import Estimate
from colonnade.laboratory.truth import simulate
from prism import PRISM

ALPHA = PRISM.critical_angle
NOISE = 1e-4


class Counted(Estimator[Fit]):
    """An estimator that counts how often it is asked."""

    name = "counted"
    label = assumptions = description = "made for a test"

    def __init__(self):
        self.asked = 0

    def fit(self, record):
        self.asked += 1
        value = 0.5 + 0.01 * record.left_out
        return Fit(Estimate(self.name, value, value, value, 0.0, record.level, ""))


@pytest.fixture(scope="module")
def history():
    return simulate(PRISM, np.arange(0.0, 6.0, 0.001), restitution=0.93, theta0=0.6 * ALPHA)


@pytest.fixture(scope="module")
def samples(history):
    angle = history.angle + np.random.default_rng(0).normal(0.0, NOISE, history.time.size)
    return AngleSamples(history.time, angle, float(history.time[1] - history.time[0]))


def seen(samples, *, lowest_amplitude=0.05, noise=None, **settings):
    return FreeVibration.seen(samples, PRISM, lowest_amplitude=lowest_amplitude, noise=noise, **settings)


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
    found = seen(AngleSamples(samples.time, rest, samples.interval)).noise
    assert found == pytest.approx(NOISE / np.sqrt(length), rel=0.25)


def test_uneven_samples_are_seen_as_well(samples):
    uneven = AngleSamples(samples.time, samples.angle, None)
    assert seen(uneven).arcs.peak_angle.tolist() == seen(samples).arcs.peak_angle.tolist()


def test_a_missing_sample_takes_its_arc_alone(samples):
    whole = seen(samples)
    middle = np.searchsorted(samples.time, (whole.arcs.start[3] + whole.arcs.end[3]) / 2)
    angle = samples.angle.copy()
    angle[middle] = np.nan
    record = seen(AngleSamples(samples.time, angle, samples.interval))
    assert record.arcs.peak_angle.size == whole.arcs.peak_angle.size
    assert np.flatnonzero(record.usable != whole.usable).tolist() == [3]


def test_a_peak_above_the_critical_angle_is_not_usable(samples):
    record = seen(AngleSamples(samples.time, 2.5 * samples.angle, samples.interval))
    size = np.abs(record.arcs.peak_angle)
    assert (size[:3] > ALPHA).any()
    assert not record.usable[size >= ALPHA].any()
    assert record.usable[(size < ALPHA) & (size > record.lowest)].all()


def test_about_another_zero_peaks_move_and_impacts_stay(samples):
    record = seen(samples)
    moved = record.about(0.003)
    assert moved.zero == 0.003
    assert moved.arcs.start.tolist() == record.arcs.start.tolist()
    usable = record.usable & moved.usable
    shift = record.arcs.peak_angle[usable] - moved.arcs.peak_angle[usable]
    np.testing.assert_allclose(shift, 0.003, atol=1e-5)
    assert moved.samples is record.samples
    assert moved.fits is record.fits  # what followed the samples themselves stays as it is


def test_without_its_first_arcs_a_record_keeps_their_numbers(samples):
    record = seen(samples)
    later = record.without_first(3)
    assert not later.usable[:3].any()
    assert later.usable[3:].tolist() == record.usable[3:].tolist()
    assert later.left_out == 3
    assert later.arcs is record.arcs
    assert later.followed_arcs.peak_angle.tolist() == record.arcs.peak_angle[3:].tolist()
    assert record.without_first(0) is record


def test_a_fit_is_made_once_and_anew_where_arcs_are_left_out(samples):
    record, estimator = seen(samples), Counted()
    assert record.fitted(estimator) is record.fitted(estimator) is record.about(0.001).fitted(estimator)
    assert estimator.asked == 1
    later = record.without_first(2)
    assert later.fitted(estimator).estimate.value == pytest.approx(0.52)
    assert estimator.asked == 2


def test_an_estimator_that_takes_the_table_to_be_at_rest_is_not_asked_on_one_that_moves(samples):
    estimator = Counted()
    record = seen(samples, base=BaseMotion(np.ones(4), 0.0, 0.1), level=0.9)
    refused = record.fitted(estimator).estimate
    assert (refused.value, refused.reason, refused.level) == (None, MOVING_TABLE, 0.9)
    assert estimator.asked == 0


def test_peaks_are_given_without_a_fit(samples):
    record = seen(samples)
    assert np.isnan(record.peaks.fitted_angle).all()
    assert record.peaks.used is record.usable
    assert record.peaks.standard_error.tolist() == record.arcs.peak_standard_error.tolist()


@pytest.mark.parametrize("angle", [np.zeros(200), np.full(200, np.nan)], ids=["at rest", "missing throughout"])
def test_a_record_without_rocking_has_no_arcs(angle):
    record = seen(AngleSamples(np.arange(200) * 0.01, angle, 0.01))
    assert record.usable.size == record.peaks.angle.size == record.followed_arcs.start.size == 0
