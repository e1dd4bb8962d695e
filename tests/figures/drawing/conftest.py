"""A campaign file as people write it, for drawings."""

import pytest

from colonnade.campaign import load

HEAD = """
schema = 1
campaign = "drawn"
title = "Drawn"
[specimens]
prism = {shape = "prism", width = "86 mm", depth = "60 mm", height = "456 mm", mass = "26.10 kg"}
cylinder = {shape = "cylinder", diameter = "97 mm", height = "455 mm", mass = "26.30 kg"}
cone = {shape = "cone", base_diameter = "97 mm", top_diameter = "75.5 mm", height = "480 mm", mass = "21.94 kg"}
statue = {shape = "measured", mass = "80 kg", pole_distance = ["610 mm", "600 mm"], critical_angle = ["0.21 rad", "0.24 rad"], inertia = "41.2 kg m^2", restitution = 0.9}
[setups.frame.channels]
top = {column = "1", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "440 mm"], direction = [1, 0, 0], relative_to = "table"}
laser = {column = "2", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "300 mm"], direction = [-1, 0, 0], relative_to = "ground", sensing = "surface", normal = [1, 0, 0]}
string = {column = "3", quantity = "displacement", unit = "mm", on = "specimen", at = ["-43 mm", "0 mm", "400 mm"], direction = [-1, 0, 0], relative_to = "ground", sensing = "wire", anchor = ["-300 mm", "0 mm", "420 mm"]}
gyro = {column = "4", quantity = "angular_velocity", unit = "rad/s", on = "specimen", direction = [0, 1, 0]}
across = {column = "5", quantity = "displacement", unit = "mm", on = "specimen", at = ["0 mm", "30 mm", "200 mm"], direction = [0, -1, 0], relative_to = "table"}
table_acceleration = {column = "6", quantity = "acceleration", unit = "g", on = "table", direction = [1, 0, 0]}
table_displacement = {column = "7", quantity = "displacement", unit = "mm", on = "table", direction = [1, 0, 0]}
floor = {column = "8", quantity = "acceleration", unit = "g", on = "ground", direction = [1, 0, 0]}
oil = {column = "9", quantity = "other"}
"""  # noqa: E501


@pytest.fixture
def drawn_campaign(tmp_path):
    """Write and read a campaign with these channels and a test of each specimen."""
    tests = "".join(
        f'[[tests]]\nid = "{name}-1"\nkind = "other"\nspecimen = "{name}"\nsetup = "frame"\nfile = "a.csv"\n'
        for name in ("prism", "cylinder", "cone", "statue")
    )
    (tmp_path / "campaign.toml").write_text(HEAD + tests, encoding="utf-8")
    return load(tmp_path)
