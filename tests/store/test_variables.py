"""The table of variables: units that UDUNITS reads, stages that exist, and no file with others."""

from __future__ import annotations

import re

import netCDF4
import pytest
from compliance_checker.cfunits import Unit

from colonnade.dynamics.models.registry import MODELS
from colonnade.store.results import STAGES
from colonnade.store.variables import VARIABLES


def test_every_unit_of_the_table_is_one_that_udunits_reads():
    for name, variable in VARIABLES.items():
        if variable.units is not None:
            assert Unit(variable.units) is not None, name


def test_every_variable_is_of_some_stage_and_every_stage_has_some():
    assert {stage for each in VARIABLES.values() for stage in each.stages} == set(STAGES)
    assert [name for name, each in VARIABLES.items() if not each.stages] == []


def stage_of(path, processed):
    """Stage whose file this is."""
    place = path.relative_to(processed).with_suffix("").as_posix()
    patterns = {
        stage: entry.file.format(subject=r".+", model=f"({'|'.join(MODELS)})") for stage, entry in STAGES.items()
    }
    [fitting] = [stage for stage, pattern in patterns.items() if re.fullmatch(pattern, place)]
    return fitting


@pytest.mark.parametrize("campaign", ["filled", "assessed", "foreseen"])
def test_no_file_has_a_variable_that_its_stage_does_not_have(campaign, request):
    if campaign == "filled":
        processed = request.getfixturevalue("filled_campaign")[1].processed
    elif campaign == "assessed":
        processed = request.getfixturevalue("assessed") / "processed"
    else:
        processed = request.getfixturevalue("foreseen")[0] / "processed"
    seen = set()
    for path in processed.rglob("*.nc"):
        stage = stage_of(path, processed)
        seen.add(stage)
        with netCDF4.Dataset(path) as stored:
            known = set(stored.variables) & VARIABLES.keys()
        assert {name for name in known if stage not in VARIABLES[name].stages} == set(), path
    assert {"ingest", "condition", "rocking", "specimen"} <= seen
