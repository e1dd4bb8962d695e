"""The report for others: a PDF, made when what it shows changed, a bundle of all pages, a figure for a journal."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.errors import CampaignError, StoreError, nearest
from colonnade.report import addresses
from colonnade.report.addresses import UNWATCHED
from colonnade.report.test_page import facts
from colonnade.store import bundle
from colonnade.store.layout import STATE, Layout
from colonnade.store.provenance import key_of
from colonnade.workflow.graph import Graph
from colonnade.workflow.product import Contents, Product, brought_up_to_date, known
from colonnade.workflow.walk import walking

if TYPE_CHECKING:
    from colonnade.figures.files.output import Movie, Picture
    from colonnade.report.pictures import Entry

MADE_BY = ("colonnade.report.paper",)
"""What the PDF is made by."""

SHOWN = ("photos/*.jpg", "setups/*.svg")
"""Files of the report that pages show."""


def write_pdf(campaign: Campaign, layout: Layout, *, appendix: bool = True) -> Path:
    """
    Typeset the report of a campaign as a PDF, unless it is there and shows the pages as they are.

    Parameters
    ----------
    campaign : Campaign
        Its report is up to date.
    layout : Layout
    appendix : bool, optional
        Whether each test has its pages, too.

    Returns
    -------
    pdf : Path

    Raises
    ------
    StoreError
        If there is no report, another run is under way, or the PDF cannot be written.
    """
    folder = _there(layout)
    with walking(campaign, layout) as walk:
        brought_up_to_date([_pdf(walk.graph, folder, appendix)], walk.graph.catalogue)
    return layout.pdf


def write_bundle(campaign: Campaign, layout: Layout, target: Path) -> Path:
    """
    Put the whole report of a campaign into one zip file; `campaign`, `layout` and errors as for `write_pdf`.

    A PDF of older pages is left out. The pages in it are those of a report that nobody watches.

    Parameters
    ----------
    target : Path
        The file, with the ending .zip; outside the report.

    Returns
    -------
    target : Path
    """
    folder = _there(layout)
    with walking(campaign, layout) as walk:
        own = _shown(campaign, folder)
        if any(known(_pdf(walk.graph, folder, appendix), walk.graph.catalogue) for appendix in (True, False)):
            own.append(layout.pdf.name)
        bundle.write_bundle(folder, target, own=own, instead={STATE: UNWATCHED})
    return target


def _pdf(graph: Graph, folder: Path, appendix: bool) -> Product:
    """Give the PDF, made from the pages and their pictures as they are."""
    campaign = graph.campaign
    upstream = {name: key_of(folder / name) for name in _shown(campaign, folder)}
    shown = json.dumps([campaign.title, campaign.campaign, facts.on_cover(campaign), appendix])
    make = partial(_typeset, campaign, folder, appendix)
    return Product("pdf", shown, upstream, graph.catalogue.code(MADE_BY), make, (graph.layout.pdf,))


def _typeset(campaign: Campaign, folder: Path, appendix: bool) -> Contents:
    from colonnade.report.paper import pdf_of

    return [pdf_of(campaign, folder, appendix=appendix)], ""


def _shown(campaign: Campaign, folder: Path) -> list[str]:
    """Addresses of all pages, with their scripts, drawings and photos."""
    optional = [page for page in addresses.OPTIONAL if (folder / page).is_file()]
    pictures = [path.relative_to(folder).as_posix() for each in SHOWN for path in sorted(folder.glob(each))]
    return [*addresses.addresses(campaign, optional), *pictures]


def _there(layout: Layout) -> Path:
    """Folder of the report; refused where it is not there."""
    if not layout.report.is_file():
        raise StoreError(f"{layout.report}: report not found. Run `colonnade report` to make it.")
    return layout.report.parent


def chosen(campaign: Campaign, name: str, subject: str | None) -> tuple[Entry, str]:
    """
    Find a figure by its name, and what it is of.

    Parameters
    ----------
    campaign : Campaign
    name : str
    subject : str or None
        Id of a test or specimen; None for the whole campaign, or if there is only one.

    Returns
    -------
    entry : Entry
    subject : str
        Id of the test or specimen, empty for the campaign.

    Raises
    ------
    CampaignError
        If there is no such figure, test or specimen.
    """
    from colonnade.report.pictures import FIGURES

    of = {entry.of: entry for entry in FIGURES if entry.name == name}
    if not of:
        hint = nearest(name, dict.fromkeys(entry.name for entry in FIGURES))
        raise CampaignError(f'Unknown figure "{name}".{hint} All are listed by `colonnade figure --list`.')
    ids = {"campaign": [""], "test": list(campaign.tests), "specimen": list(campaign.specimens)}
    for each, entry in of.items():
        if subject in ids[each] or (subject is None and len(ids[each]) == 1):
            return entry, subject or ids[each][0]
    named = "" if subject is None else f', not of "{subject}"'
    hint = nearest(subject or "", [known for each in of for known in ids[each] if known])
    raise CampaignError(f'"{name}" is a figure of a {" or a ".join(of)}{named}.{hint}')


def draw(campaign: Campaign, entry: Entry, subject: str, results: Path | None) -> Picture | Movie:
    """
    Draw a figure from the results of the last run.

    Raises
    ------
    CampaignError
        If what is stored has nothing that it shows; the message says why.
    StoreError
        If a result is damaged.
    """
    from colonnade.report import pictures

    layout = Layout.of(campaign.path, results)
    found: pictures.Subject
    if entry.of == "test":
        found = pictures.read_of_test(campaign, layout, subject)
    elif entry.of == "specimen":
        found = pictures.read_of_specimen(campaign, layout, subject)
    else:
        found = pictures.read_of_campaign(campaign, layout)
    picture = entry.draw(found)
    if picture is None:
        failures = "; ".join(f"{failure.stage}: {failure.text}".removeprefix(": ") for failure in found.failures)
        why = failures or entry.needs
        if not layout.summary_json.is_file():
            why = "Nothing has been run yet; run `colonnade run` first."
        raise CampaignError(f'{subject or campaign.campaign}: there is nothing to draw for "{entry.name}". {why}')
    return picture
