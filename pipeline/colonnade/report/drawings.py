"""The drawings of the report: each specimen with the transducers of a setup is drawn once, whatever pages show it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.figures.drawing import described
from colonnade.report import addresses
from colonnade.store import stamps
from colonnade.store.freshness import Recipe
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


def files(campaign: Campaign, folder: Path, code: str) -> Iterator[tuple[str, str | None, str]]:
    """
    Draw what is not drawn yet.

    Parameters
    ----------
    campaign : Campaign
    folder : Path
        Of the report.
    code : str
        Hash of the code; if empty, everything is drawn.

    Yields
    ------
    address : str
    text : str or None
        None if the drawing is there already.
    made_from : str
        Hash of what it shows; empty without `code`.
    """
    for specimen, setup in campaign.combinations:
        shown = repr((specimen, campaign.specimens[specimen], campaign.gravity, setup, campaign.setups[setup]))
        made_from = Recipe("drawing", code, shown, {}).key if code else ""
        address = addresses.of_setup(specimen, setup)
        if made_from and made_from == stamps.key_of(folder / address):
            yield address, None, made_from
        else:
            yield address, described.picture(campaign, specimen, setup).svg + "\n", made_from
