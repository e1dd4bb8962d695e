"""summary.json and summary.csv, rebuilt from the results, which are the truth."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.summary import Summary, TestSummary
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.specimen import record_of_specimen
from colonnade.store.records.stored import read_test
from colonnade.store.records.table import as_csv
from colonnade.store.records.test import record_of_test
from colonnade.store.results import results_of
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.pooling import restitution_taken

MADE_BY = ("colonnade.store", "colonnade.identification")
"""What records are made by."""


def write_summary(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    *,
    outdated: Collection[str] = (),
    failed: Mapping[str, str] | None = None,
) -> Summary:
    """
    Write both summaries, where their content changed.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Spares reading the results of tests that are as they were.
    outdated : collection of str, optional
        Tests whose stored results are not of this campaign file, these raw files or this program; they are pending.
    failed : mapping of str to str, optional
        Reasons of the tests that failed in this run, stored or not.

    Returns
    -------
    summary : Summary

    Raises
    ------
    StoreError
        If they cannot be written.
    """
    failures = failed or {}
    tests = campaign.wherever_it_lies().tests
    summary = Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={
            name: record_of_specimen(campaign, name, restitution_taken(campaign, layout, name))
            for name in campaign.specimens
        },
        tests={
            name: _remembered(campaign, layout, catalogue, test, name in outdated, failures.get(name))
            for name, test in tests.items()
        },
    )
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, as_csv(summary))
    return summary


def _remembered(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, test: Test, is_outdated: bool, failure: str | None
) -> TestSummary:
    """Record of a test: the last one if it was made from just these results, else a new one."""
    paths = [layout.path(result) for result in results_of(campaign, test)]
    entry = [repr(test), repr(campaign.specimens[test.specimen]), campaign.gravity, campaign.review(test.id).excluded]
    entry.append(repr(campaign.concerning(test.id)))
    signature = catalogue.signature(paths, *entry, is_outdated, failure, catalogue.code(MADE_BY))
    known = catalogue.record(test.id, signature)
    if known is not None:
        return TestSummary.model_validate_json(known)
    record = record_of_test(campaign, test, read_test(campaign, layout, test, is_outdated=is_outdated, failure=failure))
    catalogue.remember(test.id, signature, record.model_dump_json())
    return record
