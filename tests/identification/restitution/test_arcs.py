"""Arcs and impacts of a record, and the energy that a peak holds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.identification.restitution.arcs import arcs_between, find_impacts, noise_level
from colonnade.identification.restitution.peaks import angle_of_energy, energy_slope, lift, released_energy

TIME = np.arange(0, 4, 0.002)


def test_impacts_are_the_zeros_between_opposite_excursions():
    impacts = find_impacts(TIME, 0.1 * np.sin(2 * np.pi * TIME), lowest=0.01)
    np.testing.assert_allclose(impacts, np.arange(0.5, 4, 0.5), atol=1e-5)


def test_noise_about_rest_is_no_impact():
    noise = np.random.default_rng(0).normal(0, 1e-3, TIME.size)
    assert find_impacts(TIME, noise, lowest=1e-2).size == 0


def test_noise_at_a_crossing_is_one_impact():
    angle = 0.1 * np.sin(np.pi * TIME) + np.random.default_rng(0).normal(0, 2e-3, TIME.size)
    np.testing.assert_allclose(find_impacts(TIME, angle, lowest=0.02), [1, 2, 3], atol=0.01)


def test_a_peak_is_fitted_better_than_the_highest_sample():
    p, alpha = 5.6, 0.18
    middle, height = 1.0013, 0.05
    half = np.arccosh(alpha / (alpha - height)) / p
    time = np.arange(0, 2, 0.005)
    arc = alpha - (alpha - height) * np.cosh(p * (time - middle))
    angle = np.where(np.abs(time - middle) < half, arc, -0.03)
    noisy = angle + np.random.default_rng(1).normal(0, 5e-4, time.size)
    arcs = arcs_between(find_impacts(time, noisy, lowest=0.01), time, noisy, p)
    assert arcs.peak_angle.size == 1
    assert abs(arcs.peak_angle[0] - height) < 4 * arcs.peak_standard_error[0]
    assert arcs.peak_standard_error[0] < 3e-4
    assert arcs.peak_time[0] == pytest.approx(middle, abs=5e-3)
    assert noisy.max() - height > abs(arcs.peak_angle[0] - height)


def test_an_arc_with_samples_missing_keeps_its_place_without_a_peak():
    angle = 0.1 * np.sin(2 * np.pi * TIME)
    angle[(TIME > 1.2) & (TIME < 1.22)] = np.nan
    arcs = arcs_between(find_impacts(TIME, angle, lowest=0.01), TIME, angle, 5.6)
    assert np.flatnonzero(np.isnan(arcs.peak_angle)).tolist() == [1]
    assert arcs.peak_angle.size == 6


def test_arcs_by_a_clock_in_the_wrong_unit_have_no_fit():
    time, angle = 1000 * TIME, 0.1 * np.sin(2 * np.pi * TIME)
    arcs = arcs_between(find_impacts(time, angle, lowest=0.01), time, angle, 5.6)
    assert arcs.peak_angle.size == 6
    assert np.isnan(arcs.peak_standard_error).all()


def test_noise_level_sees_white_noise_through_rocking():
    angle = 0.1 * np.sin(2 * np.pi * TIME) + np.random.default_rng(0).normal(0, 1e-3, TIME.size)
    assert noise_level(angle) == pytest.approx(1e-3, rel=0.1)
    assert noise_level(angle[:5]) == 0.0


SHARES = st.floats(0.001, 0.999)
ANGLES = st.floats(0.02, 1.2)


@given(SHARES, ANGLES)
def test_the_angle_of_an_energy_is_the_one_that_holds_it(share, critical):
    angle = share * critical
    assert angle_of_energy(released_energy(angle, critical), critical) == pytest.approx(angle, rel=1e-6)


@given(SHARES, ANGLES)
def test_the_lift_is_the_difference_of_cosines_without_its_cancellation(share, critical):
    angle = share * critical
    assert lift(angle, critical) == pytest.approx(np.cos(critical - angle) - np.cos(critical), abs=1e-15)
    assert lift(-angle, critical) == lift(angle, critical)


def test_a_slender_block_has_housners_energy():
    """Housner 1963, eq. 11: 1 − (1 − |θ|/α)² for small angles."""
    share = np.linspace(0.05, 0.95, 10)
    np.testing.assert_allclose(released_energy(1e-3 * share, 1e-3), 1 - (1 - share) ** 2, rtol=1e-5)


def test_at_the_critical_angle_all_of_the_barrier_is_held():
    np.testing.assert_allclose(released_energy([0.1, 0.4], [0.1, 0.4]), 1.0, rtol=1e-12)


@given(SHARES, ANGLES)
def test_the_slope_is_that_of_the_logarithm(share, critical):
    angle = min(share, 0.99) * critical
    step = 1e-5 * angle
    high, low = (float(np.log(lift(angle + sign * step, critical))) for sign in (1, -1))
    assert energy_slope(angle, critical) == pytest.approx((high - low) / (2 * step), rel=1e-4)


def test_a_missing_peak_has_no_slope():
    assert np.isnan(energy_slope(np.nan, 0.2))
    assert np.isinf(energy_slope(0.0, 0.2))
