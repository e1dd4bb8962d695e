"""Steady responses: their order, size and period."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import MapPlan, steady_response
from colonnade.dynamics.plane.run import Harmonic
from harmonic import harmonic_run
from prism import PRISM

P = PRISM.p


def steady(frequency_ratio, amplitude_ratio, *, settling=400, model="linear"):
    plan = MapPlan(
        PRISM, frequency_ratio=frequency_ratio, amplitude_ratio=amplitude_ratio, restitution=0.9, model=model
    )
    return steady_response(plan, range(len(frequency_ratio)), settling)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_response_goes_from_rest_to_rocking_to_overturning(model):
    response = steady([3.35], [0.9, 1.1, 1.8], model=model, settling=150)
    assert response.order.tolist() == [[0, 1, -2]]
    assert response.amplitude[0, 0] == 0
    assert 0.1 < response.amplitude[0, 1] < 1
    assert math.isnan(response.amplitude[0, 2])


def test_symmetric_response_repeats_every_cycle_with_the_amplitude_of_its_arc(symmetric_responses):
    response = steady([5.0], [1.9, 2.0])
    closed = symmetric_responses(PRISM, frequency_ratio=5.0, amplitude_ratio=2.0, restitution=0.9)[0]
    x = np.linspace(0, math.pi / 5, 200_001)
    gain = 2.0 * math.tan(PRISM.critical_angle) / PRISM.critical_angle / 26
    start = -1 - gain * math.sin(closed.phase)
    rate = closed.velocity / (PRISM.critical_angle * P) - gain * 5 * math.cos(closed.phase)
    arc = 1 + gain * np.sin(5 * x + closed.phase) + start * np.cosh(x) + rate * np.sinh(x)
    assert abs(arc[-1]) < 1e-12
    assert response.order[0, 1] == 1
    assert response.amplitude[0, 1] == pytest.approx(arc.max(), rel=1e-8)


def test_sub_harmonic_responses_are_found_and_repeat_no_earlier():
    response = steady([6.5, 7.5], np.linspace(2.0, 5.0, 13), settling=200)
    rows, columns = np.nonzero(response.order > 1)
    assert rows.size > 0
    row, column = int(rows[0]), int(columns[0])
    order = int(response.order[row, column])
    omega, level = response.frequency_ratio[row] * P, float(response.amplitude_ratio[column])
    cycle = 2 * math.pi / omega
    run = harmonic_run(PRISM, Harmonic.cycles(omega, 260), level, (0.9, 0.9), samples=260, interval=cycle)
    tail = run.angle[-40:]
    assert np.abs(tail[order:] - tail[:-order]).max() < 1e-4 * PRISM.critical_angle
    assert np.abs(tail[1:] - tail[:-1]).max() > 1e-3 * PRISM.critical_angle


def test_no_symmetric_response_below_the_amplitude_that_feeds_its_losses(symmetric_responses):
    assert symmetric_responses(PRISM, frequency_ratio=5.0, amplitude_ratio=0.2, restitution=0.5) == []


def test_a_block_with_unequal_sides_has_no_symmetric_response(symmetric_responses):
    block = Block.measured(mass=1.0, pole_distance=0.2, critical_angle=(0.1, 0.2), inertia=0.1)
    with pytest.raises(ValueError, match="unequal sides"):
        symmetric_responses(block, frequency_ratio=5.0, amplitude_ratio=2.0, restitution=0.9)
