"""The advice that the report shows: made again only for the kinds of test about which something changed."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import partial

from pydantic import TypeAdapter

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.store.records.summary import records_of_tests
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.spreading import spread

MADE_BY = ("colonnade.workflow.advising",)
"""Package whose code makes advice; what it imports counts too."""

_ADVICE = TypeAdapter(list[Advice])


def advice_shown(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, summary: Summary, workers: int | None
) -> list[Advice]:
    """
    Give the advice that the report of a campaign shows.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Keeps advice about which nothing changed.
    summary : Summary
        Of this run.
    workers : int or None
        Processes; None for one a core.

    Returns
    -------
    advice : list of Advice
        Empty if no test is planned and campaign.toml has neither [next] nor [table]: nobody asks for a further test.
    """
    if not (campaign.awaited or campaign.next.model_fields_set or campaign.table.model_fields_set):
        return []
    from colonnade.workflow.advising.next import KINDS

    tests = records_of_tests(campaign, summary)
    asked = [_Asked(campaign, name, kind, tests) for name in campaign.specimens for kind in KINDS]
    recipes = {each.subject: each.recipe(layout, catalogue) for each in asked}
    found = {subject: catalogue.record(subject, recipe) for subject, recipe in recipes.items()}
    waiting = [each for each in asked if found[each.subject] is None]
    for subject, text in spread(partial(_made, layout), waiting, workers=workers):
        catalogue.remember(subject, recipes[subject], text)
        found[subject] = text
    return [advice for each in asked for advice in _ADVICE.validate_json(found[each.subject] or "[]")]


@dataclass(frozen=True)
class _Asked:
    """One kind of test of a specimen."""

    campaign: Campaign
    specimen: str
    kind: str
    tests: dict[str, TestSummary]

    @property
    def subject(self) -> str:
        return f"advice {self.specimen} {self.kind}"

    def recipe(self, layout: Layout, catalogue: Catalogue) -> Recipe:
        campaign, own = self.campaign.with_relative_paths(), {}
        for name, test in campaign.tests.items():
            if (test.specimen, test.kind) == (self.specimen, self.kind):
                record = self.tests[name].model_dump_json() if name in self.tests else None
                tilt = campaign.setups[test.setup].table_tilt
                own[name] = [repr(test), record, tilt, catalogue.content(layout.stage(name, "rocking"))]
        read = [campaign.specimens[self.specimen], campaign.gravity, campaign.processing, campaign.next, campaign.table]
        entry = json.dumps([*map(repr, read), own])
        pooled = catalogue.content(layout.stage(self.specimen, "specimen"))
        return Recipe("advice", catalogue.code(MADE_BY), entry, {"specimen": pooled})


def _made(layout: Layout, asked: _Asked) -> tuple[str, str]:
    from colonnade.workflow.advising.next import advise_kind

    found = advise_kind(asked.campaign, layout, asked.specimen, asked.kind, asked.tests)
    return asked.subject, _ADVICE.dump_json(found).decode()
