"""What a stage reads of the campaign: its inputs as JSON, its channels sorted, the outline of each shape."""

import json
import tomllib

import pytest

from colonnade.campaign.settings import Processing
from colonnade.campaign.specimen import Cone, Cylinder, Measured, Prism
from colonnade.dynamics.kinematics import pole_position
from colonnade.stages.compare import CompareInputs
from colonnade.stages.condition import ConditionInputs
from colonnade.stages.contact import ContactInputs
from colonnade.stages.ensemble import EnsembleInputs
from colonnade.stages.ingest import IngestInputs
from colonnade.stages.parts.transducers import outline
from colonnade.stages.predict import PredictInputs
from colonnade.stages.restitution import RestitutionInputs
from colonnade.stages.rocking import RockingInputs
from colonnade.stages.specimen import SpecimenInputs
from every import every

IN_SPACE = {"contact", "predict contact", "ensemble contact"}
MEASURED = {"condition", "restitution", "ensemble", "ensemble contact"}

READ_BY = {
    "spike_threshold = 9": {"ingest"},
    'flat_duration = "1 s"': {"ingest"},
    "gap = 2": {"ingest"},
    "jitter = 0.1": {"ingest"},
    'sampling_rate = "100 Hz"': {"condition"},
    'lowpass = "20 Hz"': {"condition"},
    "filter_order = 2": MEASURED - {"restitution"},
    'rest_duration = "1 s"': {"condition", "rocking"},
    'longest_offset = "2 s"': {"condition"},
    "restitution.lowest_amplitude = 0.1": {"restitution", *IN_SPACE},
    "restitution.level = 0.9": {"restitution", "specimen"},
    "predict.rest_angle = 1e-5": {"predict", "predict contact", "ensemble", "ensemble contact"},
    "predict.ensemble.p = 0.01": {"restitution", "specimen", "ensemble"},
    "predict.ensemble.members = 7": {"ensemble"},
    "predict.ensemble.horizon = 0.3": {"ensemble", "ensemble contact"},
    "predict.ensemble.contact.members = 7": {"ensemble contact"},
    "predict.contact.friction = 0.5": IN_SPACE,
    'predict.models = ["linear"]': set(),
}


def _inputs(campaign):
    test = campaign.tests["free-01"]
    read = {
        "specimen": SpecimenInputs.of(campaign, "prism"),
        "contact": ContactInputs.of(campaign, "prism"),
        "predict": PredictInputs.of(campaign, test, "linear"),
        "predict contact": PredictInputs.of(campaign, test, "contact"),
        "ensemble": EnsembleInputs.of(campaign, test, "linear"),
        "ensemble contact": EnsembleInputs.of(campaign, test, "contact"),
    }
    for inputs in (IngestInputs, ConditionInputs, RockingInputs, RestitutionInputs, CompareInputs):
        read[inputs.__name__.removesuffix("Inputs").lower()] = inputs.of(campaign, test)
    return {name: json.loads(each.model_dump_json()) for name, each in read.items()}


def _changed_by(campaign, **parts):
    before, changed = _inputs(campaign), _inputs(campaign.but(**parts))
    return {name for name in before if before[name] != changed[name]}


@every(("setting", "stages"), READ_BY.items())
def test_a_setting_changes_the_inputs_of_the_stages_that_read_it(small_campaign, setting, stages):
    processing = Processing.model_validate(tomllib.loads(setting))
    assert _changed_by(small_campaign, processing=processing) == stages


def test_a_part_that_a_stage_does_not_read_does_not_change_its_inputs(small_campaign):
    setup = small_campaign.setups["frame"]
    moved = setup.channels["top"].model_copy(update={"at": (0.043, 0.0, 0.3)})
    setups = {"frame": setup.model_copy(update={"channels": setup.channels | {"top": moved}})}
    assert _changed_by(small_campaign, setups=setups) == {"condition", "rocking"}


CONE = Cone(shape="cone", base_diameter="97 mm", top_diameter="75 mm", height="0.5 m", mass="22 kg")


@pytest.mark.parametrize(
    ("specimen", "half_width", "half_depth", "taper"),
    [
        (Prism(shape="prism", width="86 mm", depth="60 mm", height="456 mm", mass="26 kg"), 0.043, 0.03, 0.0),
        (Cylinder(shape="cylinder", diameter="97 mm", height="455 mm", mass="26 kg"), 0.0485, 0.0485, 0.0),
        (CONE, 0.0485, 0.0485, -0.022),
    ],
    ids=["prism", "cylinder", "cone"],
)
def test_the_outline_is_half_the_dimensions(specimen, half_width, half_depth, taper):
    found = outline(specimen, specimen.block(9.81))
    assert (found.half_width, found.half_depth, found.taper) == pytest.approx((half_width, half_depth, taper))


def test_a_measured_specimen_is_as_wide_as_its_poles_are_apart():
    sizes = {"pole_distance": "610 mm", "critical_angle": "0.21 rad", "inertia": "41.2 kg m^2"}
    statue = Measured(shape="measured", mass="80 kg", **sizes)
    block = statue.block(9.81)
    assert outline(statue, block).half_width == pole_position(block)
