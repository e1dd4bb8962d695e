"""The report as the last result of a run: rebuilt unless all pages are there and show what is stored."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from functools import partial
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.forms.foreseen import ForecastsSummary
from colonnade.report.addresses import ASSESSMENTS, FORECASTS, addresses, of_data, of_test
from colonnade.report.asked import asked_of, shows
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.store.results import results_of
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.spreading import spread

_PART = "part {}"
"""Name of the report's part of a test among the records that the catalogue keeps."""

MADE_BY = ("colonnade.report", "colonnade.store")
"""Packages whose code makes the pages; what they import counts too."""


def update_report(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    outdated: Collection[str],
    forecasts: ForecastsSummary | None,
    advice: Sequence[Advice],
    workers: int | None,
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
    forecasts : ForecastsSummary or None
        As in the summary: the hash of each forecast is in it.
    advice : sequence of Advice
        On the next tests.
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
    foreseen = [] if forecasts is None else [forecasts.model_dump_json()]
    recipe = Recipe(
        "report",
        catalogue.code(MADE_BY),
        json.dumps([repr(campaign.with_relative_paths()), sorted(outdated), *foreseen, *map(repr, advice)]),
        {path.relative_to(layout.processed).as_posix(): catalogue.content(path) for path in layout.results_there()},
    )
    folder = layout.report.parent
    optional = {ASSESSMENTS: bool(campaign.assessments), FORECASTS: forecasts is not None}
    single, whole = addresses(campaign, [page for page, is_there in optional.items() if is_there])
    are_there = layout.state.is_file() and all(catalogue.stamp(folder / page) for page in single)
    recipes = _recipes(campaign, layout, catalogue, outdated, recipe.code)
    kept = _kept(folder, catalogue, recipes)
    if not (are_there and all(catalogue.stamp(folder / page) == recipe.key for page in whole)):
        from colonnade.report.build import build

        spread_out = partial(spread, workers=workers)
        build(campaign, layout, outdated, advice, code=recipe.code, key=recipe.key, kept=kept, spread=spread_out)
        for test, text in kept.items():
            catalogue.remember(_PART.format(test), recipes[test], text)
        for page in (*single, *whole):
            catalogue.stamp(folder / page)
    return layout.report


def _recipes(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, outdated: Collection[str], code: str
) -> dict[str, Recipe]:
    """Give what the report's part of each test is made from."""
    return {
        asked.test: Recipe(
            "part",
            code,
            shows(campaign, asked),
            {
                str(result): catalogue.content(layout.path(result))
                for result in results_of(campaign, campaign.tests[asked.test])
            },
        )
        for asked in asked_of(campaign, layout, outdated)
    }


def _kept(folder: Path, catalogue: Catalogue, recipes: Mapping[str, Recipe]) -> dict[str, str]:
    """Give the parts of tests that are as they were, if their pages are there."""
    found = {}
    for test, recipe in recipes.items():
        text = catalogue.record(_PART.format(test), recipe)
        pages = of_test(test), of_data(of_test(test))
        # The first line of a part is the key of its pages.
        if text is not None and all(catalogue.stamp(folder / page) == text.partition("\n")[0] for page in pages):
            found[test] = text
    return found
