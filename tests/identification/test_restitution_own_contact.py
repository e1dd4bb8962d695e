"""e of the contact model's block, which has none given: the identified one against its velocities at the impacts."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.layout import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from colonnade.identification.restitution.identify import identify_restitution

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)


@pytest.fixture(scope="module")
def rocked():
    """Free rocking on four corners, damped so that nothing bounces, as a recorder of 1 kHz sees it."""
    body = rigid_body(PRISM, grid=(2, 2))
    law = ContactLaw.stiff(body, PRISM.gravity, damping_fraction=2.0)
    return simulate(body, Motion(np.zeros(4001), 1e-3), law=law, theta0=0.5 * PRISM.critical_angle)


@pytest.fixture(scope="module")
def identified(rocked):
    noise = np.random.default_rng(1).normal(0.0, 1e-3 * PRISM.critical_angle, rocked.time.size)
    return identify_restitution(rocked.time, rocked.angle + noise, PRISM)


def test_the_recommended_e_is_the_mean_velocity_ratio(rocked, identified):
    assert rocked.airborne == 0.0
    # Depth of the contact, 1e-6 of the height, moves the poles: more than the interval tells, but less than 2e-4.
    assert identified.value == pytest.approx(rocked.impact_restitution[:10].mean(), abs=2e-4)


def test_e_of_each_impact_is_its_own_velocity_ratio(rocked, identified):
    found, error = identified.impacts.restitution, identified.impacts.restitution_standard_error
    # The first impact ends the release, which is no arc between two impacts.
    ratios = rocked.impact_restitution[1 : 1 + found.size]
    deviations = (found[: ratios.size] - ratios) / error[: ratios.size]
    assert np.abs(deviations[:8]).max() < 3.5
