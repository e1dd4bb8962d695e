"""The energy that a peak holds: Housner's relation, its inverse and its slope."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.identification.restitution.arcs.energy import angle_of_energy, energy_slope, lift, released_energy

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
