"""What a stage reads of the campaign changes, as JSON, with the settings that it reads and with no others."""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace

import pytest

from colonnade.campaign.settings import Processing
from colonnade.stages.compare import CompareInputs
from colonnade.stages.condition import ConditionInputs
from colonnade.stages.contact import ContactInputs
from colonnade.stages.contact_ensemble import ContactEnsembleInputs
from colonnade.stages.ensemble import EnsembleInputs
from colonnade.stages.ingest import IngestInputs
from colonnade.stages.predict import PredictInputs
from colonnade.stages.restitution import RestitutionInputs
from colonnade.stages.rocking import RockingInputs
from colonnade.stages.specimen import SpecimenInputs

IN_SPACE = {"contact", "predict contact", "ensemble contact"}
MEASURED = {"condition", "restitution", "ensemble", "ensemble contact"}

READ_BY = {
    "spike_threshold = 9": {"ingest"},
    'flat_duration = "1 s"': {"ingest"},
    "gap = 2": {"ingest"},
    "jitter = 0.1": {"ingest"},
    'sampling_rate = "100 Hz"': {"condition"},
    'lowpass = "20 Hz"': {"condition"},
    "filter_order = 2": MEASURED,
    'rest_duration = "1 s"': {"condition", "rocking"},
    'longest_offset = "2 s"': {"condition"},
    "restitution.lowest_amplitude = 0.1": {"restitution", *IN_SPACE},
    "restitution.level = 0.9": {"restitution", "specimen"},
    "predict.rest_angle = 1e-5": {"predict", "predict contact", "ensemble", "ensemble contact"},
    "predict.ensemble.p = 0.01": {"ensemble"},
    "predict.ensemble.members = 7": {"ensemble"},
    "predict.ensemble.horizon = 0.3": {"ensemble", "ensemble contact"},
    "predict.ensemble.contact.members = 7": {"ensemble contact"},
    "predict.contact.friction = 0.5": IN_SPACE,
    'predict.models = ["linear"]': set(),
}


def _inputs(campaign):
    test = campaign.tests["free-01"]
    read = {
        "ingest": IngestInputs.of(campaign, test),
        "condition": ConditionInputs.of(campaign, test),
        "rocking": RockingInputs.of(campaign, test),
        "restitution": RestitutionInputs.of(campaign, test),
        "specimen": SpecimenInputs.of(campaign, "prism"),
        "contact": ContactInputs.of(campaign, "prism"),
        "predict": PredictInputs.of(campaign, test, "linear"),
        "predict contact": PredictInputs.of(campaign, test, "contact"),
        "ensemble": EnsembleInputs.of(campaign, test, "linear"),
        "ensemble contact": ContactEnsembleInputs.of(campaign, test),
        "compare": CompareInputs.of(campaign, test),
    }
    return {name: json.loads(each.model_dump_json()) for name, each in read.items()}


@pytest.mark.parametrize(("setting", "stages"), READ_BY.items(), ids=[setting.split(" =")[0] for setting in READ_BY])
def test_a_setting_changes_the_inputs_of_the_stages_that_read_it(small_campaign, setting, stages):
    before, changed = (
        _inputs(replace(small_campaign, processing=Processing.model_validate(tomllib.loads(text))))
        for text in ("", setting)
    )
    assert {name for name in before if before[name] != changed[name]} == stages


def test_a_part_that_a_stage_does_not_read_does_not_change_its_inputs(small_campaign):
    setup = small_campaign.setups["frame"]
    moved = setup.channels["top"].model_copy(update={"at": (0.043, 0.0, 0.3)})
    channels = setup.channels | {"top": moved}
    other = replace(small_campaign, setups={"frame": setup.model_copy(update={"channels": channels})})
    before, changed = _inputs(small_campaign), _inputs(other)
    assert {name for name in before if before[name] != changed[name]} == {"condition", "rocking"}
