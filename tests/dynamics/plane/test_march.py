"""A block through a base motion, impact by impact, where both are known in closed form."""

from math import acosh, sqrt

import numpy as np
import pytest

from colonnade.dynamics.plane import arc, march, sides
from colonnade.dynamics.plane.march import FIRST_ROOM
from colonnade.dynamics.plane.run import NONE, Forcing
from colonnade.dynamics.plane.sides import sides_of
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
E = 0.9
DT = 0.2 / P


@pytest.fixture(autouse=True)
def as_python(interpreted):
    interpreted(arc, march, sides)


def propagate(base, angle=0.0, velocity=0.0, *, vertical=None, e=(E, E), rest_angle=1e-6):
    base = np.asarray(base, dtype=float)
    weights = NONE if vertical is None else 1.0 + vertical
    forcing = Forcing(0.0, np.pi / 2, DT, NONE, base, weights)
    *kept, end = march.propagate(
        forcing, sides_of(PRISM, e, rest_angle), is_linearised=True, angle=angle, velocity=velocity
    )
    return *kept, end.time


@pytest.mark.parametrize("vertical", [None, np.zeros(50)], ids=["closed form", "series"])
def test_let_go_it_lands_as_housner_says(vertical):
    """After each impact (1 − φ)² = 1 − e² [1 − (1 − φ₀)²], and an arc lasts twice acosh(1 / (1 − φ))."""
    _, _, times, velocities, overturned = propagate(np.zeros(50), 0.5 * ALPHA, vertical=vertical)
    energy = 0.75 * E ** (2 * np.arange(times.size))
    quarters = np.array([acosh(1 / sqrt(1 - each)) for each in energy])
    np.testing.assert_allclose(P * times, 2 * np.cumsum(quarters) - quarters[0], rtol=1e-9)
    np.testing.assert_allclose(np.abs(velocities), P * ALPHA * np.sqrt(energy), rtol=1e-9)
    assert (np.sign(velocities) == -((-1.0) ** np.arange(times.size))).all()
    assert times.size >= 4
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
    assert propagate(base)[0][-1] == 0.0
    angles = propagate(base, vertical=vertical)[0]
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
    _, _, times, velocities, _ = propagate(np.zeros(1000), 0.05 * ALPHA, e=(1.0, 1.0), rest_angle=1e-12)
    assert times.size > FIRST_ROOM
    np.testing.assert_allclose(np.abs(velocities), abs(velocities[0]), rtol=1e-9)


def test_past_return_it_falls_by_the_equation_until_it_lies():
    """Let go at rest above α: the height over α grows as cosh x."""
    angles, velocities, _, _, overturned = propagate(np.zeros(80), 1.1 * ALPHA)
    falling = np.arange(int(np.argmax(angles >= np.pi / 2)))
    np.testing.assert_allclose(angles[falling], ALPHA * (1 + 0.1 * np.cosh(P * DT * falling)), rtol=1e-10)
    assert falling.size > 10
    assert (angles[falling.size :] == np.pi / 2).all()
    assert not velocities[falling.size :].any()
    assert overturned == 0.0


def test_let_go_from_next_to_nothing_it_lands_at_once_and_goes_on():
    """The base pulls on: |θ| = α (a − 1) (cosh x − 1) on the other side, from the landing on."""
    for vertical in (None, np.zeros(2)):
        angles = propagate([-3.0 * ALPHA] * 2, -1e-200, vertical=vertical, e=(0.0, 0.0))[0]
        assert angles[1] == pytest.approx(2.0 * ALPHA * (np.cosh(P * DT) - 1), rel=1e-12)
