"""`colonnade map` as a person meets it: a table, the paths, and what to do where it cannot be."""

import json
import re
from pathlib import Path

import pytest

SMALL = ("--omega", "2", "4", "--amplitude", "0.8", "2", "--points", "3", "5", "--cycles", "3", "--workers", "1")


def test_a_map_is_written_with_its_picture(colonnade, campaign):
    told = colonnade("map", *SMALL, "--phase", "90", "--ramp", "1")
    assert (told.returncode, told.stderr) == (0, "")
    paths = dict(line.split(": ") for line in told.stdout.splitlines()[1:])
    assert Path(paths["map"]) == campaign / "processed" / "maps" / "prism-nonlinear.nc"
    assert "<svg" in Path(paths["figure"]).read_text(encoding="utf-8")
    assert told.stdout.startswith("prism, nonlinear model: no measured point, e rigid-body; computed\n")


def test_commands_have_one_default_model():
    from colonnade.campaign.assessment import Assessment
    from colonnade.workflow.map_plans import Wanted
    from colonnade.workflow.spectrum import AskedSpectrum

    asked = (table.model_fields["model"].default for table in (AskedSpectrum, Assessment))
    assert {*asked, *Wanted().models} == {"nonlinear"}


def test_each_model_has_its_own_map_and_json_tells_where(colonnade, campaign):
    told = colonnade("map", *SMALL, "--model", "nonlinear", "--json")
    assert told.returncode == 0
    (made,) = json.loads(told.stdout)
    assert (made["specimen"], made["model"], made["action"]) == ("prism", "nonlinear", "done")
    assert made["path"].endswith("prism-nonlinear.nc")
    again = json.loads(colonnade("map", *SMALL, "--model", "nonlinear", "--json").stdout)
    assert again[0]["action"] == "up-to-date"


@pytest.mark.whole
def test_several_models_and_their_responses_are_written_with_a_picture_together(colonnade, campaign):
    models = ("--model", "linear", "--model", "nonlinear")
    told = colonnade("map", *SMALL, *models, "--ramp", "1", "--responses")
    assert (told.returncode, told.stderr) == (0, "")
    maps = campaign / "processed" / "maps"
    written = {path.name for path in maps.iterdir()}
    kinds = (".nc", ".svg", "-response.nc", "-response.svg")
    each = {f"prism-{model}{kind}" for model in ("linear", "nonlinear") for kind in kinds}
    assert written == each | {"prism-linear+nonlinear.svg"}
    assert f"together: {maps / 'prism-linear+nonlinear.svg'}" in told.stdout
    together = (maps / "prism-linear+nonlinear.svg").read_text(encoding="utf-8")
    assert all(f"{model}: lower limit" in together for model in ("linear", "nonlinear"))
    assert "linear ramps of 1" in (maps / "prism-linear.svg").read_text(encoding="utf-8")
    made = json.loads(colonnade("map", *SMALL, *models, "--ramp", "1", "--json").stdout)
    said = [(each["model"], each["action"], each["responses"]) for each in made]
    assert said == [(model, "up-to-date", None) for model in ("linear", "nonlinear")]


CONTACT = """
[processing.predict.contact]
step = "30 us"
damping_fraction = 0.3
"""


def test_the_law_is_shown_and_stored(colonnade, campaign):
    path = campaign / "campaign.toml"
    path.write_text(path.read_text(encoding="utf-8") + CONTACT, encoding="utf-8")
    assert colonnade("calibrate").returncode == 2  # nothing is identified yet
    assert colonnade("identify", "--workers", "1").returncode == 0
    told = colonnade("calibrate", "--workers", "1")
    assert (told.returncode, told.stderr) == (0, "")
    assert "29.6 µs" in told.stdout  # what divides an interval of the free vibration
    assert f"law: {campaign / 'processed' / 'contact' / 'prism.nc'}" in told.stdout
    (made,) = json.loads(colonnade("calibrate", "--workers", "1", "--json").stdout)
    assert (made["specimen"], made["mesh"], made["damping_fraction"], made["reason"]) == ("prism", "rigid", 0.3, "")
    assert "velocity ratio" in told.stdout
    assert "identified" in told.stdout
    assert made["source"] == "identified"
    assert 1e-4 < abs(made["restitution"] - made["velocity_ratio"]) < 2e-3


def test_an_e_that_was_not_identified_is_shown_as_the_velocity_ratio(colonnade, campaign):
    few = CONTACT + "mesh = 300\n\n[processing.restitution]\nlowest_amplitude = 0.45\n"
    path = campaign / "campaign.toml"
    given = path.read_text(encoding="utf-8").replace('"26.10 kg"', '"26.10 kg", restitution = 0.97')
    path.write_text(given + few, encoding="utf-8")
    assert re.search(r"prism +300 .* velocity-ratio ", colonnade("calibrate", "--workers", "1").stdout)
    (made,) = json.loads(colonnade("calibrate", "--workers", "1", "--json").stdout)
    assert made["source"] == "velocity-ratio"
    assert made["restitution"] == made["velocity_ratio"]
