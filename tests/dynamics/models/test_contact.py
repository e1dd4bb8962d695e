"""The contact model as `rock` asks for it: a rigid body on a stiff table, without an e."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.models.contact import CONTACT
from colonnade.dynamics.models.model import Case
from prism import PRISM

CASE = Case(PRISM, None, None, 0.5 * PRISM.critical_angle, 0.0, 0.02, 1e-6, None, 0.0)


def test_without_a_law_the_table_is_stiff():
    law = ContactLaw.stiff(rigid_body(PRISM), PRISM.gravity)
    plain, named = CONTACT.run(CASE), CONTACT.run(replace(CASE, contact=law))
    assert plain.model == "contact"
    np.testing.assert_array_equal(plain.angle, named.angle)
    soft = CONTACT.run(replace(CASE, contact=replace(law, stiffness=law.stiffness / 100)))
    assert not np.array_equal(soft.angle, plain.angle)


def test_it_starts_as_asked():
    history = CONTACT.run(replace(CASE, omega0=-0.1, out_of_plane=0.01))
    assert history.angle[0] == pytest.approx(CASE.theta0)
    assert history.angular_velocity[0] == pytest.approx(-0.1)
    assert history.out_of_plane[0] == pytest.approx(0.01)


def test_an_e_is_refused_because_it_follows():
    with pytest.raises(ValueError, match="Do not give `restitution` to the contact model"):
        CONTACT.run(replace(CASE, restitution=0.9))
