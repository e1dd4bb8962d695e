"""Where each page of the report is, within its folder; its scripts, and the script of its state."""

from __future__ import annotations

import json
import posixpath
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.errors import StoreError
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


PARTS = ("samples", "kept", "panel", "moving", "downloads", "page", "overview", "watched")
"""Our scripts in the order in which they are joined: what a later one uses is in an earlier one."""

FOLDER = Path(__file__).parent / "scripts"


def scripts() -> dict[str, str]:
    """
    Return the text of each script by its address in the report.

    Raises
    ------
    StoreError
        If the plotting library is not installed as it should be.
    """
    found = find_spec("bokeh")
    folder = Path(*(found.submodule_search_locations or [""])[:1] if found else "") / "server" / "static" / "js"
    try:
        library = {address: (folder / Path(address).name).read_text(encoding="utf-8") + "\n" for address in LIBRARY}
    except OSError as error:
        raise StoreError(
            f"{error.filename}: the report's plots need this script of the package bokeh. Install it again: "
            "`pip install --force-reinstall bokeh`."
        ) from error
    own = "".join((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in PARTS)
    return library | {OWN: own}


EVERY = 5.0
"""Seconds between two signs of life of a watch, when nothing else changes."""


def state_script(
    *, is_watched: bool, written: float = 0.0, shown: str = "", line: str = "", line_written: float = 0.0
) -> str:
    """
    Return the text of the state script.

    Parameters
    ----------
    is_watched : bool
        Whether a watch goes on: open pages load the script again only then.
    written : float, optional
        When the watch gave this sign of life, s since 1970; 0 in a report that was never watched.
    shown : str, optional
        A mark of what the report shows: a page that was opened with another loads itself again.
    line : str, optional
        The last line of the watch.
    line_written : float, optional
        When it said that, s since 1970.

    Returns
    -------
    text : str
        A call of the function `colonnadeState` of the report's own script.

    Examples
    --------
    >>> state_script(is_watched=True, written=1.7e9, line="free-01: rocking").partition('"every"')[0]
    'colonnadeState({"watched": true, "written": 1700000000.0, '
    """
    state = {
        "watched": is_watched,
        "written": round(written, 1),
        "every": EVERY,
        "shown": shown,
        "line": line,
        "line_written": round(line_written, 1),
    }
    return f"colonnadeState({json.dumps(state)});\n".replace("<", "\\u003c")


UNWATCHED = state_script(is_watched=False)
"""The script of a report that nobody watches."""
