"""A campaign of one pulse on one of two specimens."""

import pytest

from colonnade.campaign import load
from prism import SPECIMEN, entry

CAMPAIGN = f"""
schema = 1
campaign = "two"
title = "Two specimens"

[specimens]
{SPECIMEN.replace("}", ", scale = 20}")}
statue = {{shape = "measured", mass = "80 kg", pole_distance = "610 mm", critical_angle = "0.21 rad", \
inertia = "41.2 kg m^2", restitution = [0.9, 0.8]}}

[setups.frame.channels]
top = {{column = "top", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "440 mm"], \
direction = [1, 0, 0], relative_to = "table"}}

{entry("pulse-01", "pulse")}"""


@pytest.fixture
def written(tmp_path):
    """Load it, with some of its text replaced or added at its end, where its test is."""

    def loaded(before="", after="", *, more=""):
        text = CAMPAIGN.replace(before, after) if before else CAMPAIGN
        (tmp_path / "campaign.toml").write_text(text + more, encoding="utf-8")
        return load(tmp_path)

    return loaded
