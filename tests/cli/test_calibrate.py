"""`colonnade calibrate` as a person meets it."""

from __future__ import annotations

import json

from colonnade.campaign.settings import MESHES
from colonnade.cli.calibrate import calibrate

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
    told = colonnade("calibrate", "--workers", "1", "--step", "30 us", "--step", "20 us")
    assert (told.returncode, told.stderr) == (0, "")
    assert "29.6 µs" in told.stdout  # what divides an interval of the free vibration
    assert "19.7 µs" in told.stdout
    assert f"law: {campaign / 'processed' / 'contact' / 'prism.nc'}" in told.stdout
    (made,) = json.loads(colonnade("calibrate", "--workers", "1", "--json").stdout)
    assert (made["specimen"], made["mesh"], made["damping_fraction"], made["reason"]) == ("prism", "rigid", 0.3, "")
    assert "velocity ratio" in told.stdout
    assert 1e-4 < abs(made["restitution"] - made["velocity_ratio"]) < 2e-3


def test_the_meshes_are_those_of_the_settings():
    (mesh,) = (option for option in calibrate.params if option.name == "mesh")
    assert mesh.type.choices == MESHES


def test_a_step_without_a_unit_or_above_zero_is_refused(colonnade, campaign):
    for step in ("10", "0 s", "1 m"):
        told = colonnade("calibrate", "--step", step)
        assert told.returncode == 2
        assert told.stderr.startswith("--step")
