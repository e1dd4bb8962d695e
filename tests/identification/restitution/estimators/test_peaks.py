"""e from peaks, given exactly by the energy that each impact leaves, without a history."""

import numpy as np
import pytest

from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.estimators.peaks import FEWEST_PEAKS, PeakDecay
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.free_vibration import FreeVibration
from every import every
from prism import PRISM

ALPHA = PRISM.critical_angle
ERROR = 1e-5


def peaks_of(restitution, count=16, released=0.6):
    """Signed peaks, rad: each impact multiplies cos(α − |θ|) − cos α by e²."""
    e = np.broadcast_to(restitution, count - 1)
    first = np.cos(ALPHA * (1 - released)) - np.cos(ALPHA)
    lifts = first * np.concatenate(([1.0], np.cumprod(e**2)))
    return (ALPHA - np.arccos(lifts + np.cos(ALPHA))) * np.where(np.arange(count) % 2 == 0, 1.0, -1.0)


def fit(peaks, *, usable=None, error=ERROR, block=PRISM, level=0.95):
    times = np.arange(peaks.size, dtype=float)
    nothing = np.full(peaks.size, np.nan)
    arcs = Arcs(times, times + 1, times + 0.5, peaks, np.full(peaks.size, error), *[nothing] * 5)
    samples = AngleSamples(np.empty(0), np.empty(0), None)
    used = np.ones(peaks.size, dtype=bool) if usable is None else usable
    return PeakDecay().fit(FreeVibration(block, samples, arcs, used, 0.0, 1e-6, 0.0, level))


@every("restitution", [0.8, 0.95, 0.99])
@every("offset", [0.0, -0.002, 0.002])
def test_exact_peaks_give_e_and_their_common_zero_offset(restitution, offset):
    peaks = peaks_of(restitution, count=8)
    assert np.abs(peaks).min() > abs(offset)  # a larger offset hides on which side the last peaks are
    found = fit(peaks + offset)
    assert found.estimate.value == pytest.approx(restitution, rel=1e-9)
    assert found.zero_offset == pytest.approx(offset, abs=1e-9)
    np.testing.assert_allclose(found.peaks.angle, peaks, atol=1e-9)
    np.testing.assert_allclose(found.peaks.fitted_angle, peaks, atol=1e-8)


def test_peaks_that_are_missing_still_count_their_impacts():
    peaks = peaks_of(0.93)
    usable = np.ones(peaks.size, dtype=bool)
    usable[[0, 3, 4, 9]] = False
    peaks[~usable] = 99.0
    found = fit(peaks, usable=usable)
    assert found.estimate.value == pytest.approx(0.93, rel=1e-9)
    assert np.isnan(found.peaks.fitted_angle).tolist() == (~usable).tolist()
    assert found.peaks.used.tolist() == usable.tolist()


def test_the_sides_of_a_block_have_their_own_critical_angles():
    block = PRISM.override(critical_angle=(0.9 * ALPHA, ALPHA))
    side = np.where(np.arange(12) % 2 == 0, 1.0, -1.0)
    alpha = np.where(side > 0, ALPHA, 0.9 * ALPHA)
    energy = 0.5 * 0.95 ** (2 * np.arange(12))
    found = fit(side * (alpha - np.arccos(np.cos(alpha) + energy * (1 - np.cos(alpha)))), block=block)
    assert found.estimate.value == pytest.approx(0.95, rel=1e-9)


def test_neither_inertia_nor_gravity_enters():
    peaks = peaks_of(0.95) + np.random.default_rng(1).normal(0, ERROR, 16)
    assert fit(peaks).estimate == fit(peaks, block=PRISM.override(inertia=2 * PRISM.inertia)).estimate


@pytest.mark.parametrize("scatter", [0.0, 0.01], ids=["one e", "e that scatters"])
def test_intervals_hold_the_truth_as_often_as_they_say(scatter):
    held, errors = [], []
    for seed in range(120):
        random = np.random.default_rng(seed)
        peaks = peaks_of(0.94 * np.exp(scatter * random.normal(size=15)))
        found = fit(peaks + random.normal(0, 1e-4, 16), error=1e-4, level=0.9).estimate
        held.append(found.low <= 0.94 <= found.high)
        errors.append((found.value - 0.94) / found.standard_error)
    # 108 of 120 expected, with a standard deviation of 3.3; wider intervals are allowed where the scatter is unknown.
    assert 97 <= sum(held) <= 119
    assert abs(np.mean(errors)) < 0.35


@pytest.mark.parametrize("scatter", [0.0005, 0.001, 0.003])
def test_intervals_are_as_wide_as_a_mean_of_so_many_impacts_and_not_wider(scatter):
    halves = []
    for seed in range(60):
        random = np.random.default_rng(seed)
        peaks = peaks_of(0.97 * np.exp(scatter * random.normal(size=23)), count=24, released=0.7)
        found = fit(peaks + random.normal(0, 3e-5, 24), error=3e-5).estimate
        halves.append((found.high - found.low) / 2)
    # 1.96 · 0.97 · scatter/√23 if the scatter is known; the noise of the peaks and Student's t add a little.
    assert np.mean(halves) == pytest.approx(1.96 * 0.97 * scatter / np.sqrt(23), rel=0.15)


def test_a_higher_level_has_a_wider_interval_about_the_same_value():
    peaks = peaks_of(0.95) + np.random.default_rng(2).normal(0, ERROR, 16)
    narrow, wide = (fit(peaks, level=level).estimate for level in (0.8, 0.99))
    assert narrow.value == pytest.approx(wide.value, abs=1e-9)
    assert wide.low < narrow.low < narrow.high < wide.high


@pytest.mark.parametrize("count", [0, FEWEST_PEAKS - 1])
def test_few_peaks_are_refused_with_their_number(count):
    found = fit(peaks_of(0.95), usable=np.arange(16) < count)
    assert found.estimate.value is None
    assert (
        found.objection == f"At least 5 peaks between two impacts, above the noise, are needed; the record has {count}."
    )
    assert (found.peaks, found.zero_offset) == (None, 0.0)


def test_as_many_peaks_as_are_needed_are_enough():
    found = fit(peaks_of(0.95), usable=np.arange(16) < FEWEST_PEAKS)
    assert found.estimate.value == pytest.approx(0.95, rel=1e-9)


def test_errors_below_any_noise_do_not_take_over():
    peaks = peaks_of(0.95) + np.random.default_rng(3).normal(0, ERROR, 16)
    believed, exact = fit(peaks, error=1e-9), fit(peaks, error=0.0)
    assert exact.estimate.value == believed.estimate.value
    assert exact.estimate.standard_error == believed.estimate.standard_error > 0
