"""Outcome, peaks and energy of a history that is written by hand."""

from dataclasses import replace
from math import cos, nan

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.history import History, capped

BLOCK = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.20, 0.10), inertia=41.2)
NEGATIVE, POSITIVE = 0.20, 0.10
P = BLOCK.p
TIME = np.arange(5.0)


def history(angle, velocity=None, *, impacts=(), overturning_time=nan, model="linear"):
    angle = np.array(angle, dtype=float)
    velocity = np.zeros(angle.size) if velocity is None else np.array(velocity, dtype=float)
    none = np.array(impacts, dtype=float)
    return History(BLOCK, TIME[: angle.size], angle, velocity, none, none, none, overturning_time, model)


def test_the_largest_amplitude_is_not_that_of_the_largest_angle():
    found = history([0.0, -0.12, 0.0, 0.07, 0.0])
    assert found.peak_ratio == pytest.approx(0.7)
    assert found.peak_time == 3.0
    assert found.outcome == "rocking"


@pytest.mark.parametrize(("ratio", "outcome"), [(1e-3, "no-rocking"), (1.01e-3, "rocking")])
def test_what_hardly_moves_has_not_rocked(ratio, outcome):
    assert history([0.0, ratio * POSITIVE]).outcome == outcome


def test_a_block_that_overturned_has_no_peak_but_the_time_of_the_largest_angle_before():
    found = history([0.0, 0.05, 0.01, 0.2, 1.5], overturning_time=2.5)
    assert (found.outcome, found.peak_ratio, found.peak_time) == ("overturned", None, 1.0)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_energy_is_nothing_at_rest_and_one_where_it_stands_on_its_edge(model):
    np.testing.assert_allclose(history([0.0, POSITIVE, -NEGATIVE], model=model).energy, [0.0, 1.0, 1.0], atol=1e-14)


def test_energy_is_that_of_the_models_own_equation():
    height, speed = 0.06, 0.2
    linear = ((speed / P) ** 2 + POSITIVE**2 - (POSITIVE - height) ** 2) / POSITIVE**2
    exact = (0.5 * (speed / P) ** 2 + cos(POSITIVE - height) - cos(POSITIVE)) / (1 - cos(POSITIVE))
    found = history([height], [speed])
    assert found.energy[0] == pytest.approx(linear)
    assert replace(found, model="nonlinear").energy[0] == pytest.approx(exact)


def test_at_an_impact_the_velocity_says_which_side_it_is():
    energy = history([0.0, 0.0], [0.1, -0.1]).energy
    assert energy[0] == pytest.approx((0.1 / P / POSITIVE) ** 2)
    assert energy[1] == pytest.approx((0.1 / P / NEGATIVE) ** 2)


def test_impacts_count_if_the_block_rises_after_them():
    found = history([0.05, 0.02, -0.06, 0.0, 0.0], impacts=[1.5, 2.5])
    assert found.impacts == 1
    assert history([0.05, 0.02]).impacts == 0


def test_two_impacts_between_samples_count_once():
    assert history([0.05, 0.02, -0.06], impacts=[1.2, 1.4]).impacts == 1


def test_a_block_that_overturned_stays_at_its_critical_angle():
    angle = np.array([0.0, -0.15, -0.3, nan, nan])
    np.testing.assert_allclose(capped(TIME, angle, 2.0, BLOCK), [0.0, -0.15, -NEGATIVE, -NEGATIVE, -NEGATIVE])
    angle = np.array([0.0, 0.05, 0.3, 1.0, 0.4])
    np.testing.assert_allclose(capped(TIME, angle, 2.0, BLOCK), [0.0, 0.05, POSITIVE, POSITIVE, POSITIVE])


def test_gaps_of_a_block_that_stands_stay():
    np.testing.assert_array_equal(capped(TIME[:3], np.array([0.0, nan, 0.5]), nan, BLOCK), [0.0, nan, POSITIVE])
