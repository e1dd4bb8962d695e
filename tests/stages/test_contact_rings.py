"""The law of contact of a round specimen: stored by ring, and written so on its page."""

import numpy as np
import pytest
import xarray as xr

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.report.specimens_page import _contact
from colonnade.stages.contact import IDENTIFIED, law_variables
from colonnade.store.records.stored import Stored
from colonnade.store.variables import VARIABLES

CYLINDER = Block.cylinder(diameter=0.097, height=0.455, mass=26.30)


def test_mass_weight_and_radius_of_each_ring_are_stored_and_shown():
    body = rigid_body(CYLINDER)
    law = ContactLaw.stiff(body, CYLINDER.gravity)
    attributes = {"body": body.description, "contact_restitution_source": IDENTIFIED}
    stored = xr.Dataset(law_variables(body, law, CYLINDER.gravity), attrs=attributes)
    assert set(stored) <= set(VARIABLES)
    np.testing.assert_allclose(stored["ring_radius"], 0.0485 * np.arange(1, 5) / 4)
    assert float(stored["node_mass"].sum()) == pytest.approx(26.30)
    assert float(stored["node_weight"].sum()) == pytest.approx(26.30 * CYLINDER.gravity)
    shown = dict(_contact(Stored({("contact", None): stored})))
    assert shown["body"] == "rigid, round base, 4 whole rings"
    assert shown["base nodes"].startswith("4 rings of radius 12.1 to 48.5 mm, ")
