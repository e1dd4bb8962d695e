"""A campaign with forecasts of a test that is planned."""

import shutil
from pathlib import Path
from typing import NamedTuple

from colonnade.campaign import load
from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.store.layout import Layout
from colonnade.workflow.asked import checked
from colonnade.workflow.foresee import AskedForecast, foresee

TEST, LATER = "span-2.0", "span-9"
ENTRY = f"""
[[tests]]
id = "{LATER}"
kind = "earthquake"
specimen = "prism"
setup = "frame"
file = "raw/{LATER}.csv"
span = 9
planned = true
"""


class Made(NamedTuple):
    """A forecast and its file."""

    path: Path
    forecast: ForecastFile


def foreseen_of(folder, **asked):
    """Make forecasts as the command does."""
    made = foresee(load(folder), Layout(folder), checked(AskedForecast, asked))
    return [Made(*each) for each in made.items()]


def foresee_a_planned_test(filled, folder):
    """Copy the filled campaign, plan a test, and make two forecasts of it: one too weak to rock, one that overturns."""
    shutil.copytree(filled, folder)
    with (folder / "campaign.toml").open("a", encoding="utf-8") as campaign_file:
        campaign_file.write(ENTRY)
    return [made for level in ("0.01 g", "9x") for made in foreseen_of(folder, motion=TEST, levels=[level], test=LATER)]
