import numpy as np
import pytest

from colonnade.identification.restitution.arcs.arcs import find_arcs, find_impacts, noise_level

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
    arcs = find_arcs(time, noisy, p, lowest=0.01)
    assert arcs.peak_angle.size == 1
    assert abs(arcs.peak_angle[0] - height) < 4 * arcs.peak_standard_error[0]
    assert arcs.peak_standard_error[0] < 3e-4
    assert arcs.peak_time[0] == pytest.approx(middle, abs=5e-3)
    assert noisy.max() - height > abs(arcs.peak_angle[0] - height)


def test_an_arc_with_samples_missing_keeps_its_place_without_a_peak():
    angle = 0.1 * np.sin(2 * np.pi * TIME)
    angle[(TIME > 1.2) & (TIME < 1.22)] = np.nan
    arcs = find_arcs(TIME, angle, 5.6, lowest=0.01)
    assert np.flatnonzero(np.isnan(arcs.peak_angle)).tolist() == [1]
    assert arcs.peak_angle.size == 6


def test_arcs_by_a_clock_in_the_wrong_unit_have_no_fit():
    arcs = find_arcs(1000 * TIME, 0.1 * np.sin(2 * np.pi * TIME), 5.6, lowest=0.01)
    assert arcs.peak_angle.size == 6
    assert np.isnan(arcs.peak_standard_error).all()


def test_noise_level_sees_white_noise_through_rocking():
    angle = 0.1 * np.sin(2 * np.pi * TIME) + np.random.default_rng(0).normal(0, 1e-3, TIME.size)
    assert noise_level(angle) == pytest.approx(1e-3, rel=0.1)
    assert noise_level(angle[:5]) == 0.0
