"""Free rocking by its unknowns, against Housner's closed forms; its derivatives against differences."""

from __future__ import annotations

from math import acosh, sqrt

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.energy import released_energy
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, OPTIONAL, Decay, first_values

LOPSIDED = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.15), inertia=41.2)
E = 0.92


def test_peaks_follow_housners_relation_on_both_models(known):
    """1 − φ = sqrt(1 − e² [1 − (1 − φ₀)²]) of the linear model."""
    decay = known(linearised=True).decay
    peaks = decay.arcs()[0] / decay.critical[0]
    np.testing.assert_allclose((1 - (1 - peaks) ** 2) / 0.75, E ** (2 * np.arange(8)), rtol=1e-12)


def test_an_arc_lasts_twice_the_quarter_period(known):
    decay = known(linearised=True).decay
    peaks, times, ends = decay.arcs()
    ratios = peaks / decay.critical[0]
    quarters = np.array([acosh(1 / (1 - ratio)) for ratio in ratios]) / decay.p[0]
    np.testing.assert_allclose(ends - times, quarters, rtol=1e-12)
    np.testing.assert_allclose(times[1:] - ends[:-1], quarters[1:], rtol=1e-12)


@pytest.mark.parametrize("linearised", [False, True])
def test_it_lands_as_fast_as_its_energy_says(known, linearised):
    decay = known(linearised=linearised).decay
    peaks, alpha = decay.arcs()[0], decay.critical[0]
    linear, full = 0.5 * (alpha**2 - (alpha - peaks) ** 2), np.cos(alpha - peaks) - np.cos(alpha)
    energy = linear if linearised else full
    np.testing.assert_allclose(decay.landing_speeds(), decay.p[0] * np.sqrt(2 * energy), rtol=1e-12)


def test_sides_alternate_and_each_has_its_own_block():
    values = {
        "restitution": np.log(0.9),
        "peak": 0.05,
        "time": 0.0,
        "zero_offset": 0.01,
        **dict.fromkeys(OPTIONAL, 0.0),
    }
    decay = Decay(values, 0, 3, LOPSIDED, True)
    np.testing.assert_allclose(decay.critical, [0.21, 0.15])
    assert decay.sides.tolist() == [0, 1, 0]
    angle, arc = decay.followed(decay.arcs()[1])
    np.testing.assert_allclose(angle, 0.01 + np.array([-1, 1, -1]) * decay.arcs()[0], rtol=1e-12)
    assert arc.tolist() == [0, 1, 2]
    assert decay.arcs()[2][0] == pytest.approx(acosh(0.21 / (0.21 - 0.05)) / decay.p[0], rel=1e-12)


def test_each_impact_may_have_an_e_of_its_own(known):
    plain, other = known(), known(deviations=[0.01, -0.02])
    first, second = (released_energy(each.decay.arcs()[0], each.decay.critical[0]) for each in (plain, other))
    lift = np.exp(2 * np.array([0.0, 0.01, -0.01, -0.01, -0.01, -0.01, -0.01, -0.01]))
    np.testing.assert_allclose(second / first, lift, rtol=1e-12)
    np.testing.assert_allclose(other.decay.by_impact, [0.01, -0.02, 0, 0, 0, 0, 0])


@pytest.mark.parametrize("linearised", [False, True])
def test_its_derivatives_are_those_of_differences(known, linearised):
    decay, samples = known(linearised=linearised, deviations=[0.01, -0.02])
    names = ALWAYS + OPTIONAL
    fixed, by_impact = decay.jacobian(samples.time, names)
    for column, name in enumerate(names):
        step = 1e-6
        ahead, behind = (decay.moved({name: sign * step}).angle_alone(samples.time) for sign in (1, -1))
        assert_close(fixed[:, column], (ahead - behind) / (2 * step))
    for impact in range(decay.count - 1):
        step = 1e-6 * (np.arange(decay.count - 1) == impact)
        ahead, behind = (decay.moved_by_impact({}, sign * step).angle_alone(samples.time) for sign in (1, -1))
        assert_close(by_impact[:, impact], (ahead - behind) / 2e-6)


def assert_close(found, expected):
    """Hold derivatives together; a sample next to an impact is on either side of it in the difference."""
    assert np.quantile(np.abs(found - expected), 0.99) < 1e-4 * np.abs(expected).max()


def test_it_starts_from_the_e_of_the_peaks():
    energy = 0.75 * E ** (2 * np.arange(6))
    found = first_values(energy, np.sqrt(energy), peak=0.1, time=2.0)
    assert found["restitution"] == pytest.approx(np.log(E), rel=1e-12)
    assert (found["peak"], found["time"], found["p"], found["zero_offset"]) == (0.1, 2.0, 0.0, 0.0)


@pytest.mark.parametrize(("ratio", "limit"), [(1.2, 0.9999), (0.01, 0.3)])
def test_an_e_that_cannot_be_starts_from_the_nearest_that_can(ratio, limit):
    found = first_values(ratio ** np.arange(5.0), np.ones(5), peak=sqrt(0.1), time=0.0)
    assert found["restitution"] == pytest.approx(np.log(limit))
