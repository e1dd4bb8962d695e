"""`colonnade calibrate` as a person meets it."""

import json

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
    few = CONTACT + "\n[processing.restitution]\nlowest_amplitude = 0.45\n"
    path = campaign / "campaign.toml"
    given = path.read_text(encoding="utf-8").replace('"26.10 kg"', '"26.10 kg", restitution = 0.97')
    path.write_text(given + few, encoding="utf-8")
    assert " velocity-ratio " in colonnade("calibrate", "--workers", "1").stdout
    (made,) = json.loads(colonnade("calibrate", "--workers", "1", "--json").stdout)
    assert made["source"] == "velocity-ratio"
    assert made["restitution"] == made["velocity_ratio"]
