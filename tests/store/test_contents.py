"""The table of contents of results: all described variables, and no file with others."""

from __future__ import annotations

import re

import netCDF4
import pytest

from colonnade.dynamics.models.registry import MODELS
from colonnade.store.contents import CONTENTS
from colonnade.store.results import STAGES
from colonnade.store.variables import VARIABLES


def test_it_has_every_stage_and_every_variable():
    assert list(CONTENTS) == list(STAGES)
    assert {name for names in CONTENTS.values() for name in names} == VARIABLES.keys()
    assert all(len(set(names)) == len(names) for names in CONTENTS.values())


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
            others = set(stored.variables) & VARIABLES.keys() - set(CONTENTS[stage])
        assert others == set(), path
    assert {"ingest", "condition", "rocking", "specimen"} <= seen
