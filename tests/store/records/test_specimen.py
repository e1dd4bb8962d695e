"""What goes into the record of a specimen."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.stages.specimen import SpecimenInputs, taken
from colonnade.store.records.specimen import record_of_specimen


@pytest.fixture
def record(written):
    campaign = written()
    return lambda name: record_of_specimen(campaign, name, taken(None, SpecimenInputs.of(campaign, name)))


def test_prototype_values_stand_beside_the_models(record):
    prototype = record("prism").prototype
    assert prototype.sizes == pytest.approx({"width": 1.72, "depth": 1.72, "height": 9.12})
    assert prototype.p == pytest.approx(record("prism").p / np.sqrt(20))
    assert prototype.mass == pytest.approx(26.10 * 20**3)
    assert record("statue").prototype is None


def test_an_e_is_one_value_or_one_a_side_with_its_source(record):
    given, rigid = record("statue").restitution, record("prism").restitution
    assert (given.value, given.source, given.reason) == ((0.9, 0.8), "given", None)
    assert (rigid.value, rigid.source) == (pytest.approx(0.9485, abs=5e-5), "rigid-body")
    assert "have not been identified" in rigid.reason
