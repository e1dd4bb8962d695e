"""Where each page of the report is, within its folder."""

from __future__ import annotations

from colonnade.campaign import Campaign

WHOLE = {
    "quality": "quality.html",
    "problems": "problems.html",
    "methods": "methods.html",
    "overview": "index.html",
}
"""Pages about the whole campaign: template and address, the overview last, so that what it links to is there."""


SCRIPTS = ("scripts/bokeh.min.js", "scripts/bokeh-api.min.js", "scripts/colonnade.js")
"""Scripts that the pages share."""


def of_test(test: str) -> str:
    """Address of a test's page within the report; ids are safe as file names."""
    return f"tests/{test}.html"


def of_data(test: str) -> str:
    """Address of the script with the samples of a test's page."""
    return f"data/{test}.js"


def of_specimen(specimen: str) -> str:
    """Address of a specimen's page within the report."""
    return f"specimens/{specimen}.html"


def of_setup(specimen: str, setup: str) -> str:
    """Address of the drawing of a specimen with the transducers of a setup; "+" is in no id."""
    return f"setups/{specimen}+{setup}.svg"


def addresses(campaign: Campaign) -> tuple[list[str], list[str]]:
    """Addresses of what shows one test or setup of a campaign each, and of the pages that show several tests."""
    specimens = map(of_specimen, campaign.specimens)
    setups = [of_setup(*pair) for pair in campaign.combinations]
    return [*map(of_test, campaign.tests), *map(of_data, campaign.tests), *setups], [
        *SCRIPTS,
        *specimens,
        *WHOLE.values(),
    ]
