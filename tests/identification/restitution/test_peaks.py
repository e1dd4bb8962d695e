"""e from peaks, given exactly by the energy that each impact leaves, without a history."""

import numpy as np
import pytest
import scipy

from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.restitution.peaks import FEWEST_PEAKS, fit_peaks
from colonnade.identification.restitution.result import Peaks
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


class Line:
    """What the peaks say of e, with its interval."""

    def __init__(self, found, level):
        solved, self.peaks = found
        self.offset, self.value = solved.mean[2], np.exp(solved.mean[0])
        ends = (solved.quantile(0.5 + sign * level / 2) for sign in (-1, 1))
        self.low, self.high = (np.exp(end) for end in ends)
        self.standard_error = (self.high - self.low) / 2 / scipy.special.ndtri((1 + level) / 2)


def fit(peaks, *, usable=None, error=ERROR, block=PRISM, level=0.95, known=0.0):
    times = np.arange(peaks.size, dtype=float)
    used = np.ones(peaks.size, dtype=bool) if usable is None else usable
    seen = Peaks(times + 0.5, peaks, np.full(peaks.size, error), np.full(peaks.size, np.nan), used)
    found = fit_peaks(seen, block, 1e-6, Uncertainty(critical_angle=known, angle_gain=known))
    return None if found is None else Line(found, level)


@every("restitution", [0.8, 0.95, 0.99])
@every("offset", [0.0, -0.002, 0.002])
def test_exact_peaks_give_e_and_their_common_zero_offset(restitution, offset):
    peaks = peaks_of(restitution, count=8)
    assert np.abs(peaks).min() > abs(offset)  # a larger offset hides on which side the last peaks are
    found = fit(peaks + offset)
    assert found.value == pytest.approx(restitution, rel=1e-9)
    assert found.offset == pytest.approx(offset, abs=1e-9)
    np.testing.assert_allclose(found.peaks.angle, peaks, atol=1e-9)
    np.testing.assert_allclose(found.peaks.fitted_angle, peaks, atol=1e-8)


def test_peaks_that_are_missing_still_count_their_impacts():
    peaks = peaks_of(0.93)
    usable = np.ones(peaks.size, dtype=bool)
    usable[[0, 3, 4, 9]] = False
    peaks[~usable] = 99.0
    found = fit(peaks, usable=usable)
    assert found.value == pytest.approx(0.93, rel=1e-9)
    assert np.isnan(found.peaks.fitted_angle).tolist() == (~usable).tolist()
    assert found.peaks.used.tolist() == usable.tolist()


def test_the_sides_of_a_block_have_their_own_critical_angles():
    block = PRISM.override(critical_angle=(0.9 * ALPHA, ALPHA))
    side = np.where(np.arange(12) % 2 == 0, 1.0, -1.0)
    alpha = np.where(side > 0, ALPHA, 0.9 * ALPHA)
    # p of both sides is the same here: the speed at an impact is that of a rise of the centre of mass.
    rise = 0.5 * (1 - np.cos(0.9 * ALPHA)) * 0.95 ** (2 * np.arange(12))
    found = fit(side * (alpha - np.arccos(np.cos(alpha) + rise)), block=block)
    assert found.value == pytest.approx(0.95, rel=1e-9)


def test_neither_inertia_nor_gravity_enters():
    peaks = peaks_of(0.95) + np.random.default_rng(1).normal(0, ERROR, 16)
    assert fit(peaks).value == pytest.approx(fit(peaks, block=PRISM.override(inertia=2 * PRISM.inertia)).value)


def test_an_uncertain_critical_angle_widens_the_interval():
    peaks = peaks_of(0.95) + np.random.default_rng(1).normal(0, ERROR, 16)
    exact, unsure = fit(peaks), fit(peaks, known=0.01)
    assert unsure.standard_error > 2 * exact.standard_error
    assert unsure.value == pytest.approx(exact.value, abs=3 * unsure.standard_error)


@pytest.mark.parametrize("scatter", [0.0, 0.01], ids=["one e", "e that scatters"])
def test_intervals_hold_the_truth_as_often_as_they_say(scatter):
    held, errors = [], []
    for seed in range(120):
        random = np.random.default_rng(seed)
        peaks = peaks_of(0.94 * np.exp(scatter * random.normal(size=15)))
        found = fit(peaks + random.normal(0, 1e-4, 16), error=1e-4, level=0.9)
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
        found = fit(peaks + random.normal(0, 3e-5, 24), error=3e-5)
        halves.append((found.high - found.low) / 2)
    # 1.96 · 0.97 · scatter/√23 if the scatter is known; the noise of the peaks and Student's t add a little.
    assert np.mean(halves) == pytest.approx(1.96 * 0.97 * scatter / np.sqrt(23), rel=0.15)


def test_a_higher_level_has_a_wider_interval_about_the_same_value():
    peaks = peaks_of(0.95) + np.random.default_rng(2).normal(0, ERROR, 16)
    narrow, wide = (fit(peaks, level=level) for level in (0.8, 0.99))
    assert narrow.value == pytest.approx(wide.value, abs=1e-9)
    assert wide.low < narrow.low < narrow.high < wide.high


@pytest.mark.parametrize("count", [0, FEWEST_PEAKS - 1, FEWEST_PEAKS])
def test_few_peaks_give_no_line(count):
    peaks, used = peaks_of(0.95), np.arange(16) < count
    assert (fit(peaks, usable=used) is None) == (count < FEWEST_PEAKS)


def test_errors_below_any_noise_do_not_take_over():
    peaks = peaks_of(0.95) + np.random.default_rng(3).normal(0, ERROR, 16)
    believed, exact = fit(peaks, error=1e-9), fit(peaks, error=0.0)
    assert exact.value == believed.value
    assert exact.standard_error == believed.standard_error > 0
