"""The site of a virtual campaign: columns and questions that load, a hazard that falls, motions that can be read."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.campaign_file import FILE_NAME, campaign_text
from colonnade.laboratory.programme import prism_programme
from colonnade.laboratory.suite.site import LEVELS, add_site, annual_rate
from colonnade.readers.ground_motions.hazard import read_hazard
from colonnade.readers.ground_motions.record_set import read_record_set


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    plan = prism_programme("pulse", Motion(np.sin(np.linspace(0.0, 6.0, 600)), 0.01))
    (folder / FILE_NAME).write_text(campaign_text(plan), encoding="utf-8")
    add_site(plan, folder / FILE_NAME, seed=3)
    return load(folder)


def test_the_column_is_the_model_at_its_scale(campaign):
    column, block = campaign.prototype["prism"], campaign.block("prism")
    assert column.restitution == "identified"
    assert np.mean(column.critical_angle_range) == pytest.approx(block.critical_angle, rel=1e-3)
    assert np.mean(column.p_range) == pytest.approx(block.p / np.sqrt(20), rel=1e-3)


def test_its_records_and_its_hazard_can_be_read(campaign):
    asked = campaign.assessments["prism"]
    records = read_record_set(asked.records)
    assert len(records.records) == 24
    assert not records.left_out
    assert all(each.magnitude and each.distance for each in records.records)
    hazard = read_hazard(asked.hazard, measure="pgv", unit="m/s")
    assert hazard.rate == pytest.approx([annual_rate(each) for each in LEVELS], rel=1e-3)
    assert (np.diff(hazard.slopes) >= -0.1).all()
