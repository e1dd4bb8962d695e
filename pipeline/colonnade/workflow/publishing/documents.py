"""The report as one file: a PDF, made only when what it shows changed, and a bundle of all pages."""

from __future__ import annotations

import json
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.errors import StoreError
from colonnade.readers.files import sha256_of
from colonnade.report import addresses, who_and_when
from colonnade.report.interactive.state import UNWATCHED
from colonnade.store import bundle, files, stamps
from colonnade.store.freshness import Recipe
from colonnade.store.layout import STATE, Layout
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.lock import only_run

MADE_BY = ("colonnade.report.paper",)
"""What the PDF is made by."""

SHOWN = ("photos/*.jpg", "setups/*.svg")
"""Files of the report that pages show."""


def write_pdf(campaign: Path | str, *, results: Path | str | None = None) -> Path:
    """
    Typeset the report of a campaign as a PDF, unless it is there and shows the pages as they are.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder; its report is up to date.
    results : Path or str, optional
        Folder that holds `processed` and `report`; default that of the campaign file.

    Returns
    -------
    pdf : Path

    Raises
    ------
    CampaignError
        If the campaign file is not usable.
    StoreError
        If there is no report, another run is under way, or the PDF cannot be written.
    """
    loaded = load(Path(campaign))
    layout = Layout.of(loaded.path, results)
    with only_run(layout):
        folder = _there(layout)
        recipe = _recipe(loaded, layout, folder)
        if stamps.key_of(layout.pdf) != recipe.key:
            from colonnade.report.paper.typesetting import pdf_of

            files.write_bytes(layout.pdf, stamps.stamped_pdf(pdf_of(loaded, folder), recipe.key))
    return layout.pdf


def write_bundle(campaign: Path | str, target: Path | str, *, results: Path | str | None = None) -> Path:
    """
    Put the whole report of a campaign into one zip file; `campaign`, `results` and errors as for `write_pdf`.

    A PDF of older pages is left out. The pages in it are those of a report that nobody watches.

    Parameters
    ----------
    target : Path or str
        The file, with the ending .zip; outside the report.

    Returns
    -------
    target : Path
    """
    loaded = load(Path(campaign))
    layout = Layout.of(loaded.path, results)
    with only_run(layout):
        folder = _there(layout)
        own = [*_pages(loaded, folder), *_shown(folder)]
        if stamps.key_of(layout.pdf) == _recipe(loaded, layout, folder).key:
            own.append(layout.pdf.name)
        bundle.write_bundle(folder, Path(target), own=own, instead={STATE: UNWATCHED})
    return Path(target)


def _recipe(campaign: Campaign, layout: Layout, folder: Path) -> Recipe:
    """Give all that the PDF is made from."""
    pages = {page: stamps.key_of(folder / page) for page in _pages(campaign, folder)}
    shown = [campaign.title, campaign.campaign, who_and_when.of_campaign(campaign)]
    pictures = {Path(name).name: sha256_of(folder / name) for name in _shown(folder)}
    return Recipe("pdf", Catalogue(layout).code(MADE_BY), json.dumps(shown), pages | pictures)


def _pages(campaign: Campaign, folder: Path) -> list[str]:
    """Addresses of all pages, with their scripts and drawings."""
    optional = [page for page in addresses.OPTIONAL if (folder / page).is_file()]
    return [page for found in addresses.addresses(campaign, optional) for page in found]


def _shown(folder: Path) -> list[str]:
    return [path.relative_to(folder).as_posix() for pattern in SHOWN for path in sorted(folder.glob(pattern))]


def _there(layout: Layout) -> Path:
    """Folder of the report; refused where it is not there."""
    if not layout.report.is_file():
        raise StoreError(f"{layout.report}: report not found. Run `colonnade report` to make it.")
    return layout.report.parent
