"""The report as the last result of a run: rebuilt unless all pages are there and show what is stored."""

from __future__ import annotations

import json
from collections.abc import Collection
from functools import partial
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.report.addresses import addresses
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.spreading import spread

MADE_BY = ("colonnade.report", "colonnade.store")
"""Packages whose code makes the pages; what they import counts too."""


def update_report(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, outdated: Collection[str], workers: int | None
) -> Path:
    """
    Build the report if it is out of date.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
    outdated : collection of str
        Tests whose stored results are out of date.
    workers : int or None
        Processes in which pages are drawn; None for one a core.

    Returns
    -------
    overview : Path

    Raises
    ------
    StoreError
        If a page cannot be written.
    """
    recipe = Recipe(
        "report",
        catalogue.code(MADE_BY),
        json.dumps([repr(campaign.with_relative_paths()), sorted(outdated)]),
        {path.relative_to(layout.processed).as_posix(): catalogue.content(path) for path in layout.results_there()},
    )
    folder = layout.report.parent
    tests, others = addresses(campaign)
    is_whole = all(catalogue.stamp(folder / page) for page in tests)
    if not (is_whole and all(catalogue.stamp(folder / page) == recipe.key for page in others)):
        from colonnade.report.build import build

        build(campaign, layout, outdated, code=recipe.code, key=recipe.key, spread=partial(spread, workers=workers))
        for page in (*tests, *others):
            catalogue.stamp(folder / page)
    return layout.report
