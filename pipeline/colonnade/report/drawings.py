"""The drawings of the report: each specimen with the transducers of a setup is drawn once, whatever pages show it."""

from __future__ import annotations

from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.figures.drawing import described
from colonnade.report import addresses
from colonnade.units.text import listed


class Drawing(NamedTuple):
    """A drawing as a page shows it: specimen and setup, its address, and what is seen in it."""

    specimen: str
    setup: str
    tests: str
    address: str
    description: str


def of_setup(campaign: Campaign, specimen: str, setup: str) -> Drawing:
    """Name the drawing of a specimen in a setup; it is not drawn for that."""
    tests = listed(campaign.combinations[specimen, setup])
    said = described.said_of(campaign, specimen, setup)
    return Drawing(specimen, setup, tests, addresses.of_setup(specimen, setup), said)


def of_specimen(campaign: Campaign, specimen: str) -> list[Drawing]:
    """Name the drawings of a specimen."""
    return [of_setup(campaign, *pair) for pair in campaign.combinations if pair[0] == specimen]


def svg(campaign: Campaign, specimen: str, setup: str) -> str:
    """Draw a specimen with the transducers of a setup."""
    return described.picture(campaign, specimen, setup).svg + "\n"
