"""summary.json and summary.csv, rebuilt from the results."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import partial

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessing.assessed import AssessmentSummary
from colonnade.campaign.forms.summary import SpecimenSummary, Summary, TestSummary
from colonnade.store import files
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import as_csv
from colonnade.store.records.test import record_of_specimen, record_of_test
from colonnade.store.results import results_of
from colonnade.workflow.catalogue import Catalogue, stored_attributes
from colonnade.workflow.execution.spreading import spread
from colonnade.workflow.forecasting.records import NOTHING_FORESEEN, Foreseen
from colonnade.workflow.pooling import restitution_taken

MADE_BY = ("colonnade.store", "colonnade.identification", "colonnade.stages.specimen")
"""Packages whose code makes the records; what they import counts too."""


def write_summary(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    *,
    outdated: Mapping[str, str] | None = None,
    failed: Mapping[str, str] | None = None,
    outdated_assessments: Collection[str] = (),
    failed_assessments: Mapping[str, str] | None = None,
    foreseen: Foreseen = NOTHING_FORESEEN,
    workers: int | None = 1,
) -> Summary:
    """
    Write both summaries if their content changed.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Spares reading the results of unchanged tests.
    outdated : mapping of str to str, optional
        Tests whose stored results are out of date, and why; they are reported as pending.
    failed : mapping of str to str, optional
        Why tests failed in this run, whether stored or not.
    outdated_assessments : collection of str, optional
        Assessments whose stored results are out of date; they are left out, as those that were never made.
    failed_assessments : mapping of str to str, optional
        Why assessments failed in this run, whether stored or not.
    foreseen : Foreseen, optional
        What was forecast.
    workers : int, optional
        Processes in which results are read; None for one a core.

    Returns
    -------
    summary : Summary

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    failures = failed or {}
    records = _records(campaign, layout, catalogue, outdated or {}, failures, workers)
    summary = Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={name: _of_specimen(campaign, layout, catalogue, name) for name in campaign.specimens},
        tests={name: each.model_copy(update={"forecast": foreseen.tests.get(name)}) for name, each in records.items()},
        forecasts=foreseen.together,
        assessments=_assessments(campaign, layout, outdated_assessments, failed_assessments or {}),
    )
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, as_csv(summary))
    return summary


def _assessments(
    campaign: Campaign, layout: Layout, outdated: Collection[str], failed: Mapping[str, str]
) -> dict[str, AssessmentSummary]:
    """Return the records of assessments that were made or failed."""
    found = {}
    for name, asked in campaign.assessments.items():
        stored = {} if name in outdated else stored_attributes(layout.stage(name, "assessment"))
        if name in failed or stored.get("status") == "failed":
            reason = failed.get(name) or str(stored["reason"])
            found[name] = AssessmentSummary(
                status="failed", reason=reason, specimen=asked.specimen, measure=asked.measure
            )
        elif stored:
            found[name] = AssessmentSummary.model_validate_json(stored["answer"])
    return found


def _of_specimen(campaign: Campaign, layout: Layout, catalogue: Catalogue, name: str) -> SpecimenSummary:
    """Return the record of a specimen: the last one if nothing that it is made from changed, else a new one."""
    from colonnade.stages.specimen import SpecimenInputs

    inputs, subject = SpecimenInputs.of(campaign, name).model_dump_json(), f"specimen {name}"
    entry = json.dumps([inputs, repr(campaign.specimens[name]), campaign.gravity])
    upstream = {"specimen": catalogue.content(layout.stage(name, "specimen"))}
    recipe = Recipe("record", catalogue.code(MADE_BY), entry, upstream)
    text = catalogue.record(subject, recipe)
    if text is None:
        text = record_of_specimen(campaign, name, restitution_taken(campaign, layout, name)).model_dump_json()
        catalogue.remember(subject, recipe, text)
    return SpecimenSummary.model_validate_json(text)


@dataclass(frozen=True)
class _Asked:
    """What the record of a test is made from, apart from its results; the campaign holds this test alone."""

    campaign: Campaign
    test: Test
    outdated: str | None
    failure: str | None


def _records(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    outdated: Mapping[str, str],
    failures: Mapping[str, str],
    workers: int | None,
) -> dict[str, TestSummary]:
    """Return the record of each test: the last one if nothing that it is made from changed, else a new one."""
    recipes, found, waiting = {}, {}, []
    for name, test in campaign.with_relative_paths().tests.items():
        asked = _Asked(campaign.but(tests={name: test}), test, outdated.get(name), failures.get(name))
        recipes[name] = _recipe(asked, layout, catalogue)
        known = catalogue.record(name, recipes[name])
        if known is None:
            waiting.append(asked)
        else:
            found[name] = TestSummary.model_validate_json(known)
    for name, text in spread(partial(_record, layout), waiting, workers=workers):
        catalogue.remember(name, recipes[name], text)
        found[name] = TestSummary.model_validate_json(text)
    return {name: found[name] for name in campaign.tests}


def _recipe(asked: _Asked, layout: Layout, catalogue: Catalogue) -> Recipe:
    campaign, test = asked.campaign, asked.test
    entry = [repr(test), repr(campaign.specimens[test.specimen]), campaign.gravity, campaign.left_out(test.id)]
    entry += [repr(campaign.concerning(test.id)), asked.outdated, asked.failure]
    upstream = {str(result): catalogue.content(layout.path(result)) for result in results_of(campaign, test)}
    return Recipe("record", catalogue.code(MADE_BY), json.dumps(entry), upstream)


def _record(layout: Layout, asked: _Asked) -> tuple[str, str]:
    """Read what is stored of a test; return its id, and its record as JSON."""
    stored = read_test(asked.campaign, layout, asked.test, outdated=asked.outdated, failure=asked.failure)
    return asked.test.id, record_of_test(asked.campaign, asked.test, stored).model_dump_json()
