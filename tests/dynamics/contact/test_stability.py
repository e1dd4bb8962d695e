"""The longest step: just below it the contact stays bounded, just above it grows."""

import math

import numpy as np
import pytest

from colonnade.dynamics.contact import simulate as simulation
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.stability import highest_frequency, longest_step
from colonnade.dynamics.motion import Motion
from prism import PRISM

BODY = rigid_body(PRISM)


def test_the_highest_frequency_is_that_of_rocking_on_springs_where_sliding_is_soft():
    law = ContactLaw(1e10, tangential_ratio=1e-9)
    stiffness = law.node_stiffness(BODY)
    bounce = math.sqrt(stiffness.sum() / BODY.mass)
    rock = math.sqrt((stiffness @ BODY.nodes[:, 0] ** 2) / BODY.inertia[1])
    assert highest_frequency(BODY, law) == pytest.approx(max(bounce, rock), rel=1e-6)


def test_without_damping_the_longest_step_is_two_over_the_frequency():
    law = ContactLaw(1e10, damping_fraction=0.0)
    assert longest_step(BODY, law) == pytest.approx(2.0 / highest_frequency(BODY, law), rel=1e-4)


@pytest.mark.parametrize("fraction", [0.0, 0.4, 2.0])
def test_a_loaded_block_is_quiet_below_the_longest_step_and_not_above(fraction, monkeypatch):
    law = ContactLaw(1e10, damping_fraction=fraction, friction=math.inf)
    limit = longest_step(BODY, law)

    def ringing(step):
        # Under a gravity that keeps all nodes on the table.
        motion = Motion(np.zeros(61), 10 * step)
        history = simulation.simulate(BODY, motion, law=law, gravity=1e3, theta0=1e-9, step=step)
        return np.abs(history.angle[-10:]).max()

    assert ringing(0.9 * limit) < 1e-8
    monkeypatch.setattr(simulation, "longest_step", lambda *_: math.inf)
    assert ringing(1.1 * limit) > 1e-6
