"""Where each page of the report is, within its folder."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable

from colonnade.campaign import Campaign
from colonnade.store.layout import STATE

WHOLE = {
    "quality": "quality.html",
    "problems": "problems.html",
    "methods": "methods.html",
    "overview": "index.html",
}
"""Pages about the whole campaign: template and address, the overview last, so that what it links to is there."""

FORECASTS, ASSESSMENTS = "forecasts.html", "assessments.html"
OPTIONAL = {ASSESSMENTS: "The real column", FORECASTS: "Forecasts"}
"""Pages that only some campaigns have, and their titles."""

LIBRARY = ("scripts/bokeh.min.js", "scripts/bokeh-api.min.js")
"""Scripts of the plotting library, which only pages of tests load."""

OWN = "scripts/colonnade.js"
"""Our own script, on every page."""


def of_test(test: str) -> str:
    """Address of a test's page within the report; ids are safe as file names."""
    return f"tests/{test}.html"


def of_data(page: str) -> str:
    """Address of the script with the data of a page: of a test's in a folder, of the others below it."""
    folder, name = posixpath.split(page.removesuffix(".html"))
    return f"data/{name}.js" if folder == "tests" else posixpath.join("data", "pages", folder, f"{name}.js")


def scripts_of(page: str) -> list[str]:
    """Addresses of the scripts of a page, in the order in which it loads them."""
    return [*(LIBRARY if page.startswith("tests/") else ()), OWN, STATE, of_data(page)]


def of_specimen(specimen: str) -> str:
    """Address of a specimen's page within the report."""
    return f"specimens/{specimen}.html"


def of_setup(specimen: str, setup: str) -> str:
    """Address of the drawing of a specimen with the transducers of a setup; "+" is in no id."""
    return f"setups/{specimen}+{setup}.svg"


def way(campaign: Campaign, has_forecasts: object) -> dict[str, str]:
    """Give the pages that every page leads to: address and name."""
    alone = "Specimen " if len(campaign.of_interest) == 1 else ""
    found = {WHOLE["overview"]: "Overview"} | {of_specimen(name): f"{alone}{name}" for name in campaign.of_interest}
    if campaign.assessments:
        found[ASSESSMENTS] = "Real column"
    if has_forecasts:
        found[FORECASTS] = "Forecasts"
    return found | {WHOLE[name]: name.capitalize() for name in ("quality", "problems", "methods")}


def of_campaign(optional: Iterable[str]) -> list[str]:
    """
    Addresses of what shows the whole campaign, with scripts and data, the overview last.

    `optional` are the pages of `OPTIONAL` that this campaign has.
    """
    whole = [*optional, *WHOLE.values()]
    return [*LIBRARY, OWN, *map(of_data, whole), *whole]


def addresses(campaign: Campaign, optional: Iterable[str]) -> list[str]:
    """Addresses of everything that shows a campaign."""
    single = [*map(of_test, campaign.tests), *map(of_specimen, campaign.of_interest)]
    setups = [of_setup(*pair) for pair in campaign.combinations]
    return [*single, *map(of_data, single), *setups, *of_campaign(optional)]
