"""A block through a base motion, impact by impact, where both are known in closed form."""

from math import acosh, sqrt

import numpy as np
import pytest

from colonnade.dynamics.plane import impact, linear, nonlinear, sampled_march, uplift
from colonnade.dynamics.plane.nonlinear import by_series
from colonnade.dynamics.plane.sides import sides_of
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
E = 0.9
SIDES = sides_of(PRISM, (E, E), 1e-6)
DT = 0.2 / P


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(impact, linear, nonlinear, sampled_march, uplift)


def propagate(base, angle=0.0, velocity=0.0, *, linearised=None, vertical=None):
    base = np.asarray(base, dtype=float)
    series = (
        None if linearised is None else by_series(np.zeros(base.size) if vertical is None else vertical, linearised)
    )
    return sampled_march.propagate(base, DT, SIDES, angle, velocity, series)


@pytest.mark.parametrize("linearised", [None, True], ids=["closed form", "series"])
def test_let_go_it_lands_as_housner_says(linearised):
    """After each impact (1 − φ)² = 1 − e² [1 − (1 − φ₀)²], and an arc lasts twice acosh(1 / (1 − φ))."""
    _, _, times, velocities, overturned = propagate(np.zeros(50), 0.5 * ALPHA, linearised=linearised)
    energy = 0.75 * E ** (2 * np.arange(times.size))
    quarters = np.array([acosh(1 / sqrt(1 - each)) for each in energy])
    np.testing.assert_allclose(P * times, 2 * np.cumsum(quarters) - quarters[0], rtol=1e-9)
    np.testing.assert_allclose(np.abs(velocities), P * ALPHA * np.sqrt(energy), rtol=1e-9)
    assert (np.sign(velocities) == -((-1.0) ** np.arange(times.size))).all()
    assert times.size >= 4
    assert np.isnan(overturned)


def test_a_base_that_pulls_less_than_alpha_moves_nothing():
    angles, velocities, times, _, overturned = propagate(0.999 * ALPHA * np.sin(np.arange(30)))
    assert not angles.any()
    assert not velocities.any()
    assert times.size == 0
    assert np.isnan(overturned)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_base_that_pulls_on_overturns_it_the_other_way(sign):
    """From rest under a/g = 2 α: |θ| = α (cosh x − 1), which is α at cosh x = 2."""
    angles, _, _, _, overturned = propagate(np.full(60, 2.0 * sign * ALPHA))
    inside = np.arange(6)
    np.testing.assert_allclose(angles[inside], -sign * ALPHA * (np.cosh(P * DT * inside) - 1), rtol=1e-9, atol=1e-15)
    assert P * overturned == pytest.approx(acosh(2.0), rel=1e-9)
    assert angles[-1] == -sign * np.pi / 2


def test_the_uplift_is_found_inside_a_sample():
    """a/g rises from 0 to 2 α over a sample: from its middle on θ = −α (sinh x − x) / 0.1, x from there."""
    angles, _, _, _, _ = propagate([0.0, 2.0 * ALPHA])
    assert angles[1] == pytest.approx(-ALPHA * (np.sinh(0.1) - 0.1) / 0.1, rel=1e-9)


def test_a_base_that_falls_lets_go_of_the_block_earlier():
    base, vertical = np.full(3, 0.8 * ALPHA), np.full(3, -0.3)
    assert propagate(base, linearised=True)[0][-1] == 0.0
    angles = propagate(base, linearised=True, vertical=vertical)[0]
    # θ̈ = p² [u (θ + α) − a/g] with u = 0.7: the arc grows as cosh √u x.
    expected = (0.8 - 0.7) * ALPHA / 0.7 * (np.cosh(sqrt(0.7) * P * DT * np.arange(3)) - 1)
    np.testing.assert_allclose(angles, -expected, rtol=1e-9, atol=1e-15)


def test_started_beyond_alpha_it_has_overturned_from_the_start():
    assert propagate(np.zeros(20), 1.05 * ALPHA)[4] == 0.0
    assert np.isnan(propagate(np.zeros(20), 1.05 * ALPHA, -0.3 * ALPHA * P)[4])


def test_left_to_itself_after_the_record_it_may_still_overturn():
    """At the record's end it is below α but too fast to stand: that end is when it overturned."""
    assert propagate(np.zeros(2), 0.5 * ALPHA, 0.6 * ALPHA * P)[4] == pytest.approx(DT)
    assert np.isnan(propagate(np.zeros(2), 0.5 * ALPHA, 0.4 * ALPHA * P)[4])


def test_more_impacts_than_there_is_room_for_are_kept():
    elastic = sides_of(PRISM, (1.0, 1.0), 1e-12)
    _, _, times, velocities, _ = sampled_march.propagate(np.zeros(300), DT, elastic, 0.05 * ALPHA, 0.0, None)
    assert times.size > 64
    np.testing.assert_allclose(np.abs(velocities), abs(velocities[0]), rtol=1e-9)
