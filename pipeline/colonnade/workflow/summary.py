"""summary.json and summary.csv: the records of tests, specimens and assessments, each made again only if it changed."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from functools import partial

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Assessment
from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.campaign.forms.summary import SpecimenSummary, Summary, TestSummary
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import as_csv
from colonnade.store.records.test import record_of_specimen, record_of_test
from colonnade.store.results import Subject, results_of
from colonnade.workflow.forecasts import Foreseen
from colonnade.workflow.pooling import restitution_taken
from colonnade.workflow.product import Catalogue, Contents, Product, brought_up_to_date, stored_attributes

MADE_BY = ("colonnade.store", "colonnade.identification", "colonnade.stages.specimen")
"""Packages whose code makes the records; what they import counts too."""


def write_summary(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    *,
    outdated: Mapping[str, str] | None = None,
    failed: Mapping[Subject, Mapping[str, str]] | None = None,
    outdated_assessments: Collection[str] = (),
    foreseen: Foreseen = ({}, None),
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
    failed : mapping of str to mapping of str to str, optional
        Why tests and assessments failed in this run, whether stored or not.
    outdated_assessments : collection of str, optional
        Assessments whose stored results are out of date; they are left out, as those that were never made.
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
    failures, late = failed or {}, outdated or {}
    why = {name: (late.get(name), failures.get("test", {}).get(name)) for name in campaign.tests}
    tests = (
        _of_test(campaign.but(tests={name: test}), layout, catalogue, test, *why[name])
        for name, test in campaign.tests.items()
    )
    assessed = {
        name: record_of_assessment(layout, name, asked, failures.get("assessment", {}).get(name, ""))
        for name, asked in campaign.assessments.items()
    }
    specimens = (_of_specimen(campaign, layout, catalogue, name) for name in campaign.specimens)
    records = brought_up_to_date(specimens, catalogue) | brought_up_to_date(tests, catalogue, workers=workers)
    summary = Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={
            name: SpecimenSummary.model_validate_json(records[f"specimen-record {name}"].text)
            for name in campaign.specimens
        },
        tests={
            name: TestSummary.model_validate_json(records[f"record {name}"].text).model_copy(
                update={"forecast": foreseen[0].get(name)}
            )
            for name in campaign.tests
        },
        forecasts=foreseen[1],
        assessments={name: each for name, each in assessed.items() if each and name not in outdated_assessments},
    )
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, as_csv(summary))
    return summary


def _of_specimen(campaign: Campaign, layout: Layout, catalogue: Catalogue, name: str) -> Product:
    from colonnade.stages.specimen import SpecimenInputs

    inputs = SpecimenInputs.of(campaign, name).model_dump_json()
    entry = json.dumps([inputs, repr(campaign.specimens[name]), campaign.gravity])
    upstream = {"specimen": catalogue.content(layout.stage(name, "specimen"))}
    make = partial(_specimen, campaign, layout, name)
    return Product(f"specimen-record {name}", entry, upstream, catalogue.code(MADE_BY), make, keeps=True)


def _specimen(campaign: Campaign, layout: Layout, name: str) -> Contents:
    return [], record_of_specimen(campaign, name, restitution_taken(campaign, layout, name)).model_dump_json()


def _of_test(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, test: Test, outdated: str | None, failure: str | None
) -> Product:
    """Give the record of a test; the campaign holds this test alone."""
    entry = [campaign.told(test), repr(campaign.specimens[test.specimen]), campaign.gravity, campaign.left_out(test.id)]
    entry += [repr(campaign.concerning(test.id)), outdated, failure]
    upstream = {str(result): catalogue.content(layout.path(result)) for result in results_of(campaign, test)}
    make = partial(_test, campaign, layout, test, outdated, failure)
    return Product(f"record {test.id}", json.dumps(entry), upstream, catalogue.code(MADE_BY), make, keeps=True)


def _test(campaign: Campaign, layout: Layout, test: Test, outdated: str | None, failure: str | None) -> Contents:
    stored = read_test(campaign, layout, test, outdated=outdated, failure=failure)
    return [], record_of_test(campaign, test, stored).model_dump_json()


def record_of_assessment(layout: Layout, name: str, asked: Assessment, failure: str = "") -> AssessmentSummary | None:
    """Return the record of an assessment that was made or failed, now (`failure`) or in an earlier run."""
    stored = stored_attributes(layout.stage(name, "assessment"))
    if failure or stored.get("status") == "failed":
        reason = failure or str(stored["reason"])
        return AssessmentSummary(status="failed", reason=reason, specimen=asked.specimen, measure=asked.measure)
    return AssessmentSummary.model_validate_json(stored["answer"]) if stored else None
