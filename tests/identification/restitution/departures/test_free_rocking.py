"""Arcs of a rocking block are accepted; those of springs, of another block and of another shape are not."""

import numpy as np
import pytest

from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.arcs.arcs import find_arcs
from colonnade.identification.restitution.departures.free_rocking import objection
from prism import PRISM

ALPHA = PRISM.critical_angle
TIME = np.arange(0.0, 10.0, 0.002)


def said(angle, block=PRISM):
    arcs = find_arcs(TIME, angle + np.random.default_rng(0).normal(0, 5e-4 * ALPHA, TIME.size), block.p, lowest=0.004)
    usable = np.isfinite(arcs.peak_standard_error) & (np.abs(arcs.peak_angle) < block.critical_angle)
    assert usable.sum() >= 4
    return objection(arcs, usable, block)


def rocking(restitution, block=PRISM, released=0.6):
    history = rock(block, restitution=restitution, theta0=released * block.critical_angle, duration=10.0)
    return np.interp(TIME, history.time, history.angle)


@pytest.mark.parametrize("restitution", [0.85, 0.95, 0.99])
@pytest.mark.parametrize("released", [0.3, 0.8])
def test_a_rocking_block_meets_no_objection(restitution, released):
    assert said(rocking(restitution, released=released)) == ""


def test_a_decaying_sine_does_not_follow_the_amplitude():
    assert "does not follow the amplitude" in said(0.08 * np.exp(-0.05 * TIME) * np.cos(2 * np.pi * 1.42 * TIME))


def test_a_steady_sine_of_the_rocking_period_has_another_shape():
    assert "not the arc of" in said(0.05 * np.cos(2 * np.pi * 1.72 * TIME))


def test_another_block_has_other_times():
    other = PRISM.override(inertia=2 * PRISM.inertia)
    assert "Times between impacts" in said(rocking(0.95, block=other))
